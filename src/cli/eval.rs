//! How does `umber eval` take inputs from a file and give values of the library?

use std::io::Read;
use std::path::{Path, PathBuf};

use crate::cli::exit::{Exit, Failure, judge_messages};
use crate::cli::options::DeviceArgument;
use crate::cli::output::{Output, talk};
use crate::interface::{ProbeInput, ProbeResult};
use crate::render::library::{FUNCTIONS, Function, Tier};
use crate::render::probe::Probe;

/// Options of `umber eval`.
#[derive(clap::Args)]
pub struct Arguments {
    /// The function; see --list
    #[arg(required_unless_present = "list", value_parser = Function::of_name)]
    function: Option<&'static Function>,
    /// The arithmetic: f16, f32 or f32-compensated
    #[arg(long, default_value = "f32", value_parser = Tier::of_name)]
    tier: Tier,
    /// Tell the functions, what they take and give, and in which tiers
    #[arg(long, conflicts_with = "function")]
    list: bool,
    /// Read inputs from here: eleven numbers each, N, L, E (three numbers a vector), roughness, f0, and what --list tells
    /// of the function besides
    #[arg(long, value_name = "FILE", default_value = "-")]
    input: PathBuf,
    /// Inputs and values are 32-bit floats, little-endian, without anything between them, in place of CSV
    #[arg(long)]
    binary: bool,
    /// Write values here
    #[arg(long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
    #[command(flatten)]
    device: DeviceArgument,
}

/// The most that is read: 22 million inputs as bytes.
const MOST_BYTES: u64 = 1 << 30;

/// Reads, evaluates, writes.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let Some(function) = arguments.function else {
        return crate::cli::output::print_bytes(list().as_bytes());
    };
    if let Some(why) = function.why_not(arguments.tier) {
        let message = format!("{} in {}: {why}", function.name, arguments.tier.name());
        return Err(Failure::new(Exit::Usage, message));
    }
    let output = Output::open(&arguments.output)?;
    if output.is(&arguments.input) && arguments.input != Path::new("-") {
        let message = format!("{}: it would be overwritten", arguments.input.display());
        return Err(Failure::new(Exit::Usage, message));
    }
    let bytes = read(&arguments.input)?;
    let inputs = match arguments.binary {
        true => of_binary(function, &bytes),
        false => of_csv(function, &bytes),
    };
    let inputs = inputs.map_err(|why| {
        let place = place(&arguments.input);
        Failure::new(Exit::File, format_args!("{place}: {why}"))
    })?;
    let device = arguments.device.open()?;
    let results = Probe::new(&device, function, arguments.tier).and_then(|p| p.at(&inputs));
    let messages = device.instance().validation_log().drain();
    messages.iter().for_each(talk);
    let results = results?;
    output.write(&match arguments.binary {
        true => to_binary(&results),
        false => to_csv(function, &results),
    })?;
    judge_messages(messages.len())
}

fn place(path: &Path) -> String {
    match path == Path::new("-") {
        true => "stdin".to_owned(),
        false => path.display().to_string(),
    }
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let read = match path == Path::new("-") {
        true => std::io::stdin()
            .lock()
            .take(MOST_BYTES + 1)
            .read_to_end(&mut bytes),
        false => std::fs::File::open(path)
            .and_then(|file| file.take(MOST_BYTES + 1).read_to_end(&mut bytes)),
    };
    let told = |why: &dyn std::fmt::Display| {
        let place = place(path);
        Failure::new(Exit::File, format_args!("cannot read {place}: {why}"))
    };
    read.map_err(|error| told(&error))?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(told(&"it is larger than 1 GiB; give it in parts"));
    }
    Ok(bytes)
}

/// Anything that is a float is an input, NaN too: what a function makes of it is what is asked.
fn of_csv(function: &Function, bytes: &[u8]) -> Result<Vec<ProbeInput>, String> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .flexible(true)
        .from_reader(bytes);
    let columns = function.columns();
    let mut inputs = Vec::new();
    for (number, record) in (1..).zip(reader.records()) {
        let record = record.map_err(|error| error.to_string())?;
        let line = record.position().map_or(number, csv::Position::line);
        if inputs.is_empty() && record.iter().eq(columns.iter().copied()) {
            continue;
        }
        if record.len() != columns.len() {
            return Err(format!(
                "line {line}: {} numbers are an input ({}), and here are {}",
                columns.len(),
                columns.join(","),
                record.len()
            ));
        }
        let parse = |(text, column): (&str, &&str)| {
            let number: Result<f32, _> = text.parse();
            number.map_err(|_| format!("line {line}: {column} is no number"))
        };
        let numbers: Result<Vec<f32>, String> = record.iter().zip(&columns).map(parse).collect();
        inputs.push(function.input(&numbers?));
    }
    Ok(inputs)
}

