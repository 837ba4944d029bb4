//! How does a scene become a picture?
//!
//! ```text
//! Scene -> draw_list + records -> SceneBuffers -> shading_pass -> Targets -> Picture -> picture_file
//! ```
//!
//! No `unsafe`, no Vulkan: only what `gpu` offers.

mod camera;
mod draw_list;
mod picture;
mod picture_file;
mod records;
mod renderer;
mod scene_buffers;
mod shading_pass;
mod targets;
mod tone_mapping;
mod variant;

pub use draw_list::{Draw, DrawList, TooMany, draw_list};
pub use picture::{Defects, Picture};
pub use picture_file::{OutputFile, PictureFormat, encode};
pub use renderer::{FrameReport, RenderError, Renderer, Settings};
pub use tone_mapping::{ToneMapping, exposure_factor, srgb_codes};
pub use variant::Variant;
