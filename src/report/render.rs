//! What did `umber render` do?

use super::provenance::{Device, Program};
use crate::render::FrameReport;

/// `umber.render/1`.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct RenderReport {
    /// Names this layout.
    pub schema: &'static str,
    /// What rendered.
    pub device: Device,
    /// What was rendered.
    pub scene: SceneSize,
    /// What it took.
    pub frame: FrameReport,
    /// Why its lighting model was taken; null where it was named.
    pub choice: Option<ChoiceRow>,
    /// What came out.
    pub image: Image,
    /// Messages of the validation layers; 0 where they are off.
    pub validation_messages: usize,
    /// From the start of the program to the written file, less `first_draw_ms` and
    /// `submit_to_idle_ms`.
    pub start_to_file_ms: f64,
    /// What made this report.
    pub program: Program,
}

impl RenderReport {
    /// The layout that `schema` names.
    pub const SCHEMA: &'static str = "umber.render/1";
}

/// How large a scene is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, serde::Serialize)]
pub struct SceneSize {
    /// Triangles drawn, instances counted.
    pub triangles: u64,
    /// Objects: draws.
    pub objects: usize,
    /// Materials.
    pub materials: usize,
    /// Lights.
    pub lights: usize,
}

/// A model that was taken to keep a promise.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct ChoiceRow {
    /// The largest mean of FLIP that was allowed.
    pub max_error: Option<f64>,
    /// The longest frame that was.
    pub budget_ms: Option<f64>,
    /// The model.
    pub lighting: String,
    /// Its mean of FLIP against the reference picture.
    pub flip_mean: f64,
    /// Its frame as it was measured for a budget.
    pub frame_ms: Option<f64>,
    /// The predicted time of an evaluation, over the default model's.
    pub ns_of_default: f64,
}

/// The picture.
#[derive(Clone, PartialEq, Eq, Debug, serde::Serialize)]
pub struct Image {
    /// Where it was written.
    pub path: String,
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Samples a pixel.
    pub samples: u32,
    /// Pixels with a NaN or an infinity.
    pub nan_pixels: usize,
}
