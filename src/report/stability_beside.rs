//! In what do two reports differ, function by function?

use super::stability::{SUMMARY_ALIGN, SUMMARY_HEAD, StabilityReport, Summary, summary_cells};
use super::table::write_table;

/// A report's figures of a function in a tier.
pub(super) struct Figures {
    /// The function.
    pub function: String,
    /// As the columns of [`head`] have them.
    pub cells: [String; 9],
}

/// The columns of all cases together, with whose they are in place of the function.
pub(super) fn head() -> [&'static str; 9] {
    let mut head = SUMMARY_HEAD;
    head[0] = "report";
    head
}

/// Two reports, side by side.
pub(super) struct Beside {
    /// What they are, and in how much they differ.
    pub about: String,
    /// Of each function in each tier in which they differ the figures here, and then there.
    pub rows: Vec<Figures>,
}

impl Beside {
    /// Compares what both have.
    pub fn new(here: &StabilityReport, there: &StabilityReport) -> Self {
        let (mine, others) = (here.summaries(), there.summaries());
        let (mut rows, mut both) = (Vec::new(), 0);
        for one in &mine {
            let same =
                |other: &&Summary| (&other.function, &other.tier) == (&one.function, &one.tier);
            let Some(other) = others.iter().find(same) else {
                continue;
            };
            both += 1;
            let (ours, theirs) = (summary_cells(one), summary_cells(other));
            if ours != theirs {
                rows.extend([figures("here", ours), figures("there", theirs)]);
            }
        }
        let alone = mine.len() + others.len() - 2 * both;
        let about = format!(
            "here: {}; there: {}. Of {both} functions in their tiers that both have, {} have other figures there; {alone} are in one alone.",
            made(here),
            made(there),
            rows.len() / 2,
        );
        Self { about, rows }
    }
}

/// On what, by what and how a report was made.
fn made(report: &StabilityReport) -> String {
    let device = &report.device;
    format!(
        "{}, {} {}, revision {}, plan {}, seed {}",
        device.name,
        device.driver,
        device.driver_version,
        report.program.revision,
        report.plan,
        report.seed
    )
}

fn figures(whose: &str, mut cells: [String; 9]) -> Figures {
    let function = std::mem::replace(&mut cells[0], whose.to_owned());
    Figures { function, cells }
}

/// What a person reads.
pub fn table(here: &StabilityReport, there: &StabilityReport) -> String {
    let Beside { about, rows } = Beside::new(here, there);
    let mut text = about + "\n";
    if !rows.is_empty() {
        let rows = rows.into_iter().map(|row| (row.function, row.cells));
        write_table(&mut text, head(), SUMMARY_ALIGN, rows);
    }
    text
}
