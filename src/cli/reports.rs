//! How does a verb get an earlier report?

use std::fmt::Display;
use std::path::Path;

use crate::cli::exit::{Exit, Failure};
use crate::report::BadReport;

/// A report from a file, checked by `parse`.
pub fn read<R>(path: &Path, parse: fn(&[u8]) -> Result<R, BadReport>) -> Result<R, Failure> {
    let place = path.display();
    let failure = |what: &dyn Display| Failure::new(Exit::File, what);
    let bytes = std::fs::read(path)
        .map_err(|error| failure(&format_args!("cannot read {place}: {error}")))?;
    parse(&bytes).map_err(|error| failure(&format_args!("{place}: {error}")))
}
