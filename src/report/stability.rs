//! Where does which function stay with its truth: as rows, and as a table?

use super::bench_words::thousands;
use super::interval::Interval95;
use super::provenance::{Device, Machine, Program};
use super::table::{Align, write_table};

/// `umber.stability/1`.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct StabilityReport {
    /// Names this layout.
    pub schema: String,
    /// What evaluated.
    pub device: Device,
    /// What it stands in.
    pub machine: Machine,
    /// `quick`, `full` or `custom`.
    pub plan: String,
    /// Draws the inputs.
    pub seed: u64,
    /// Values made in all.
    pub evaluations: u64,
    /// Function by function, tier by tier, case by case.
    pub rows: Vec<StabilityRow>,
    /// What the safe forms cost; empty where only some cases were asked for.
    pub costs: Vec<CostRow>,
    /// Bits lost over roughness and angle; empty where only some cases were asked for.
    pub maps: Vec<BitsMap>,
    /// What made this report.
    pub program: Program,
}

/// A function in a tier and a case. Errors are null where nothing is promised at any of the inputs (`judged` is 0), and where the
/// largest is infinite: something where the truth is nothing.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct StabilityRow {
    /// The function; the slides' listings are named `slides-*`.
    pub function: String,
    /// `f16`, `f32` or `f32-compensated`; of a listing also what a processor makes of it by each reading of `min` and `max`.
    pub tier: String,
    /// A case of the corpus; `chance` (drawn at random, every hundredth judged), `worst` (of each hundred the one at
    /// which the tiers differ most) or `search` (what climbing from the worst finds).
    pub case: String,
    /// Values made.
    pub inputs: u64,
    /// Of which held against the truth.
    pub judged: u64,
    /// Of which NaN.
    pub nan: u64,
    /// Of which infinite.
    pub inf: u64,
    /// Of which below 0.
    pub negative: u64,
    /// The largest error, of the truth.
    pub max_relative_error: Option<f64>,
    /// The mean error, of the truth.
    pub mean_relative_error: Option<f64>,
    /// The largest error, of what is promised where it occurred: up to 1 the promise holds.
    pub max_of_bound: Option<f64>,
    /// The largest error in units of the last place of the truth.
    pub max_ulp: Option<f64>,
    /// log2(1 + max_ulp): how many of a float's 24 bits are wrong at worst.
    pub max_bits_lost: Option<f64>,
    /// The worst input: N, L, E, roughness, f0 in decimal, and their bits. One whose value is no number or below 0 comes
    /// first.
    pub worst_input: Option<String>,
}

/// What a function in a tier costs, net of reading inputs and writing results.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct CostRow {
    /// The function.
    pub function: String,
    /// The tier.
    pub tier: String,
    /// The slides' listing that it stands for.
    pub listing: String,
    /// Median of an evaluation, ns.
    pub ns: f64,
    /// Median of one of the listing, ns.
    pub listing_ns: f64,
    /// The median of the ratios, sample by sample.
    pub relative: f64,
    /// Its interval.
    pub relative_95: Interval95,
}

/// How many bits a function in a tier loses, over roughness and the angle of the light.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct BitsMap {
    /// The function.
    pub function: String,
    /// The tier.
    pub tier: String,
    /// The roughness of each column.
    pub roughness: Vec<f64>,
    /// The angle of the light to the normal of each row, degrees.
    pub degrees: Vec<f64>,
    /// Row by row the most bits lost in a cell; null where nothing is promised.
    pub bits: Vec<Vec<Option<f64>>>,
    /// Row by row how many values are NaN, infinite or below 0.
    pub bad: Vec<Vec<u32>>,
}

