//! Which questions does the instrument ask, and what are the answers?
//!
//! A study measures and returns a table; it neither parses nor prints.

mod clocks;
pub mod cost;
mod difference;
mod effects;
mod first_draw;
mod kept;
pub mod ladders;
mod own_process;
pub mod stability;
pub mod state_changes;

pub use difference::{Compared, Display, NoDifference, Seen, difference, key_exposure};
pub use effects::{Options, SceneStudy, frames, study};
pub use first_draw::FirstDraw;
pub use kept::Cache;
pub use own_process::{ColdAndWarm, OwnProcessError};
