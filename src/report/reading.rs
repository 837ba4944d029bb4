//! Is a file an earlier report of Umber's? Nothing of it is used before all of it is checked.

use std::ops::RangeInclusive;

use serde::de::DeserializeOwned;

use super::bench_words::plain;
use super::interval::Interval95;
use super::provenance::{Device, Machine, Program};

const LONGEST_TEXT: usize = 10_000;

/// A file that is no such report: what is wrong, where, and what to do.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{what}; give a report that `{verb} --json=FILE` of this version wrote")]
pub struct BadReport {
    what: String,
    verb: &'static str,
}

/// Only the name of the layout, which decides whether the rest is read.
#[derive(serde::Deserialize)]
struct Layout {
    schema: String,
}

/// A report of `verb`, whose layout is `schema`, if `check` finds nothing that the verb would not have written.
pub fn of_schema<R: DeserializeOwned>(
    bytes: &[u8],
    schema: &str,
    verb: &'static str,
    check: impl FnOnce(&R) -> Result<(), String>,
) -> Result<R, BadReport> {
    let bad = |what| BadReport { what, verb };
    let layout: Layout = serde_json::from_slice(bytes).map_err(|error| {
        let what = match error.is_data() {
            true => "no report of Umber",
            false => "no JSON",
        };
        bad(format!("{what}: {error}"))
    })?;
    if layout.schema != schema {
        let found = shown(&layout.schema);
        return Err(bad(format!("its schema is {found} and not \"{schema}\"")));
    }
    let report = serde_json::from_slice(bytes)
        .map_err(|error| bad(format!("not all of a report: {error}")))?;
    check(&report).map_err(bad)?;
    Ok(report)
}

/// On what, and by what, it was made.
pub fn check_made(device: &Device, machine: &Machine, program: &Program) -> Result<(), String> {
    let texts = [
        ("device.name", &device.name),
        ("device.type", &device.kind),
        ("device.driver", &device.driver),
        ("device.driver_version", &device.driver_version),
        ("device.api", &device.api),
        ("device.uuid", &device.uuid),
        ("machine.processor", &machine.processor),
        ("machine.system", &machine.system),
        ("program.version", &program.version),
        ("program.revision", &program.revision),
        ("program.clock", &program.clock),
    ];
    texts
        .into_iter()
        .try_for_each(|(name, text)| check_text(name, text))
}

/// Names and notes are short, and go to terminals as they are.
pub fn check_text(name: &str, text: &str) -> Result<(), String> {
    if text.len() > LONGEST_TEXT {
        return Err(format!("{name} has {} bytes", text.len()));
    }
    match plain(text) == text {
        true => Ok(()),
        false => Err(format!("{name} has control characters: {}", shown(text))),
    }
}

/// A count that is not past any that was measured.
pub fn check_count(name: &str, count: u64, most: u64) -> Result<(), String> {
    match count <= most {
        true => Ok(()),
        false => Err(format!("{name} is {count}, more than {most}")),
    }
}

/// A figure of at least 0.
pub fn check_figure(name: &str, figure: f64, most: f64) -> Result<(), String> {
    check_within(name, figure, 0.0..=most)
}

/// A figure in a range.
pub fn check_within(name: &str, figure: f64, range: RangeInclusive<f64>) -> Result<(), String> {
    let (least, most) = (range.start(), range.end());
    match range.contains(&figure) {
        true => Ok(()),
        false => Err(format!(
            "{name} is {figure}, not between {least} and {most}"
        )),
    }
}

/// Bounds in a range that holds 0, the lower one first.
pub fn check_interval(
    name: &str,
    interval: Interval95,
    range: RangeInclusive<f64>,
) -> Result<(), String> {
    let Interval95 { low, high } = interval;
    check_within(name, low.unwrap_or(0.0), range.clone())?;
    check_within(name, high.unwrap_or(0.0), range)?;
    match (low, high) {
        (Some(low), Some(high)) if low > high => {
            Err(format!("{name} runs from {low} down to {high}"))
        }
        _ => Ok(()),
    }
}

/// The beginning of a text, quoted, with its control characters spelled out.
fn shown(text: &str) -> String {
    let short: String = text.chars().take(40).collect();
    format!("{short:?}")
}
