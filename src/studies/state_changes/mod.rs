//! What does one pipeline save, against switching? And what does the single shader cost?
//!
//! Modes that draw the same picture are drawn in turn, round by round, each round in an order of its own; only frames
//! of one round are compared, so that a clock that drifts cancels.

mod break_even;
mod creation;
mod measure;
mod plan;
mod rows;
mod stages;
mod visits;

pub use break_even::break_evens;
pub use creation::{Creation, SCENES, here as creation_here};
pub use plan::{Cell, FURTHER_SECONDS, Group, Plan, SceneKind};
pub use visits::Visits;

use crate::gpu;
use crate::render::RenderError;
use crate::scene;

/// How cells are measured.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Options {
    /// Frames of each cell that count, at least, over all visits.
    pub rounds: u32,
    /// A group is given further rounds until each of its cells took this long on average, s: a burst of somebody else's
    /// work on the machine is then seldom half of them.
    pub further_seconds: f64,
    /// Frames of each cell before them in each visit; at least one.
    pub warm_up: u32,
    /// A cell that took this long is drawn no further, s.
    pub cell_seconds: f64,
    /// Orders draws and rounds.
    pub seed: u64,
    /// What a frame is.
    pub timing: Timing,
}

/// What is done with a frame's commands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Timing {
    /// They are submitted and waited for.
    Submit,
    /// They are thrown away, as vkoverhead does.
    RecordAndReset,
}

/// Why there are no rows.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// The device cannot.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The built-in materials cannot be read.
    #[error(transparent)]
    Scene(#[from] scene::Error),
    /// No such mode.
    #[error("{0}")]
    Mode(String),
    /// More draws than the device has room for their records.
    #[error(
        "{draws} draws need {bytes} bytes of records in one storage buffer; this device has room for {most} draws"
    )]
    TooManyDraws {
        /// What was asked for.
        draws: u32,
        /// What they take.
        bytes: u64,
        /// What there is room for.
        most: u64,
    },
    /// More draws than a picture has cells that this device can have.
    #[error("{draws} draws: {error}")]
    TooLarge {
        /// What was asked for.
        draws: u32,
        /// What is beyond the device.
        error: gpu::Error,
    },
    /// A mode leaves another picture than its base.
    #[error("{cell}: its picture differs by {difference:.1e} from the one that it must equal")]
    OtherPicture {
        /// Mode and order.
        cell: String,
        /// As `Picture::max_difference`.
        difference: f64,
    },
    /// A mode records other commands than it says.
    #[error("{cell}: it recorded {got}, and should have recorded {want}")]
    OtherCommands {
        /// Mode and order.
        cell: String,
        /// What the recorder counted.
        got: String,
        /// What follows from the materials of its draws.
        want: String,
    },
}

impl From<gpu::Error> for BenchError {
    fn from(error: gpu::Error) -> Self {
        Self::Render(error.into())
    }
}
