//! How does `umber diff` go from two files to how far their pictures are apart?

use std::path::{Path, PathBuf};

use crate::cli::exit::{Exit, Failure};
use crate::cli::options::{ToneMappingArgument, exposure};
use crate::cli::output::{JsonArgument, Output, print_bytes, write_json};
use crate::report::{DiffReport, DifferenceRow, DisplayRow, Program, magma_png};
use crate::scene::Still;
use crate::studies::{Display, NoDifference, Seen, difference, key_exposure};

/// Options of `umber diff`.
#[derive(clap::Args)]
pub struct Arguments {
    /// A picture: PNG, EXR, HDR or JPEG
    a: PathBuf,
    /// Another of the same size
    b: PathBuf,
    /// Write FLIP of each pixel as a picture: .png, black for 0, pale yellow for 1
    #[arg(short, long, value_name = "FILE.png")]
    output: Option<PathBuf>,
    /// End with 1 where the mean of FLIP is above this: 0 to 1
    #[arg(long, value_name = "X", allow_negative_numbers = true, value_parser = share)]
    max_flip: Option<f64>,
    /// End with 1 where the largest difference is above this: in the files' numbers where both are EXR or HDR, else in
    /// sRGB codes of 0 to 255
    #[arg(long, value_name = "X", allow_negative_numbers = true, value_parser = threshold)]
    max_difference: Option<f64>,
    /// Exposure at which EXR and HDR are shown, EV at ISO 100; needed beside a PNG [default: what shows A's logarithmic
    /// mean luminance as 18 %]
    #[arg(long, value_name = "EV100", allow_negative_numbers = true, value_parser = exposure)]
    exposure: Option<f32>,
    /// How bright values of EXR and HDR are brought into range
    #[arg(long, default_value = "neutral")]
    tone_mapping: ToneMappingArgument,
    #[command(flatten)]
    json: JsonArgument,
}

/// Reads, compares, prints; a threshold that is passed is a failure.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let Places { map, json } = Places::open(arguments)?;
    let a = Seen::from(Still::read(&arguments.a)?);
    let b = Seen::from(Still::read(&arguments.b)?);
    let display = display(arguments, &a, &b)?;
    let compared = difference(&a, &b, display.unwrap_or(AS_IT_IS))
        .map_err(|error| not_compared(arguments, &error))?;
    let [width, height] = a.size();
    if let Some(map) = map {
        let png = magma_png(&compared.flip, width, height)
            .map_err(|error| Failure::new(Exit::File, format_args!("the map: {error}")))?;
        map.write(&png)?;
    }
    let report = DiffReport {
        schema: DiffReport::SCHEMA,
        a: arguments.a.display().to_string(),
        b: arguments.b.display().to_string(),
        width,
        height,
        display: display.map(|display| DisplayRow {
            exposure_ev100: display.ev100.into(),
            chosen: arguments.exposure.is_none(),
            tone_mapping: arguments.tone_mapping.name(),
        }),
        difference: compared.row,
        program: Program::this(),
    };
    match json {
        Some(json) => write_json(json, &report)?,
        None => print_bytes(report.text().as_bytes())?,
    }
    judge(arguments, &report.difference)
}

/// Of two pictures that are codes already nothing is exposed.
const AS_IT_IS: Display = Display {
    ev100: 0.0,
    tone_mapping: crate::render::ToneMapping::None,
};

/// How the linear pictures are shown; none where none is linear.
fn display(arguments: &Arguments, a: &Seen, b: &Seen) -> Result<Option<Display>, Failure> {
    let ev100 = match (arguments.exposure, a, b) {
        (_, Seen::Codes { .. }, Seen::Codes { .. }) => return Ok(None),
        (Some(ev100), _, _) => ev100,
        (None, Seen::Linear(a), Seen::Linear(_)) => key_exposure(a),
        _ => {
            let message = "one picture is linear and the other is not: give the --exposure (EV100) and the \
                           --tone-mapping with which the other was made";
            return Err(Failure::new(Exit::Usage, message));
        }
    };
    Ok(Some(Display {
        ev100,
        tone_mapping: arguments.tone_mapping.mapping(),
    }))
}

