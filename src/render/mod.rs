//! How does a scene become a picture?
//!
//! ```text
//! Scene -> effects::Census -> Uploaded (draw_list, geometry, maps)
//!       -> Frame (scene_buffers, shadow_pass, shading_pass, Targets) -> Picture -> picture_file
//! ```
//!
//! No `unsafe`, no Vulkan: only what `gpu` offers.

mod camera;
mod draw_list;
pub mod effects;
pub mod export;
mod frame;
mod geometry;
mod inspection;
pub mod library;
mod maps;
mod picture;
mod picture_file;
mod pipelines;
mod placeholders;
mod plan;
pub mod probe;
mod records;
mod renderer;
mod scene_buffers;
mod shading_pass;
mod shadow_maps;
mod shadow_pass;
pub mod state_changes;
mod targets;
mod tone_mapping;
mod uploaded;
mod variant;

pub use draw_list::{Draw, DrawList, TooMany, draw_list};
pub use frame::{Frame, FrameReport};
pub use inspection::Inspection;
pub use picture::{Defect, Defects, Picture};
pub use picture_file::{OutputFile, PictureFormat, encode};
pub use renderer::{RenderError, Renderer, Settings};
pub use shadow_maps::ShadowMaps;
pub use tone_mapping::{ToneMapping, exposure_factor, srgb_codes};
pub use uploaded::Uploaded;
pub use variant::Variant;
