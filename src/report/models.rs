//! How far is each tier of the ladders from its truth: as rows, and as a table?

use super::provenance::{Machine, Program};
use super::table::{Align, write_table};

/// `umber.models/1`.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct ModelsReport {
    /// Names this layout.
    pub schema: &'static str,
    /// What computed.
    pub machine: Machine,
    /// Draws the paths of the truths.
    pub seed: u64,
    /// Tier by tier.
    pub rows: Vec<ModelRow>,
    /// What made this report.
    pub program: Program,
}

impl ModelsReport {
    /// The layout that `schema` names.
    pub const SCHEMA: &'static str = "umber.models/1";
}

/// A tier of a term.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct ModelRow {
    /// `diffuse`, `specular` or `fresnel`.
    pub term: String,
    /// The tier's name.
    pub tier: String,
    /// What it is held against.
    pub truth: String,
    /// Each surface that it was held against.
    pub cases: Vec<ModelCase>,
    /// At albedo 1 or F = 1, the largest distance of the directional albedo from 1, over roughness and angle; null for Fresnel terms.
    pub albedo_error_max: Option<f64>,
    /// The largest change of f where light and eye change places, of f; null for Fresnel terms.
    pub reciprocity_error_max: Option<f64>,
}

/// A tier on one surface. Of Fresnel terms errors are absolute, else they are shares of the truth.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct ModelCase {
    /// What tells the surface from others.
    pub surface: String,
    /// Root mean square error, weighed by the cosines of light and eye.
    pub error_rms: f64,
    /// The largest error at any of the angles, where the truth is at least a thousandth of its peak.
    pub error_max: f64,
    /// The RMS with roughness and albedo free; null where nothing is free.
    pub refitted_rms: Option<f64>,
    /// Standard error of the truth, in the measure of `error_rms`.
    pub truth_noise: f64,
}

impl ModelRow {
    fn range(&self, of: impl Fn(&ModelCase) -> Option<f64>) -> Option<(f64, f64)> {
        let values: Vec<f64> = self.cases.iter().filter_map(of).collect();
        let low = values.iter().copied().reduce(f64::min)?;
        let high = values.iter().copied().reduce(f64::max)?;
        Some((low, high))
    }

    /// The smallest and the largest RMS over the surfaces.
    pub fn rms(&self) -> Option<(f64, f64)> {
        self.range(|case| Some(case.error_rms))
    }

    /// The same with free parameters.
    pub fn refitted(&self) -> Option<(f64, f64)> {
        self.range(|case| case.refitted_rms)
    }

    fn largest(&self) -> Option<f64> {
        self.range(|case| Some(case.error_max)).map(|range| range.1)
    }

    fn noise(&self) -> Option<f64> {
        self.range(|case| Some(case.truth_noise))
            .map(|range| range.1)
    }
}

impl ModelsReport {
    /// The table as a person reads it.
    pub fn table(&self) -> String {
        const COLUMNS: usize = 8;
        let head = [
            "tier",
            "RMS %",
            "refitted %",
            "largest %",
            "albedo off %",
            "reciprocity off %",
            "truth ± %",
            "truth",
        ];
        let mut align = [Align::Right; COLUMNS];
        (align[0], align[COLUMNS - 1]) = (Align::Left, Align::Left);
        let rows = self.rows.iter().map(|row| {
            let cells = [
                row.tier.clone(),
                range(row.rms()),
                range(row.refitted()),
                percent(row.largest()),
                percent(row.albedo_error_max),
                percent(row.reciprocity_error_max),
                percent(row.noise()),
                row.truth.clone(),
            ];
            (row.term.clone(), cells)
        });
        let mut text = String::new();
        write_table(&mut text, head, align, rows);
        text
    }
}

fn range(range: Option<(f64, f64)>) -> String {
    match range {
        Some((low, high)) if digits(low) == digits(high) => digits(low),
        Some((low, high)) => format!("{} to {}", digits(low), digits(high)),
        None => "-".to_owned(),
    }
}

fn percent(share: Option<f64>) -> String {
    share.map_or_else(|| "-".to_owned(), digits)
}

/// Two digits that count, in percent.
fn digits(share: f64) -> String {
    let percent = share * 100.0;
    match percent {
        0.0..0.001 => "0".to_owned(),
        0.001..0.1 => format!("{percent:.3}"),
        0.1..1.0 => format!("{percent:.2}"),
        _ => format!("{percent:.1}"),
    }
}
