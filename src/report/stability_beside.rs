//! In what do two devices differ, function by function?

use super::stability::{SUMMARY_ALIGN, SUMMARY_HEAD, StabilityReport, summary_cells};
use super::table::write_table;

/// A device's figures of a function in a tier.
pub(super) struct Figures {
    /// The function.
    pub function: String,
    /// As the columns of [`head`] have them.
    pub cells: [String; 9],
}

/// The columns of all cases together, with whose they are in place of the function.
pub(super) fn head() -> [&'static str; 9] {
    let mut head = SUMMARY_HEAD;
    head[0] = "device";
    head
}

/// What both have made and in which they differ, this device's figures and then the other's.
pub(super) fn differing(here: &StabilityReport, there: &StabilityReport) -> Vec<[Figures; 2]> {
    let others = there.summaries();
    let mut pairs = Vec::new();
    for one in here.summaries() {
        let same = others
            .iter()
            .find(|other| (&other.function, &other.tier) == (&one.function, &one.tier));
        let Some(other) = same else {
            continue;
        };
        let (ours, theirs) = (summary_cells(&one), summary_cells(other));
        if ours != theirs {
            pairs.push([figures("here", ours), figures("there", theirs)]);
        }
    }
    pairs
}

fn figures(whose: &str, mut cells: [String; 9]) -> Figures {
    let function = std::mem::replace(&mut cells[0], whose.to_owned());
    Figures { function, cells }
}

/// Who is meant by `there`, and in how much it differs.
pub(super) fn about(here: &StabilityReport, there: &StabilityReport) -> String {
    format!(
        "here: this device; there: {}, {} {}, revision {}. Of {} functions in their tiers {} have other figures there.",
        there.device.name,
        there.device.driver,
        there.device.driver_version,
        there.program.revision,
        here.summaries().len(),
        differing(here, there).len(),
    )
}

/// The table as a person reads it.
pub fn table(here: &StabilityReport, there: &StabilityReport) -> String {
    let mut text = format!("\n{}\n", about(here, there));
    let rows = differing(here, there).into_iter().flatten();
    write_table(
        &mut text,
        head(),
        SUMMARY_ALIGN,
        rows.map(|row| (row.function, row.cells)),
    );
    text
}
