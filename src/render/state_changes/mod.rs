//! In how many ways can the same picture be drawn, if each draw is to have its material?
//!
//! The renderer knows one: the material's number in the object's record. The others are here to be measured
//! against it.
//!
//! ```text
//! scene::Wall -> Stage, BareStage (one a scene) -> Case, BareCase (one a mode) -> Canvas: Sample, Picture
//!                                                  Equipment (what cases of one mode share)
//! ```

mod bare;
mod canvas;
mod case;
mod mode;
mod own;
mod pipelines;
mod stage;

pub use bare::{BareCase, BareStage};
pub use canvas::{Canvas, Drawing, Sample};
pub use case::{Case, Equipment, Made};
pub use mode::{
    Call, Change, DYNAMIC, MODES, Mode, ONE_PIPELINE, PIPELINE_PER_MATERIAL, Source, TEXTURE_ARRAY,
};
pub use stage::Stage;
