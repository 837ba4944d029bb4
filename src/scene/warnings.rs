//! What was passed over while a file was read?

/// Warnings that are kept of one file: more are counted only, so that no file fills the memory or
/// the terminal with them.
const KEPT: usize = 100;

/// The warnings of one file.
#[derive(Debug, Default)]
pub(super) struct Warnings {
    kept: Vec<String>,
    more: usize,
}

impl Warnings {
    /// Adds a warning.
    pub(super) fn push(&mut self, warning: String) {
        if self.kept.len() < KEPT {
            self.kept.push(warning);
        } else {
            self.more += 1;
        }
    }

    /// The warnings as text, with a last line that counts those not kept.
    pub(super) fn into_text(mut self) -> Vec<String> {
        if self.more > 0 {
            self.kept.push(format!("and {} more warnings", self.more));
        }
        self.kept
    }
}
