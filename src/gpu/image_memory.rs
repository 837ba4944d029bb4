//! Who owns an image, its views and its memory?

use std::mem::ManuallyDrop;
use std::sync::Arc;

use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::Allocation;

use super::device::Device;
use super::error::{Error, Named};

/// An image with memory. Dropped: views, image, memory, hold on the device.
pub(super) struct ImageMemory {
    pub(super) raw: vk::Image,
    format: vk::Format,
    views: Vec<vk::ImageView>,
    allocation: ManuallyDrop<Allocation>,
    device: Arc<Device>,
}

impl ImageMemory {
    /// An image of undefined content. `info` has been checked against the device.
    pub(super) fn new(
        device: &Arc<Device>,
        name: &str,
        info: &vk::ImageCreateInfo,
    ) -> Result<Self, Error> {
        // SAFETY: the callers checked size, layers and samples against the device, and
        // `requirements` found the formats.
        let raw = unsafe { device.raw.create_image(info, None) }.named("vkCreateImage")?;
        let allocation = allocate(device, name, raw).inspect_err(|_| {
            // SAFETY: the image was never used.
            unsafe { device.raw.destroy_image(raw, None) };
        })?;
        device.name(raw, name);
        device.count_image();
        Ok(Self {
            raw,
            format: info.format,
            views: Vec::new(),
            allocation: ManuallyDrop::new(allocation),
            device: Arc::clone(device),
        })
    }

    /// A view that lives as long as the image.
    pub(super) fn view(
        &mut self,
        name: &str,
        kind: vk::ImageViewType,
        range: vk::ImageSubresourceRange,
    ) -> Result<vk::ImageView, Error> {
        let info = vk::ImageViewCreateInfo::default()
            .image(self.raw)
            .view_type(kind)
            .format(self.format)
            .subresource_range(range);
        // SAFETY: the image has memory, and the callers' ranges are what they made it of.
        let view =
            unsafe { self.device.raw.create_image_view(&info, None) }.named("vkCreateImageView")?;
        self.device.name(view, name);
        self.views.push(view);
        Ok(view)
    }

    pub(super) fn is_of(&self, device: &Arc<Device>) -> bool {
        Arc::ptr_eq(&self.device, device)
    }
}

impl Drop for ImageMemory {
    fn drop(&mut self) {
        // SAFETY: recorders borrow what they use until the device is done with it; the views go
        // before their image; the allocation is taken once.
        let allocation = unsafe {
            for view in &self.views {
                self.device.raw.destroy_image_view(*view, None);
            }
            self.device.raw.destroy_image(self.raw, None);
            ManuallyDrop::take(&mut self.allocation)
        };
        // A failure to free is a leak, and there is nobody left to tell.
        let _ = self.device.allocator().free(allocation);
    }
}

fn allocate(device: &Device, name: &str, image: vk::Image) -> Result<Allocation, Error> {
    // SAFETY: the image is this device's.
    let requirements = unsafe { device.raw.get_image_memory_requirements(image) };
    let allocation = device.allocate(name, requirements, MemoryLocation::GpuOnly, false)?;
    // SAFETY: memory of the image's own requirements, bound once.
    let bound = unsafe {
        device
            .raw
            .bind_image_memory(image, allocation.memory(), allocation.offset())
    };
    device.keep_if(bound, allocation, "vkBindImageMemory")
}

/// A square 2D image of several layers and levels, one sample a texel.
pub(super) fn array_info(
    format: vk::Format,
    size: u32,
    layers: u32,
    levels: u32,
    usage: vk::ImageUsageFlags,
) -> vk::ImageCreateInfo<'static> {
    vk::ImageCreateInfo::default()
        .image_type(vk::ImageType::TYPE_2D)
        .format(format)
        .extent(vk::Extent3D {
            width: size,
            height: size,
            depth: 1,
        })
        .mip_levels(levels)
        .array_layers(layers)
        .samples(vk::SampleCountFlags::TYPE_1)
        .tiling(vk::ImageTiling::OPTIMAL)
        .usage(usage)
        .initial_layout(vk::ImageLayout::UNDEFINED)
}
