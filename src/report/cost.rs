//! What does accuracy cost: as rows, and as tables?

use std::collections::BTreeMap;

use super::interval::Interval95;
use super::provenance::{Device, Machine, Program};
use super::table::{Align, write_table};

/// `umber.cost/1`.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct CostReport {
    /// Names this layout.
    pub schema: String,
    /// What measured.
    pub device: Device,
    /// Around it.
    pub machine: Machine,
    /// How.
    pub method: CostMethod,
    /// Form by form: the tiers of each term, then whole models.
    pub rows: Vec<TierRow>,
    /// What a fragment takes as lamps grow.
    pub lamps: Vec<LampRow>,
    /// What was chosen for each promise.
    pub promises: Vec<PromiseRow>,
    /// What made this report.
    pub program: Program,
}

/// How it was measured.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct CostMethod {
    /// `quick` or `full`.
    pub plan: String,
    /// Width and height of the pictures.
    pub size: (u32, u32),
    /// Frames of each model in each scene.
    pub rounds: usize,
    /// Lamps of the fragments in the rows.
    pub lamps: u32,
    /// Paths behind the model errors.
    pub paths: u32,
}

/// A tier of a term, or a whole model.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct TierRow {
    /// `diffuse`, `specular`, `fresnel` or `model`.
    pub term: String,
    /// Its name.
    pub tier: String,
    /// Of a term: the RMS error over all surfaces of `umber models`. Of a model: the mean error of linear radiance over the
    /// mean radiance, in the scene where it is largest.
    pub model_error_rms: Option<f64>,
    /// Of a term: the largest error there.
    pub model_error_max: Option<f64>,
    /// What 32 bits add at worst, of the value, at random angles above the surface; null for models.
    pub rounding_error_max: Option<f64>,
    /// Light lost or made at albedo 1; null for Fresnel terms and models.
    pub albedo_error_max: Option<f64>,
    /// Change of f where light and eye change places; null for Fresnel terms and models.
    pub reciprocity_error_max: Option<f64>,
    /// FLIP against the reference picture, in the scene where its mean is largest; of a tier, that of the best model with it.
    pub flip_mean: Option<f64>,
    /// The least that 95 % of that scene's pixels do not exceed.
    pub flip_p95: Option<f64>,
    /// The largest difference of an sRGB code in any scene.
    pub code_max: Option<f64>,
    /// Median in the compute probe, net of reading and writing.
    pub ns_per_evaluation: Option<f64>,
    /// Median distance from it.
    pub ns_mad: Option<f64>,
    /// Over the slides' listings, both together.
    pub of_slides: Option<f64>,
    /// 95 %.
    pub of_slides_95: Interval95,
    /// Median of a frame's fragment under the method's lamps, beyond Lambert's without an interface; null where it was not measured.
    pub ns_per_fragment: Option<f64>,
    /// Over the slides' listings.
    pub fragment_of_slides: Option<f64>,
    /// 95 %.
    pub fragment_of_slides_95: Interval95,
    /// Instructions of optimised SPIR-V beyond those of a surface without light; null without spirv-opt.
    pub spirv_instructions: Option<u64>,
    /// What the driver tells of the probe's code (VK_KHR_pipeline_executable_properties), in its own words; empty where it tells nothing.
    #[serde(default)]
    pub driver_statistics: BTreeMap<String, f64>,
    /// No other tier of the term, or no other model, has a smaller error in less time.
    pub pareto: bool,
    /// Scene by scene.
    pub scenes: Vec<SceneCost>,
}

/// A model, or the best model with a tier, in a scene.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct SceneCost {
    /// The scene's file.
    pub scene: String,
    /// Mean of FLIP.
    pub flip_mean: f64,
    /// The least that 95 % of the pixels do not exceed.
    pub flip_p95: f64,
    /// The largest difference of an sRGB code.
    pub code_max: f64,
    /// Making its pipeline and the first triangle.
    pub first_draw_ms: f64,
    /// Median of its frames, on shadow maps that were drawn before; null for tiers.
    pub frame_ms: Option<f64>,
    /// Over the default model's, frame by frame.
    pub of_default: Option<f64>,
    /// 95 %.
    pub of_default_95: Interval95,
    /// No other model has a smaller FLIP in a shorter frame.
    pub pareto: bool,
}

/// A model under so many lamps.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct LampRow {
    /// Its name.
    pub tier: String,
    /// How many.
    pub lamps: u32,
    /// Median, beyond Lambert's without an interface.
    pub ns_per_fragment: f64,
    /// Median distance from it.
    pub ns_mad: f64,
}

/// What was chosen to keep a promise on a scene.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct PromiseRow {
    /// The scene's file.
    pub scene: String,
    /// The largest mean of FLIP that was allowed.
    pub max_error: f64,
    /// The mix; null where none keeps it.
    pub chosen: Option<String>,
    /// Its mean of FLIP, or that of the nearest.
    pub flip_mean: f64,
    /// Its frame over the default model's, frame by frame; null where none was chosen.
    pub of_default: Option<f64>,
    /// 95 %.
    pub of_default_95: Interval95,
}

impl CostReport {
    /// The layout that `schema` names.
    pub const SCHEMA: &'static str = "umber.cost/1";

