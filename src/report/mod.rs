//! How does a result leave the program for other programs?

mod provenance;
mod render;

pub use provenance::{Device, Program};
pub use render::{Image, RenderReport, SceneSize};
