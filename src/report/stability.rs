//! Where does which function stay with its truth: as rows, and as a table?

use super::provenance::{Device, Machine, Program};
use super::table::{Align, write_table};

/// `umber.stability/1`.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct StabilityReport {
    /// Names this layout.
    pub schema: &'static str,
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
    /// What made this report.
    pub program: Program,
}

/// A function in a tier and a case. Errors are null where nothing is promised at any of the inputs.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct StabilityRow {
    /// The function; the slides' listings are named `slides-*`.
    pub function: String,
    /// `f32` or `f32-compensated`.
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
    /// Whether anything is promised of the function: of the listings nothing is.
    #[serde(skip)]
    pub held: bool,
}

impl StabilityReport {
    /// The layout that `schema` names.
    pub const SCHEMA: &'static str = "umber.stability/1";

    /// The rows in which a promise is broken.
    pub fn broken(&self) -> impl Iterator<Item = &StabilityRow> {
        self.rows.iter().filter(|row| row.is_broken())
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
            self.evaluations,
        );
        let rows = self.rows.iter().map(|row| {
            let title = format!("{}, {}", row.function, row.tier);
            (title, cells(row))
        });
        write_table(&mut text, HEAD, ALIGN, rows);
        text
    }
}

impl StabilityRow {
    /// Whether a value is none, is below 0, or is further off than promised.
    pub fn is_broken(&self) -> bool {
        let bad = self.nan + self.inf + self.negative > 0;
        let off = self.max_of_bound.is_some_and(|share| share > 1.0);
        self.held && (bad || off)
    }
}

const HEAD: [&str; 9] = [
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

const ALIGN: [Align; 9] = [
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

fn cells(row: &StabilityRow) -> [String; 9] {
    let number = |number: Option<f64>, digits: &dyn Fn(f64) -> String| {
        number.map_or_else(|| "-".to_owned(), digits)
    };
    [
        row.case.clone(),
        row.inputs.to_string(),
        row.judged.to_string(),
        row.nan.to_string(),
        row.inf.to_string(),
        row.negative.to_string(),
        number(row.max_relative_error, &|error| format!("{error:.1e}")),
        match row.held {
            true => number(row.max_of_bound, &|share| format!("{share:.2}")),
            false => "-".to_owned(),
        },
        number(row.max_bits_lost, &|bits| format!("{bits:.1}")),
    ]
}