    /// The rows of a term.
    pub fn of_term<'r>(&'r self, term: &'r str) -> impl Iterator<Item = &'r TierRow> {
        self.rows.iter().filter(move |row| row.term == term)
    }

    /// The tables as a person reads them.
    pub fn table(&self) -> String {
        let mut text = String::new();
        let rows = self
            .rows
            .iter()
            .map(|row| (row.term.clone(), tier_cells(row)));
        write_table(&mut text, TIER_HEAD, aligned(), rows);
        let scenes = self.of_term("model").flat_map(|row| {
            let own = row.scenes.iter();
            own.map(|scene| (scene.scene.clone(), scene_cells(&row.tier, scene)))
        });
        let mut scenes: Vec<_> = scenes.collect();
        scenes.sort_by(|a, b| a.0.cmp(&b.0));
        write_table(&mut text, SCENE_HEAD, aligned(), scenes.into_iter());
        let lamps = self
            .lamps
            .iter()
            .map(|row| (row.tier.clone(), lamp_cells(row)));
        write_table(&mut text, LAMP_HEAD, aligned(), lamps);
        let promises = self.promises.iter();
        let promises = promises.map(|row| (row.scene.clone(), promise_cells(row)));
        write_table(&mut text, PROMISE_HEAD, aligned(), promises);
        text
    }
}

/// What the columns of rows are called.
pub const TIER_HEAD: [&str; 12] = [
    "tier",
    "error RMS %",
    "largest %",
    "rounding",
    "FLIP mean",
    "95 %",
    "code",
    "ns",
    "of slides",
    "ns/fragment",
    "of slides",
    "SPIR-V",
];

/// Of scenes.
pub const SCENE_HEAD: [&str; 7] = [
    "model",
    "FLIP mean",
    "95 %",
    "code",
    "first draw ms",
    "frame ms",
    "of default",
];

const LAMP_HEAD: [&str; 3] = ["lamps", "ns/fragment", "± MAD"];

/// Of promises.
pub const PROMISE_HEAD: [&str; 4] = ["max error", "chosen", "FLIP mean", "of default"];

fn aligned<const N: usize>() -> [Align; N] {
    let mut align = [Align::Right; N];
    align[0] = Align::Left;
    align
}

/// The cells of a row; a star marks the front.
pub fn tier_cells(row: &TierRow) -> [String; 12] {
    let star = if row.pareto { " *" } else { "" };
    [
        format!("{}{star}", row.tier),
        told(row.model_error_rms, percent),
        told(row.model_error_max, percent),
        told(row.rounding_error_max, |x| format!("{x:.0e}")),
        told(row.flip_mean, |x| format!("{x:.4}")),
        told(row.flip_p95, |x| format!("{x:.3}")),
        told(row.code_max, |x| format!("{x:.0}")),
        told(row.ns_per_evaluation, |x| format!("{x:.2}")),
        ratio(row.of_slides, &row.of_slides_95),
        told(row.ns_per_fragment, |x| format!("{x:.1}")),
        ratio(row.fragment_of_slides, &row.fragment_of_slides_95),
        row.spirv_instructions
            .map_or("-".to_owned(), |n| n.to_string()),
    ]
}

/// The cells of a model in a scene.
pub fn scene_cells(tier: &str, row: &SceneCost) -> [String; 7] {
    let star = if row.pareto { " *" } else { "" };
    [
        format!("{tier}{star}"),
        format!("{:.4}", row.flip_mean),
        format!("{:.3}", row.flip_p95),
        format!("{:.0}", row.code_max),
        format!("{:.0}", row.first_draw_ms),
        told(row.frame_ms, |x| format!("{x:.1}")),
        ratio(row.of_default, &row.of_default_95),
    ]
}

fn lamp_cells(row: &LampRow) -> [String; 3] {
    [
        row.lamps.to_string(),
        format!("{:.1}", row.ns_per_fragment),
        format!("{:.1}", row.ns_mad),
    ]
}

/// The cells of a promise.
pub fn promise_cells(row: &PromiseRow) -> [String; 4] {
    [
        row.max_error.to_string(),
        row.chosen
            .clone()
            .unwrap_or_else(|| "none keeps it".to_owned()),
        format!("{:.4}", row.flip_mean),
        ratio(row.of_default, &row.of_default_95),
    ]
}

fn told(x: Option<f64>, how: impl Fn(f64) -> String) -> String {
    x.filter(|x| x.is_finite()).map_or("-".to_owned(), how)
}

fn percent(share: f64) -> String {
    match share * 100.0 {
        percent @ 10.0.. => format!("{percent:.0}"),
        percent @ 1.0.. => format!("{percent:.1}"),
        percent => format!("{percent:.2}"),
    }
}

/// `0.53 (0.52 to 0.55)`
pub fn ratio(ratio: Option<f64>, bounds: &Interval95) -> String {
    let Some(ratio) = ratio.filter(|ratio| ratio.is_finite()) else {
        return "-".to_owned();
    };
    match (bounds.low, bounds.high) {
        (Some(low), Some(high)) => format!("{ratio:.2} ({low:.2} to {high:.2})"),
        _ => format!("{ratio:.2}"),
    }
}