fn of_binary(function: &Function, bytes: &[u8]) -> Result<Vec<ProbeInput>, String> {
    let size = function.columns().len() * size_of::<f32>();
    if !bytes.len().is_multiple_of(size) {
        return Err(format!(
            "{} bytes are no whole number of inputs of {size} bytes",
            bytes.len()
        ));
    }
    let one = |bytes: &[u8]| {
        let (words, _) = bytes.as_chunks();
        let numbers: Vec<f32> = words.iter().map(|word| f32::from_le_bytes(*word)).collect();
        function.input(&numbers)
    };
    Ok(bytes.chunks_exact(size).map(one).collect())
}

/// As many digits as tell one float from its neighbours.
fn to_csv(function: &Function, results: &[ProbeResult]) -> Vec<u8> {
    let mut text = format!("{}\n", function.name);
    for result in results {
        text.push_str(&format!("{:e}\n", result.value));
    }
    text.into_bytes()
}

fn to_binary(results: &[ProbeResult]) -> Vec<u8> {
    results.iter().flat_map(|r| r.value.to_le_bytes()).collect()
}

fn list() -> String {
    let mut text = String::from("N, L, E are unit vectors: normal, to the light, to the eye.\n");
    for function in FUNCTIONS {
        let tiers: Vec<_> = function.tiers.iter().map(|tier| tier.name()).collect();
        text.push_str(&format!(
            "\n{}\n  takes  {}\n  gives  {}\n  from   {}\n  tiers  {}\n",
            function.name,
            function.takes,
            function.gives,
            function.source,
            tiers.join(", "),
        ));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matte() -> &'static Function {
        Function::of_name("oren-nayar").expect("it is there")
    }

    const LINE: &str = "0,1,0, 0,1,0, 0.6,0.8,0, 0.5,0.04";

    #[test]
    fn a_line_is_an_input_with_or_without_a_head() {
        let plain = of_csv(matte(), LINE.as_bytes()).expect("numbers");
        assert_eq!(plain.len(), 1);
        assert_eq!((plain[0].eye, plain[0].f0), ([0.6, 0.8, 0.0], 0.04));
        let headed = format!("{}\n# note\n{LINE}\n{LINE}\n", matte().columns().join(", "));
        let headed = of_csv(matte(), headed.as_bytes()).expect("numbers");
        assert_eq!(headed, [plain[0], plain[0]]);
        assert_eq!(of_csv(matte(), b"").expect("nothing"), []);
    }

    #[test]
    fn what_is_no_input_is_told_by_its_line() {
        let short = of_csv(matte(), format!("{LINE}\n1,2\n").as_bytes()).unwrap_err();
        assert!(short.starts_with("line 2: 11 numbers"), "{short}");
        let word = of_csv(matte(), b"0,1,0,0,1,0,x,0.8,0,0.5,0.04").unwrap_err();
        assert_eq!(word, "line 1: ex is no number");
        let text = of_csv(matte(), b"0,1,0,0,1,0,nan,inf,-0,1e-45,0.04").expect("floats");
        assert!(text[0].eye[0].is_nan() && text[0].eye[1].is_infinite());
        assert!(of_csv(matte(), b"\xff,\xfe").is_err());
    }

    #[test]
    fn a_function_may_take_more() {
        let metal = Function::of_name("conductor-f").expect("it is there");
        let inputs = of_csv(metal, format!("{LINE},0.2,3.5").as_bytes()).expect("numbers");
        assert_eq!(inputs[0].extra, [0.2, 3.5, 0.0, 0.0]);
        let numbers = metal.numbers(&inputs[0]);
        assert_eq!((numbers.len(), metal.input(&numbers)), (13, inputs[0]));
        let short = of_csv(metal, LINE.as_bytes()).unwrap_err();
        assert!(
            short.contains("13 numbers") && short.contains("f0,n,k"),
            "{short}"
        );
    }

    #[test]
    fn bytes_are_inputs_too() {
        let inputs = of_csv(matte(), LINE.as_bytes()).expect("numbers");
        let numbers = [0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.6, 0.8, 0.0, 0.5, 0.04_f32];
        let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        assert_eq!(of_binary(matte(), &bytes).expect("whole"), inputs);
        assert!(of_binary(matte(), &bytes[1..]).is_err());
    }

    #[test]
    fn the_list_tells_every_function() {
        let list = list();
        for function in FUNCTIONS {
            assert!(list.contains(function.name) && list.contains(function.gives));
        }
    }
}