/// All rows of a function in a tier.
#[derive(Clone, PartialEq, Debug)]
pub struct Summary {
    /// The function.
    pub function: String,
    /// The tier.
    pub tier: String,
    /// Values made.
    pub inputs: u64,
    /// Of which NaN.
    pub nan: u64,
    /// Of which infinite.
    pub inf: u64,
    /// Of which below 0.
    pub negative: u64,
    /// The largest error, of the truth.
    pub max_relative_error: Option<f64>,
    /// The largest error, of what is promised where it occurred; none where nothing is.
    pub of_bound: Option<f64>,
    /// The most bits lost.
    pub max_bits_lost: Option<f64>,
    /// Its worst row: one with a value that is none or below 0, or that of the largest error over its bound.
    pub row: usize,
}

impl StabilityReport {
    /// The layout that `schema` names.
    pub const SCHEMA: &'static str = "umber.stability/1";

    /// The rows in which a promise is broken.
    pub fn broken(&self) -> impl Iterator<Item = &StabilityRow> {
        self.rows.iter().filter(|row| row.is_broken())
    }

    /// Each function in each tier, in the order of the rows.
    pub fn summaries(&self) -> Vec<Summary> {
        let mut summaries: Vec<Summary> = Vec::new();
        for (i, row) in self.rows.iter().enumerate() {
            match summaries.last_mut() {
                Some(last) if (&last.function, &last.tier) == (&row.function, &row.tier) => {
                    last.add(i, row, &self.rows);
                }
                _ => summaries.push(Summary::of(i, row)),
            }
        }
        summaries
    }

    /// The table as a person reads it, `beside` the device's name what is to be known of it.
    pub fn table(&self, beside: &str) -> String {
        let mut text = format!(
            "{}{beside}, {} {}; plan {}, seed {}; {} values\n",
            self.device.name,
            self.device.driver,
            self.device.driver_version,
            self.plan,
            self.seed,
            thousands(self.evaluations),
        );
        let rows = self.rows.iter().map(|row| {
            let title = format!("{}, {}", row.function, row.tier);
            (title, cells(row))
        });
        write_table(&mut text, HEAD, ALIGN, rows);
        let summaries = self.summaries();
        let summaries = summaries
            .iter()
            .map(|summary| ("all cases".to_owned(), summary_cells(summary)));
        write_table(&mut text, SUMMARY_HEAD, SUMMARY_ALIGN, summaries);
        let costs = self.costs.iter().map(|row| {
            let title = "cost, net of reading and writing".to_owned();
            (title, cost_cells(row))
        });
        if !self.costs.is_empty() {
            write_table(&mut text, COST_HEAD, COST_ALIGN, costs);
        }
        text
    }
}

impl Summary {
    /// Values that are NaN, infinite or below 0.
    pub fn bad(&self) -> u64 {
        self.nan + self.inf + self.negative
    }

    fn of(i: usize, row: &StabilityRow) -> Self {
        Self {
            function: row.function.clone(),
            tier: row.tier.clone(),
            inputs: row.inputs,
            nan: row.nan,
            inf: row.inf,
            negative: row.negative,
            max_relative_error: row.max_relative_error,
            of_bound: row.of_bound(),
            max_bits_lost: row.max_bits_lost,
            row: i,
        }
    }

    fn add(&mut self, i: usize, row: &StabilityRow, rows: &[StabilityRow]) {
        let rank = |row: &StabilityRow| (row.bad(), row.share().unwrap_or(0.0));
        if rank(row) > rank(&rows[self.row]) {
            self.row = i;
        }
        self.inputs += row.inputs;
        self.nan += row.nan;
        self.inf += row.inf;
        self.negative += row.negative;
        self.max_relative_error = larger(self.max_relative_error, row.max_relative_error);
        self.of_bound = larger(self.of_bound, row.of_bound());
        self.max_bits_lost = larger(self.max_bits_lost, row.max_bits_lost);
    }
}

/// The larger of two figures that may be missing.
fn larger(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.max(b)),
        (one, other) => one.or(other),
    }
}

impl StabilityRow {
    /// Values that are NaN, infinite or below 0.
    fn bad(&self) -> u64 {
        self.nan + self.inf + self.negative
    }

    /// The largest error over the bound where it occurred, infinite where something is and the truth is nothing. A listing has one
    /// too, and promises nothing.
    fn share(&self) -> Option<f64> {
        (self.judged > 0).then(|| self.max_of_bound.unwrap_or(f64::INFINITY))
    }

