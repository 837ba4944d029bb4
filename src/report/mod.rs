//! How does a result leave the program for other programs?

mod effects;
mod provenance;
mod render;

pub use effects::{Bounds, BuildRow, EffectRow, EffectsReport};
pub use provenance::{Device, Program};
pub use render::{Image, RenderReport, SceneSize};
