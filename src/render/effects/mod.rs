//! Which effects does a frame contain, and who asked for them?
//!
//! ```text
//! list    the closed list: name, constant, bit, rule, needs of each effect
//! census  who in a scene calls for which
//! set     some of them, by name
//! choice  which effects a frame may have, and how they are compiled
//! states  what each effect's constant is, for a pipeline
//! ```
//!
//! An effect is one entry of `list` and one file of `shaders-glsl/effects`. Everything else here, the
//! renderer and the command line iterate the list and know no effect by name.

mod census;
mod choice;
mod list;
mod set;
mod states;

pub use census::{Caller, Census};
pub use choice::{Build, Effects};
pub use list::{ALL, Effect, Need};
pub use set::{EffectSet, UnknownEffect};
pub use states::{State, States};
