//! How does `umber stability` go from functions to a table of what they keep?

use std::path::PathBuf;

use indicatif::ProgressBar;

use crate::cli::exit::{Exit, Failure, judge_messages};
use crate::cli::options::{DeviceArgument, count, software};
use crate::cli::output::{JsonArgument, Output, print_bytes, progress_bar, talk, write_json};
use crate::cli::reports;
use crate::gpu::{Device, Error};
use crate::render::library::{FUNCTIONS, Function, Tier};
use crate::report::{
    Machine, Program, StabilityReport, read_stability, stability_beside, stability_page,
};
use crate::scene::suggest;
use crate::studies::stability::{Amount, CASES, Case, Study, costs};

/// Options of `umber stability`.
#[derive(clap::Args)]
pub struct Arguments {
    /// A hundred million evaluations [default]
    #[arg(long, conflicts_with = "full")]
    quick: bool,
    /// Ten thousand million evaluations
    #[arg(long)]
    full: bool,
    /// The functions, with commas between them [default: all; `umber eval --list` tells them]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = Function::of_name)]
    function: Vec<&'static Function>,
    /// The tiers: f16, f32, f32-compensated [default: all]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = Tier::of_name)]
    tier: Vec<Tier>,
    /// The cases of the corpus [default: all]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = case)]
    case: Vec<&'static Case>,
    /// Inputs of each case
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    inputs: Option<u32>,
    /// Draws the inputs
    #[arg(long, default_value = "1")]
    seed: u64,
    #[command(flatten)]
    device: DeviceArgument,
    #[command(flatten)]
    json: JsonArgument,
    /// Write one page with maps of the bits lost, method and machine
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
    /// Say in what another report differs: another device's, say; with --json on stderr
    #[arg(long, value_name = "OTHER.json")]
    beside: Option<PathBuf>,
    /// Evaluate nothing: take the rows of a report
    #[arg(long, value_name = "FILE.json",
          conflicts_with_all = ["quick", "full", "function", "tier", "case", "inputs", "seed", "device", "validation"])]
    read: Option<PathBuf>,
    /// Tell the cases of the corpus
    #[arg(long)]
    list: bool,
    /// Say nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

/// How far it is.
const BAR: &str = "{bar:40} {human_pos}/{human_len} values, {eta}: {msg}";

/// Functions whose bits are mapped, listing and library side by side.
const MAPPED: [&str; 4] = [
    "oren-nayar",
    "cook-torrance",
    "slides-oren-nayar",
    "slides-cook-torrance",
];

/// Ten million values of each function in each tier, 3.5e8 without the listings.
const QUICK: Amount = Amount {
    case: 1 << 14,
    chance: 9_000_000,
    worst: 1_000_000,
    seed: 0,
};

/// 1.1e10 without the listings, and no function below 3e8.
const FULL: Amount = Amount {
    case: 1 << 18,
    chance: 300_000_000,
    worst: 20_000_000,
    seed: 0,
};

impl Arguments {
    fn amount(&self) -> Amount {
        let plan = if self.full { FULL } else { QUICK };
        Amount {
            case: self.inputs.map_or(plan.case, |inputs| inputs as usize),
            seed: self.seed,
            ..plan
        }
    }

    /// Functions in tiers, in the order of the table.
    fn asked(&self) -> Vec<(&'static Function, Tier)> {
        let wanted = |function: &&Function| {
            self.function.is_empty() || self.function.iter().any(|f| f == function)
        };
        let functions = FUNCTIONS.iter().filter(wanted);
        let tier = |tier: &Tier| self.tier.is_empty() || self.tier.contains(tier);
        functions
            .flat_map(|function| {
                let tiers = function.tiers.iter().copied().filter(tier);
                tiers.map(move |tier| (function, tier))
            })
            .collect()
    }

    fn cases(&self) -> Vec<&'static Case> {
        match self.case[..] {
            [] => CASES.iter().collect(),
            _ => self.case.clone(),
        }
    }

    /// What the report calls the plan.
    fn plan(&self) -> &'static str {
        let own = self.inputs.is_some() || !self.case.is_empty();
        match (own, self.full) {
            (true, _) => "custom",
            (false, true) => "full",
            (false, false) => "quick",
        }
    }
}

fn case(name: &str) -> Result<&'static Case, String> {
    let found = CASES.iter().find(|case| case.name == name);
    found.ok_or_else(|| suggest::unknown("case", name, CASES.iter().map(|case| case.name)))
}

