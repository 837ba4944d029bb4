//! How does a result leave the program for other programs?

mod bench;
mod effects;
mod provenance;
mod render;

pub use bench::{BenchReport, BenchRow, BreakEven, Interval95, Method};
pub use effects::{Bounds, BuildRow, EffectRow, EffectsReport};
pub use provenance::{Device, Machine, Program};
pub use render::{Image, RenderReport, SceneSize};
