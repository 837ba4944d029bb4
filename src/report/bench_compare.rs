//! What has changed between two reports of `umber bench`, and by more than they spread?

use std::collections::BTreeMap;

use super::bench::{BenchReport, BenchRow};
use super::bench_words::{bounds, group_key, plain};
use super::provenance::Device;

/// Two medians of a few frames are apart by chance, but seldom by this many times both their deviations.
const DEVIATIONS: f64 = 3.0;

/// What was found in two reports of one device.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct Comparison {
    /// Each figure that both have, beyond the spread or not, row by row.
    pub changes: Vec<Change>,
    /// Of the `relative`s whose intervals both have two bounds, the share whose intervals overlap; null where
    /// there are none. Bases are left out: they are 1 in both.
    pub overlapping: Option<f64>,
    /// The largest factor between two `relative`s, whichever way: at least 1. Bases are left out again.
    pub largest_factor: Option<f64>,
    /// Rows of the old report that the new one has not.
    pub only_old: Vec<usize>,
    /// Rows of the new report that the old one has not.
    pub only_new: Vec<usize>,
}

/// One figure in both.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct Change {
    /// The row in the new report.
    pub row: usize,
    /// `relative` or `record_ns_per_draw`.
    pub quantity: &'static str,
    /// It was this.
    pub old: f64,
    /// It is this.
    pub new: f64,
    /// `new` over `old`.
    pub factor: f64,
    /// Whether the spread of both does not explain it: intervals that do not overlap, or for
    /// `record_ns_per_draw` more than three times both deviations.
    pub beyond_spread: bool,
}

/// Figures that say nothing about each other.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum OtherDevice {
    /// Another device, or another driver.
    #[error("measured on {old} and on {new}: times compare on one device and driver only")]
    Device {
        /// That of the old report.
        old: String,
        /// That of the new one.
        new: String,
    },
    /// `relative` is not the same quantity.
    #[error("measured by the method {old} and by the method {new}: measure both the same way")]
    Method {
        /// That of the old report.
        old: String,
        /// That of the new one.
        new: String,
    },
}

/// A row's mode and order, and its cell.
type Key<'r> = (&'r str, &'r str, super::bench_words::Group<'r>);

/// Pairs the rows, and says what changed.
pub fn compare(old: &BenchReport, new: &BenchReport) -> Result<Comparison, OtherDevice> {
    let identity = |device: &Device| {
        let parts = [&device.name, &device.driver, &device.driver_version];
        let [name, driver, version] = parts.map(|text| plain(text));
        format!("{name} ({driver} {version})")
    };
    let names = |device: &Device| {
        let parts = [&device.name, &device.driver, &device.driver_version];
        parts.map(String::clone)
    };
    if names(&old.device) != names(&new.device) {
        let (old, new) = (identity(&old.device), identity(&new.device));
        return Err(OtherDevice::Device { old, new });
    }
    if old.method.name != new.method.name {
        let (old, new) = (plain(&old.method.name), plain(&new.method.name));
        return Err(OtherDevice::Method { old, new });
    }
    Ok(paired(old, new))
}

fn paired(old: &BenchReport, new: &BenchReport) -> Comparison {
    // A cell may be there twice: its first row pairs with the first, its second with the second.
    let mut places: BTreeMap<Key, Vec<usize>> = BTreeMap::new();
    for (i, row) in old.rows.iter().enumerate().rev() {
        places.entry(key(row)).or_default().push(i);
    }
    let mut changes = Vec::new();
    let mut only_new = Vec::new();
    let mut overlaps = Vec::new();
    let mut largest: Option<f64> = None;
    for (i, after) in new.rows.iter().enumerate() {
        let Some(at) = places.get_mut(&key(after)).and_then(Vec::pop) else {
            only_new.push(i);
            continue;
        };
        let before = &old.rows[at];
        let overlap = overlap(before, after);
        let apart = overlap == Some(false);
        if let Some(change) = change(i, "relative", before.relative, after.relative, apart) {
            if after.mode != after.base {
                let factor = change.factor.max(1.0 / change.factor);
                largest = Some(largest.map_or(factor, |most| most.max(factor)));
                overlaps.extend(overlap);
            }
            changes.push(change);
        }
        let (from, to) = (before.record_ns_per_draw, after.record_ns_per_draw);
        let apart = recording_apart(before, after);
        changes.extend(change(i, "record_ns_per_draw", from, to, apart));
    }
    let share = |some: usize| some as f64 / overlaps.len() as f64;
    let mut only_old: Vec<usize> = places.into_values().flatten().collect();
    only_old.sort_unstable();
    Comparison {
        overlapping: (!overlaps.is_empty())
            .then(|| share(overlaps.iter().filter(|overlap| **overlap).count())),
        largest_factor: largest,
        changes,
        only_old,
        only_new,
    }
}

fn key(row: &BenchRow) -> Key<'_> {
    (&row.mode, &row.order, group_key(row))
}

/// A figure that both have, and that has a factor.
fn change(
    row: usize,
    quantity: &'static str,
    old: Option<f64>,
    new: Option<f64>,
    beyond_spread: bool,
) -> Option<Change> {
    let (old, new) = (old?, new?);
    let factor = new / old;
    (factor.is_finite() && factor > 0.0).then_some(Change {
        row,
        quantity,
        old,
        new,
        factor,
        beyond_spread,
    })
}

/// Whether the intervals of both overlap, where both have two bounds.
fn overlap(old: &BenchRow, new: &BenchRow) -> Option<bool> {
    let (a, b) = (bounds(old.relative_95)?, bounds(new.relative_95)?);
    Some(a.0 <= b.1 && b.0 <= a.1)
}

fn recording_apart(old: &BenchRow, new: &BenchRow) -> bool {
    let apart = || {
        let difference = (new.record_ns_per_draw? - old.record_ns_per_draw?).abs();
        Some(difference > DEVIATIONS * (old.record_mad? + new.record_mad?))
    };
    apart().unwrap_or(false)
}
