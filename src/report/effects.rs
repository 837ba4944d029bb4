//! Which effects does a scene call for, and what does each cost: as rows?

use super::interval::Interval95;
use super::provenance::{Device, Program};

/// `umber.effects/1`.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct EffectsReport {
    /// Names this layout.
    pub schema: &'static str,
    /// What rendered.
    pub device: Device,
    /// Pixels a row of the measured frames.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Samples a pixel.
    pub samples: u32,
    /// Frames of each kind, drawn in turn.
    pub rounds: usize,
    /// Effects, scene by scene.
    pub rows: Vec<EffectRow>,
    /// Builds, scene by scene.
    pub builds: Vec<BuildRow>,
    /// What made this report.
    pub program: Program,
}

impl EffectsReport {
    /// The layout that `schema` names.
    pub const SCHEMA: &'static str = "umber.effects/1";
}

/// One effect in one scene.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct EffectRow {
    /// The scene's file.
    pub scene: String,
    /// The effect's name.
    pub effect: &'static str,
    /// Everyone in the scene who calls for it.
    pub called_for_by: Vec<String>,
    /// Median of the frames with it; null where nobody calls for it.
    pub frame_ms_with: Option<f64>,
    /// Median of the frames without it.
    pub frame_ms_without: f64,
    /// Median of the differences, pair by pair; null where nobody calls for it.
    pub cost_ms: Option<f64>,
    /// Its interval.
    pub cost_ms_95: Option<Interval95>,
    /// The frame in which it is compiled in and no record may have it, over the frame without it, less 1.
    pub unused_cost_percent: f64,
    /// Its interval.
    pub unused_cost_percent_95: Interval95,
}

/// One build of one scene.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct BuildRow {
    /// The scene's file.
    pub scene: String,
    /// `dynamic`, `scene` or `material`.
    pub build: &'static str,
    /// Pipelines in the pass `shading`.
    pub pipelines: usize,
    /// Making the pipelines and one triangle with each, in a process of its own without any cache; null where
    /// it was not asked for.
    pub first_draw_cold_ms: Option<f64>,
    /// The same with the caches that an earlier process filled.
    pub first_draw_warm_ms: Option<f64>,
    /// Median of its frames.
    pub frame_ms: f64,
    /// Its frame over that of the build `scene`, pair by pair.
    pub relative: f64,
    /// Its interval.
    pub relative_95: Interval95,
    /// The largest |a - b| / (|b| + 0.1 cd/m^2) against the build `dynamic`: 1e-5 is 1e-5 relative and
    /// 1e-6 absolute.
    pub max_difference: f64,
}
