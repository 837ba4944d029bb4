//! Where do rendered pixels live?

use std::mem::ManuallyDrop;
use std::sync::Arc;

use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::Allocation;

use super::device::Device;
use super::error::{Error, Named};
use super::format::{Samples, TargetFormat};

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

/// A render target, its memory and its view. Dropped: view, image, memory, hold on the device.
pub struct Image {
    pub(super) raw: vk::Image,
    pub(super) view: vk::ImageView,
    allocation: ManuallyDrop<Allocation>,
    format: TargetFormat,
    width: u32,
    height: u32,
    samples: Samples,
    device: Arc<Device>,
}

impl Image {
    /// A render target with undefined content.
    ///
    /// # Errors
    /// Beyond the device's limits, or no memory.
    pub fn new(device: &Arc<Device>, info: &ImageInfo) -> Result<Self, Error> {
        device.check_target_size(info.width, info.height)?;
        device.check_samples(info.samples)?;
        // SAFETY: size and samples were checked against the device, and `requirements` found the formats.
        let raw =
            unsafe { device.raw.create_image(&create_info(info), None) }.named("vkCreateImage")?;
        let destroy = || {
            // SAFETY: the image was never used.
            unsafe { device.raw.destroy_image(raw, None) };
        };
        let allocation = allocate(device, info, raw).inspect_err(|_| destroy())?;
        let view = match create_view(device, info, raw) {
            Ok(view) => view,
            Err(error) => {
                destroy();
                // The caller hears of the failed view; a failed free on top of it adds nothing.
                let _ = device.allocator().free(allocation);
                return Err(error);
            }
        };
        device.name(raw, info.name);
        device.name(view, info.name);
        Ok(Self {
            raw,
            view,
            allocation: ManuallyDrop::new(allocation),
            format: info.format,
            width: info.width,
            height: info.height,
            samples: info.samples,
            device: Arc::clone(device),
        })
    }

    pub(super) fn is_of(&self, device: &Arc<Device>) -> bool {
        Arc::ptr_eq(&self.device, device)
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

impl Drop for Image {
    fn drop(&mut self) {
        // SAFETY: recorders borrow what they use until the device is done with it; the view goes
        // before its image; the allocation is taken once.
        let allocation = unsafe {
            self.device.raw.destroy_image_view(self.view, None);
            self.device.raw.destroy_image(self.raw, None);
            ManuallyDrop::take(&mut self.allocation)
        };
        // A failure to free is a leak, and there is nobody left to tell.
        let _ = self.device.allocator().free(allocation);
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

fn create_view(
    device: &Device,
    info: &ImageInfo,
    image: vk::Image,
) -> Result<vk::ImageView, Error> {
    let view = vk::ImageViewCreateInfo::default()
        .image(image)
        .view_type(vk::ImageViewType::TYPE_2D)
        .format(info.format.vulkan())
        .subresource_range(whole(info.format));
    // SAFETY: the image has memory, and the view covers what it has.
    unsafe { device.raw.create_image_view(&view, None) }.named("vkCreateImageView")
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

fn allocate(device: &Device, info: &ImageInfo, image: vk::Image) -> Result<Allocation, Error> {
    // SAFETY: the image is this device's.
    let requirements = unsafe { device.raw.get_image_memory_requirements(image) };
    let allocation = device.allocate(info.name, requirements, MemoryLocation::GpuOnly, false)?;
    // SAFETY: memory of the image's own requirements, bound once.
    let bound = unsafe {
        device
            .raw
            .bind_image_memory(image, allocation.memory(), allocation.offset())
    };
    device.keep_if(bound, allocation, "vkBindImageMemory")
}
