//! How does the rest of the program use Vulkan without `unsafe`?
//!
//! The only floor that knows ash. What it hands out is safe: every object holds an `Arc` of what it
//! was made from, a recorder borrows what it uses until the device is idle, sizes and counts are checked
//! against the device, and robust buffer access makes every fetch through an index defined. What only
//! a mistake of the program's own could break (buffers of two devices, a pass without its targets) is
//! asserted.
//!
//! ```text
//! Instance <- Device <- Buffer, IndirectDraws, Image, TextureArray, DepthArray, Sampler, SetLayout,
//!                       PipelineCache, Timestamps, Recorder
//!                       SetLayout <- DescriptorSet, PipelineLayout <- Pipeline, ComputePipeline
//! ```
//!
//! Absent on purpose: several queues, asynchronous frames, render pass objects.

mod barriers;
mod bound;
mod buffer;
mod canary;
mod commands;
mod compute;
mod depth_array;
mod descriptors;
mod device;
mod error;
mod executable_statistics;
mod format;
mod image;
mod image_memory;
mod indirect;
mod instance;
mod pass;
mod pass_info;
mod pipeline;
mod pipeline_cache;
mod pipeline_layout;
pub mod requirements;
mod sampler;
#[cfg(test)]
mod sampling_tests;
mod selection;
mod specialize;
mod spirv;
mod survey;
mod texture_array;
mod texture_upload;
mod timestamps;
mod upload;
mod validation;

pub use buffer::{Buffer, BufferUse};
pub use canary::Canary;
pub use commands::{Recorded, Recorder};
pub use compute::{ComputePipeline, MOST_GROUPS};
pub use depth_array::DepthArray;
pub use descriptors::{Binding, BindingKind, DescriptorSet, Resource, SetLayout};
pub use device::Device;
pub use error::{Error, VulkanResult, install_line};
pub use executable_statistics::Statistic;
pub use format::{Samples, TargetFormat, TextureFormat, VertexFormat};
pub use image::{Image, ImageInfo};
pub use indirect::{DrawCommand, IndirectDraws};
pub use instance::{API_VERSION, Instance, Validation};
pub use pass::{Cull, Pass, PassCounts};
pub use pass_info::{DepthPassInfo, PassInfo};
pub use pipeline::{Attribute, Constant, Output, Pipeline, PipelineInfo, Rate, Spirv, Targets};
pub use pipeline_cache::PipelineCache;
pub use pipeline_layout::PipelineLayout;
pub use sampler::{Filter, Sampler};
pub use selection::{DeviceInfo, DeviceKind, DeviceSelector, choose};
pub use survey::driver_files;
pub use texture_array::{TextureArray, TextureInfo};
pub use texture_upload::TextureUpload;
pub use timestamps::Timestamps;
pub use upload::Upload;
pub use validation::ValidationLog;