/// Evaluates, judges, prints; a broken promise is a failure.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.list {
        return print_bytes(list().as_bytes());
    }
    let inputs = [&arguments.read, &arguments.beside];
    let mut taken: Vec<&PathBuf> = inputs.into_iter().flatten().collect();
    let json = Output::open_apart(arguments.json.json.as_ref(), &mut taken)?;
    let page = Output::open_apart(arguments.report.as_ref(), &mut taken)?;
    let read = |path: &PathBuf| reports::read(path, read_stability);
    let there = arguments.beside.as_ref().map(read).transpose()?;
    let there = there.as_ref();
    let (report, messages) = match &arguments.read {
        Some(path) => (read(path)?, 0),
        None => evaluated(arguments)?,
    };
    if let Some(page) = page {
        page.write(stability_page(&report, there).as_bytes())?;
    }
    let beside = there.map(|there| stability_beside(&report, there));
    match json {
        Some(json) => {
            write_json(json, &report)?;
            if let Some(beside) = beside.filter(|_| !arguments.quiet) {
                talk(beside.trim_end());
            }
        }
        None => {
            let mut text = report.table(software(&report.device.kind));
            if let Some(beside) = beside {
                text += "\n";
                text += &beside;
            }
            print_bytes(text.as_bytes())?;
        }
    }
    judge_messages(messages)?;
    judge(&report)
}

/// What the device makes of the functions, and how many messages validation had.
fn evaluated(arguments: &Arguments) -> Result<(StabilityReport, usize), Failure> {
    let device = arguments.device.open()?;
    let bar = progress_bar(arguments.quiet, values(arguments), BAR);
    let mut report = StabilityReport {
        schema: StabilityReport::SCHEMA.to_owned(),
        device: device.info().into(),
        machine: Machine::this(),
        plan: arguments.plan().to_owned(),
        seed: arguments.seed,
        evaluations: 0,
        rows: Vec::new(),
        costs: Vec::new(),
        maps: Vec::new(),
        program: Program::this(),
    };
    let done = study(arguments, &device, &bar, &mut report);
    bar.finish_and_clear();
    let messages = device.instance().validation_log().drain();
    messages.iter().for_each(talk);
    done?;
    Ok((report, messages.len()))
}

fn study(
    arguments: &Arguments,
    device: &std::sync::Arc<Device>,
    bar: &ProgressBar,
    report: &mut StabilityReport,
) -> Result<(), Error> {
    let amount = arguments.amount();
    let progress = |values| bar.inc(values);
    for (function, tier) in arguments.asked() {
        bar.set_message(format!("{}, {}", function.name, tier.name()));
        let study = Study::new(device, function, tier, amount)?;
        for case in arguments.cases() {
            report.rows.push(study.case(case, &progress)?);
        }
        if arguments.case.is_empty() {
            report.rows.push(study.chance(&progress)?);
            report.rows.extend(study.worst(&progress)?);
            report.rows.extend(study.search(&progress)?);
            let readings = arguments
                .cases()
                .into_iter()
                .flat_map(|case| study.readings(case));
            let mut readings: Vec<_> = readings.collect();
            readings.sort_by(|a, b| a.tier.cmp(&b.tier));
            report.rows.extend(readings);
            if MAPPED.contains(&function.name) && tier != Tier::F16 {
                report.maps.push(study.map()?);
            }
        }
    }
    if arguments.case.is_empty() && arguments.function.is_empty() {
        bar.set_message("costs");
        report.costs = costs(device)?;
    }
    report.evaluations = report.rows.iter().map(|row| row.inputs).sum();
    Ok(())
}

fn judge(report: &StabilityReport) -> Result<(), Failure> {
    let broken: Vec<_> = report.broken().collect();
    for row in &broken {
        let worst = row.worst_input.as_deref().unwrap_or_default();
        talk(format_args!(
            "{}, {}, {}: worst at {worst}",
            row.function, row.tier, row.case
        ));
    }
    if broken.is_empty() {
        return Ok(());
    }
    let rows = count(broken.len() as u64, "row");
    let message = format!("{rows} of {} break a promise", report.rows.len());
    Err(Failure::new(Exit::Compared, message))
}

fn list() -> String {
    let lines = CASES.iter().map(|case| {
        let Case {
            name, what, source, ..
        } = case;
        format!("{name}\n  {what}\n  from {source}\n")
    });
    lines.collect()
}

/// Values that will be made, but for those of the search, which ends when it ends.
fn values(arguments: &Arguments) -> u64 {
    let amount = arguments.amount();
    let by_chance = match arguments.case.is_empty() {
        true => amount.chance + amount.worst,
        false => 0,
    };
    let each = (arguments.cases().len() * amount.case) as u64 + by_chance;
    arguments.asked().len() as u64 * each
}