/// Two sizes are a difference; what is no number cannot be compared.
fn not_compared(arguments: &Arguments, error: &NoDifference) -> Failure {
    let exit = match error {
        NoDifference::Sizes(..) => Exit::Compared,
        NoDifference::NotFinite { .. } => Exit::NotFinite,
    };
    let (a, b) = (arguments.a.display(), arguments.b.display());
    Failure::new(exit, format_args!("{a}, {b}: {error}"))
}

/// What makes a comparison a failure.
fn judge(arguments: &Arguments, row: &DifferenceRow) -> Result<(), Failure> {
    let gap = row.linear.as_ref().unwrap_or(&row.codes.gap);
    let unit = match row.linear {
        Some(_) => "",
        None => " sRGB codes",
    };
    let over = |value: f64, most: Option<f64>| most.filter(|most| value > *most);
    let mut passed = Vec::new();
    if let Some(most) = over(row.flip.mean, arguments.max_flip) {
        let mean = row.flip.mean;
        passed.push(format!("the mean of FLIP is {mean:.5}, more than {most}"));
    }
    if let Some(most) = over(gap.largest, arguments.max_difference) {
        let [x, y] = gap.at;
        let largest = gap.largest;
        passed.push(format!(
            "the largest difference is {largest}{unit}, more than {most}, at column {x}, row {y}"
        ));
    }
    match passed[..] {
        [] => Ok(()),
        _ => Err(Failure::new(Exit::Compared, passed.join("; "))),
    }
}

/// Where map and report go.
struct Places {
    map: Option<Output>,
    json: Option<Output>,
}

impl Places {
    /// Checks both before any work is done, and that nothing is written over anything.
    fn open(arguments: &Arguments) -> Result<Self, Failure> {
        let json = arguments.json.open()?;
        let map = arguments.output.as_deref().map(map_place).transpose()?;
        if let (Some(json), Some(path)) = (&json, &arguments.output)
            && json.is(path)
        {
            let message = "the map and the report go to the same place: give each its own";
            return Err(Failure::new(Exit::Usage, message));
        }
        for output in [&map, &json].into_iter().flatten() {
            for input in [&arguments.a, &arguments.b] {
                if output.is(input) {
                    let message = format!("{}: it would be overwritten", input.display());
                    return Err(Failure::new(Exit::Usage, message));
                }
            }
        }
        Ok(Self { map, json })
    }
}

/// The figures go to stdout, so the map does not.
fn map_place(path: &Path) -> Result<Output, Failure> {
    let png = path
        .extension()
        .is_some_and(|end| end.eq_ignore_ascii_case("png"));
    match png {
        true => Output::open(path),
        false => {
            let message = format!(
                "{}: the map is a PNG: give a name that ends in .png",
                path.display()
            );
            Err(Failure::new(Exit::Usage, message))
        }
    }
}

fn share(text: &str) -> Result<f64, String> {
    match threshold(text) {
        Ok(share) if share <= 1.0 => Ok(share),
        _ => Err("it is a number from 0 to 1".to_owned()),
    }
}

fn threshold(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number >= 0.0 && number.is_finite() => Ok(number),
        _ => Err("it is a number of at least 0".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_threshold_is_a_number_of_at_least_0() {
        assert_eq!(threshold("0"), Ok(0.0));
        assert_eq!(threshold("-0"), Ok(0.0));
        assert_eq!(threshold("1e3"), Ok(1000.0));
        for text in ["", "-1", "-1e-9", "nan", "inf", "x"] {
            assert!(threshold(text).is_err(), "{text}");
            assert!(share(text).is_err(), "{text}");
        }
        assert_eq!(share("1"), Ok(1.0));
        assert!(share("1.01").is_err());
    }
}
