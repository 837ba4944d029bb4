//! How does `umber bench` go from a plan to rows, and from rows to what people read?

mod arguments;
mod group_process;
mod heap;
mod measuring;
mod places;

pub use arguments::Arguments;

use std::path::Path;

use measuring::{measured, print_creation};
use places::Places;

use crate::cli::exit::{Exit, Failure};
use crate::cli::output::talk;
use crate::cli::reports;
use crate::report::{BenchReport, Comparison, compare, read_bench};

/// Measures, keeps, prints, compares.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if let Some(mode) = arguments.creation_of {
        return print_creation(arguments, mode);
    }
    if let Some(place) = arguments.group {
        return group_process::answer(arguments, place);
    }
    if arguments.read.is_none() {
        heap::keep();
    }
    let places = Places::open(arguments)?;
    let baseline = arguments.baseline.as_deref().map(read).transpose()?;
    let report = match &arguments.read {
        Some(path) => read(path)?,
        None => measured(arguments)?,
    };
    places.write(&report)?;
    match baseline {
        Some(old) => judge(arguments, &old, &report),
        None => Ok(()),
    }
}

/// An earlier report, checked.
pub(super) fn read(path: &Path) -> Result<BenchReport, Failure> {
    reports::read(path, read_bench)
}

/// Says what changed, and fails where something grew past the threshold.
fn judge(arguments: &Arguments, old: &BenchReport, new: &BenchReport) -> Result<(), Failure> {
    let comparison = compare(old, new).map_err(|error| Failure::new(Exit::Usage, error))?;
    tell(&comparison, new);
    let grown = comparison
        .changes
        .iter()
        .filter(|change| change.beyond_spread && change.factor > arguments.threshold);
    match grown.count() {
        0 => Ok(()),
        count => {
            let message = format!(
                "{count} of {} figures grew beyond the spread and by more than {} times",
                comparison.changes.len(),
                arguments.threshold
            );
            Err(Failure::new(Exit::Compared, message))
        }
    }
}

/// The comparison is talk: stdout has the table.
fn tell(comparison: &Comparison, new: &BenchReport) {
    for change in comparison.changes.iter().filter(|c| c.beyond_spread) {
        let row = &new.rows[change.row];
        talk(format_args!(
            "{}, {}, {}, {} materials, {} draws: {} was {:.3}, is {:.3} ({:.2} times)",
            row.mode,
            row.order,
            row.scene,
            row.materials,
            row.draws,
            change.quantity,
            change.old,
            change.new,
            change.factor,
        ));
    }
    if let (Some(share), Some(factor)) = (comparison.overlapping, comparison.largest_factor) {
        talk(format_args!(
            "{:.1} % of the ratios overlap in their 95 % intervals; the largest factor between two is {factor:.2}",
            share * 100.0
        ));
    }
    let (old, new) = (comparison.only_old.len(), comparison.only_new.len());
    if old + new > 0 {
        talk(format_args!(
            "{old} rows are in the earlier report alone, {new} in this one"
        ));
    }
}
