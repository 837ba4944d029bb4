//! What does one pipeline save: as rows?

use super::interval::Interval95;
use super::provenance::{Device, Machine, Program};

/// `umber.bench/1`.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct BenchReport {
    /// Names this layout.
    pub schema: String,
    /// What drew.
    pub device: Device,
    /// What it stands in.
    pub machine: Machine,
    /// How it was measured.
    pub method: Method,
    /// One for each cell that is finished, or that cannot be measured here.
    pub rows: Vec<BenchRow>,
    /// From how many pixels a material on a pipeline of its own pays, for each build that it is compared with.
    pub break_even: Vec<BreakEven>,
    /// What made this report.
    pub program: Program,
}

impl BenchReport {
    /// The layout that `schema` names.
    pub const SCHEMA: &'static str = "umber.bench/1";
}

/// How the rows were measured.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct Method {
    /// `submit`: each frame is recorded, submitted and waited for. `vkoverhead`: command buffers are recorded
    /// and reset, and never submitted.
    pub name: String,
    /// `quick`, `full`, or `custom`.
    pub plan: String,
    /// Frames of each cell that count, at least, if its time suffices.
    pub rounds: u32,
    /// Cells that are drawn in turn get further frames until each took this long on average, s.
    pub further_seconds: f64,
    /// Frames of each cell before them, on each device, that do not.
    pub warm_up: u32,
    /// A cell that took this long is given no further frame, s.
    pub cell_seconds: f64,
    /// Orders draws and rounds.
    pub seed: u64,
    /// What the C library's heap was told, as variables of the environment; empty for nothing.
    pub heap: String,
}

/// One mode in one scene. A figure is null where it does not exist or could not be had; `note` says why.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct BenchRow {
    /// How each draw gets its material.
    pub mode: String,
    /// `sorted` by material, or `shuffled`.
    pub order: String,
    /// `tiny`, `zoo`, `patches` or `null`.
    pub scene: String,
    /// Materials in the scene.
    pub materials: u32,
    /// Objects drawn.
    pub draws: u32,
    /// Pixels that an object covers, about.
    pub pixels_per_draw: f64,
    /// Pixels a row of the picture.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Median time to record a draw, ns.
    pub record_ns_per_draw: Option<f64>,
    /// Its median absolute deviation, ns.
    pub record_mad: Option<f64>,
    /// Median from the submission until the device is idle, ms.
    pub submit_to_idle_ms: Option<f64>,
    /// Its median absolute deviation, ms.
    pub submit_to_idle_mad: Option<f64>,
    /// Median between the device's timestamps around the pass, ms; null where the queue has no clock.
    pub gpu_ms: Option<f64>,
    /// Its median absolute deviation, ms.
    pub gpu_mad: Option<f64>,
    /// Frames that counted.
    pub samples: u32,
    /// Fresh devices on which they were drawn, one after the other: intervals are between the medians of these, or
    /// between frames where there is one.
    pub devices: u32,
    /// Draw commands in a frame, as the recorder counted them.
    pub draw_calls: u64,
    /// Pipeline binds.
    pub pipeline_binds: u64,
    /// Descriptor set binds.
    pub descriptor_set_binds: u64,
    /// Push constant updates.
    pub push_constants: u64,
    /// Pipelines made for the mode.
    pub pipelines_created: u64,
    /// Making them, and the first frame beyond the median one, in a process of its own without any cache, ms.
    pub creation_cold_ms: Option<f64>,
    /// The same with the caches that an earlier process filled, ms.
    pub creation_warm_ms: Option<f64>,
    /// Device memory that the mode takes beyond what all modes share, bytes.
    pub memory_bytes: u64,
    /// 64 bits of its picture, in hexadecimal; null where nothing is drawn.
    pub image_hash: Option<String>,
    /// The mode that `relative` compares it with, in the same order; itself for a base.
    pub base: String,
    /// Its submit-to-idle over the base's, pair by pair, the median of each device's median; its recording for the
    /// method `vkoverhead`.
    pub relative: Option<f64>,
    /// The interval of `relative`.
    pub relative_95: Option<Interval95>,
    /// Its recording over the base's, pair by pair.
    pub record_relative: Option<f64>,
    /// The interval of `record_relative`.
    pub record_relative_95: Option<Interval95>,
    /// Warnings and reasons, divided by `; `: `capped at 256`, `noisy: ...`, `unsupported: ...`.
    pub note: String,
}

/// From how many pixels a material on its own pipeline pays.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct BreakEven {
    /// The single pipeline that it is compared with: `one-pipeline` (compiled for the scene) or `dynamic`.
    pub single: String,
    /// Materials, each drawn once.
    pub materials: u32,
    /// Pixels a material from which switching is the faster; null where no measured size is.
    pub pixels: Option<f64>,
    /// The sizes between which the measurements allow it to lie.
    pub pixels_95: Option<Interval95>,
    /// What to know about it.
    pub note: String,
}