    /// The same of what is promised: none where nothing is.
    pub fn of_bound(&self) -> Option<f64> {
        self.share().filter(|_| !is_listing(&self.function))
    }

    /// Whether a value is none, is below 0, or is further off than promised.
    pub fn is_broken(&self) -> bool {
        let off = self.of_bound().is_some_and(|share| share > 1.0);
        !is_listing(&self.function) && (self.bad() > 0 || off)
    }
}

/// Whether a function is one of the slides' listings, of which nothing is promised.
pub(super) fn is_listing(function: &str) -> bool {
    function.starts_with("slides-")
}

/// The columns.
pub(super) const HEAD: [&str; 9] = [
    "case",
    "inputs",
    "judged",
    "NaN",
    "Inf",
    "negative",
    "max error",
    "of bound",
    "bits lost",
];

/// How they stand.
pub(super) const ALIGN: [Align; 9] = [
    Align::Left,
    Align::Right,
    Align::Right,
    Align::Right,
    Align::Right,
    Align::Right,
    Align::Right,
    Align::Right,
    Align::Right,
];

/// A row as a person reads it.
pub(super) fn cells(row: &StabilityRow) -> [String; 9] {
    let own = [
        row.case.clone(),
        thousands(row.inputs),
        thousands(row.judged),
    ];
    let errors = [row.max_relative_error, row.of_bound(), row.max_bits_lost];
    with_outcome(own, [row.nan, row.inf, row.negative], errors)
}

/// The columns of all cases together.
pub(super) const SUMMARY_HEAD: [&str; 9] = {
    let mut head = HEAD;
    (head[0], head[1], head[2]) = ("function", "tier", "values");
    head
};

/// How they stand.
pub(super) const SUMMARY_ALIGN: [Align; 9] = {
    let mut align = ALIGN;
    align[1] = Align::Left;
    align
};

/// All cases of a function in a tier as a person reads them.
pub(super) fn summary_cells(summary: &Summary) -> [String; 9] {
    let own = [
        summary.function.clone(),
        summary.tier.clone(),
        thousands(summary.inputs),
    ];
    let errors = [
        summary.max_relative_error,
        summary.of_bound,
        summary.max_bits_lost,
    ];
    with_outcome(own, [summary.nan, summary.inf, summary.negative], errors)
}

/// A table's own three cells and what both tables end with: how many values are NaN, infinite, negative; the error, its share of the
/// bound, the bits lost.
fn with_outcome(own: [String; 3], bad: [u64; 3], errors: [Option<f64>; 3]) -> [String; 9] {
    let [a, b, c] = own;
    let [nan, inf, negative] = bad.map(thousands);
    let [error, of_bound, bits] = errors;
    let or_none = |text: Option<String>| text.unwrap_or_else(|| "-".to_owned());
    let error = or_none(error.map(|error| format!("{error:.1e}")));
    let of_bound = or_none(of_bound.map(|share| format!("{share:.2}")));
    let bits = or_none(bits.map(|bits| format!("{bits:.1}")));
    [a, b, c, nan, inf, negative, error, of_bound, bits]
}

/// The columns of costs.
pub(super) const COST_HEAD: [&str; 5] = ["function", "tier", "ns", "listing ns", "of listing"];

/// How they stand.
pub(super) const COST_ALIGN: [Align; 5] = [
    Align::Left,
    Align::Left,
    Align::Right,
    Align::Right,
    Align::Right,
];

/// A cost as a person reads it.
pub(super) fn cost_cells(row: &CostRow) -> [String; 5] {
    let bound = |bound: Option<f64>| bound.map_or("-".to_owned(), |bound| format!("{bound:.2}"));
    let Interval95 { low, high } = row.relative_95;
    [
        row.function.clone(),
        row.tier.clone(),
        format!("{:.2}", row.ns),
        format!("{:.2}", row.listing_ns),
        format!("{:.2} [{}, {}]", row.relative, bound(low), bound(high)),
    ]
}
