//! How does `umber models` go from the ladders to a table of their errors?

use crate::cli::exit::Failure;
use crate::cli::output::{JsonArgument, print_bytes, progress_bar, talk, write_json};
use crate::report::{Machine, ModelsReport, Program};
use crate::studies::Cache;
use crate::studies::ladders::{self, PATHS, STEPS, TRUTHS};

/// Options of `umber models`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Paths that are followed for each angle of the light on each surface; the truths' own error falls with their root
    #[arg(long, value_name = "N", default_value_t = PATHS as u32, value_parser = clap::value_parser!(u32).range(1024..=1 << 24))]
    paths: u32,
    #[command(flatten)]
    json: JsonArgument,
    /// Say nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

/// How far it is.
const BAR: &str = "{bar:40} {pos}/{len} parts of the truths, {eta}";

/// Makes the truths that are not kept yet, holds the tiers against them, prints.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let json = arguments.json.open()?;
    let quiet = arguments.quiet;
    let bar = progress_bar(quiet, TRUTHS * STEPS, BAR);
    let folder = dirs::cache_dir().map(|folder| ladders::folder(&folder.join("umber")));
    let cache = Cache::new(folder.as_deref(), move |text| {
        if !quiet {
            talk(format_args!("warning: {text}"));
        }
    });
    let rows = ladders::errors(&cache, arguments.paths as usize, &|steps| bar.inc(steps));
    bar.finish_and_clear();
    let report = ModelsReport {
        schema: ModelsReport::SCHEMA,
        machine: Machine::this(),
        seed: ladders::SEED,
        rows,
        program: Program::this(),
    };
    match json {
        Some(json) => write_json(json, &report),
        None => print_bytes(report.table().as_bytes()),
    }
}
