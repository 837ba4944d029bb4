//! How does the rest of the program use Vulkan without `unsafe`?
//!
//! The only floor that knows ash. What it hands out is safe: every object holds an `Arc` of what it
//! was made from, a recorder borrows what it uses until the device is idle, and every count, size
//! and index that reaches Vulkan is checked or made harmless by robust buffer access.
//!
//! ```text
//! Instance <- Device <- Buffer, Image, SetLayout, PipelineCache, Timestamps, Recorder
//!                       SetLayout <- DescriptorSet, Pipeline
//! ```
//!
//! Absent on purpose: several queues, asynchronous frames, render pass objects.

mod barriers;
mod buffer;
mod canary;
mod commands;
mod descriptors;
mod device;
mod error;
mod format;
mod image;
mod instance;
mod pipeline;
mod pipeline_cache;
pub mod requirements;
mod selection;
mod spirv;
mod survey;
mod timestamps;
mod upload;
mod validation;

pub use buffer::{Buffer, BufferUse};
pub use canary::Canary;
pub use commands::{Pass, PassCounts, PassInfo, Recorded, Recorder};
pub use descriptors::{Binding, DescriptorSet, SetLayout};
pub use device::Device;
pub use error::{Error, VulkanResult, install_line};
pub use format::{Format, Samples};
pub use image::{Image, ImageInfo};
pub use instance::{API_VERSION, Instance, Validation};
pub use pipeline::{Attribute, Constant, Pipeline, PipelineInfo};
pub use pipeline_cache::PipelineCache;
pub use selection::{DeviceInfo, DeviceKind, DeviceSelector, choose};
pub use survey::driver_files;
pub use timestamps::Timestamps;
pub use upload::Upload;
pub use validation::ValidationLog;
