//! Where do rendered pixels live?

use std::sync::Arc;

use ash::vk;

use super::device::Device;
use super::error::Error;
use super::format::{Samples, TargetFormat};
use super::image_memory::ImageMemory;

/// What an image is: all that tells one render target from another.
#[derive(Clone, Copy, Debug)]
pub struct ImageInfo<'a> {
    /// Its role, for captures and messages.
    pub name: &'a str,
    /// Texel format.
    pub format: TargetFormat,
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Samples a pixel.
    pub samples: Samples,
}

/// A render target and its view.
pub struct Image {
    pub(super) image: ImageMemory,
    pub(super) view: vk::ImageView,
    format: TargetFormat,
    width: u32,
    height: u32,
    samples: Samples,
}

impl Image {
    /// A render target with undefined content.
    ///
    /// # Errors
    /// Beyond the device's limits, or no memory.
    pub fn new(device: &Arc<Device>, info: &ImageInfo) -> Result<Self, Error> {
        device.check_target_size(info.width, info.height)?;
        device.check_samples(info.samples)?;
        let mut image = ImageMemory::new(device, info.name, &create_info(info))?;
        let whole = whole(info.format);
        let view = image.view(info.name, vk::ImageViewType::TYPE_2D, whole)?;
        Ok(Self {
            image,
            view,
            format: info.format,
            width: info.width,
            height: info.height,
            samples: info.samples,
        })
    }

    pub(super) fn is_of(&self, device: &Arc<Device>) -> bool {
        self.image.is_of(device)
    }

    /// Texel format.
    pub fn format(&self) -> TargetFormat {
        self.format
    }

    /// Samples a pixel.
    pub fn samples(&self) -> Samples {
        self.samples
    }

    /// Width and height, pixels.
    pub fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// Size of the texels of one sample, tightly packed.
    pub fn bytes(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height) * self.format.bytes()
    }

    pub(super) fn extent(&self) -> vk::Extent2D {
        vk::Extent2D {
            width: self.width,
            height: self.height,
        }
    }
}

fn create_info(info: &ImageInfo) -> vk::ImageCreateInfo<'static> {
    let attachment = match info.format {
        TargetFormat::Depth32Float => vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT,
        _ => vk::ImageUsageFlags::COLOR_ATTACHMENT,
    };
    let readable = match (info.format, info.samples) {
        (TargetFormat::Rgba32Float, Samples::One) => vk::ImageUsageFlags::TRANSFER_SRC,
        _ => vk::ImageUsageFlags::empty(),
    };
    vk::ImageCreateInfo::default()
        .image_type(vk::ImageType::TYPE_2D)
        .format(info.format.vulkan())
        .extent(vk::Extent3D {
            width: info.width,
            height: info.height,
            depth: 1,
        })
        .mip_levels(1)
        .array_layers(1)
        .samples(info.samples.vulkan())
        .tiling(vk::ImageTiling::OPTIMAL)
        .usage(attachment | readable)
        .initial_layout(vk::ImageLayout::UNDEFINED)
}

/// The one level and layer that a render target has.
pub(super) fn whole(format: TargetFormat) -> vk::ImageSubresourceRange {
    vk::ImageSubresourceRange {
        aspect_mask: format.aspect(),
        base_mip_level: 0,
        level_count: 1,
        base_array_layer: 0,
        layer_count: 1,
    }
}
