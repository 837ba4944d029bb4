//! Where does depth live that a later pass samples?

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use ash::vk;

use super::device::Device;
use super::error::Error;
use super::image_memory::{ImageMemory, array_info};
use super::requirements::DEPTH;

/// Square depth images of one size, one a layer: depth passes draw to a layer, and shaders see a
/// `texture2DArray` (of one layer too) in the passes that read it. A layer that was not drawn to is undefined; what was
/// drawn lasts until a recording draws again, for recordings that `Recorder::keep` it.
pub struct DepthArray {
    pub(super) image: ImageMemory,
    pub(super) view: vk::ImageView,
    layer_views: Vec<vk::ImageView>,
    size: u32,
    /// Whether the last recording that used it and was done left it ready for shaders.
    pub(super) is_kept: AtomicBool,
}

impl DepthArray {
    /// An array of `layers` with this side, texels.
    ///
    /// # Errors
    /// Side or layers are beyond the device's limits, or no memory.
    pub fn new(device: &Arc<Device>, name: &str, size: u32, layers: u32) -> Result<Self, Error> {
        device.check_array(name, size, layers)?;
        device.check_target_size(size, size)?;
        let usage = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
        let create = array_info(DEPTH.vulkan(), size, layers, 1, usage);
        let mut image = ImageMemory::new(device, name, &create)?;
        let all = layers_from(0, layers);
        let view = image.view(name, vk::ImageViewType::TYPE_2D_ARRAY, all)?;
        let layer_views = (0..layers)
            .map(|layer| {
                let name = format!("{name}: layer {layer}");
                let one = layers_from(layer, 1);
                image.view(&name, vk::ImageViewType::TYPE_2D, one)
            })
            .collect::<Result<_, _>>()?;
        Ok(Self {
            image,
            view,
            layer_views,
            size,
            is_kept: AtomicBool::new(false),
        })
    }

    pub(super) fn is_of(&self, device: &Arc<Device>) -> bool {
        self.image.is_of(device)
    }

    /// All layers: they change their use together.
    pub(super) fn range(&self) -> vk::ImageSubresourceRange {
        layers_from(0, self.layers())
    }

    /// The view that draws to a layer, if there is one.
    pub(super) fn layer_view(&self, layer: u32) -> Option<vk::ImageView> {
        self.layer_views.get(layer as usize).copied()
    }

    pub(super) fn extent(&self) -> vk::Extent2D {
        vk::Extent2D {
            width: self.size,
            height: self.size,
        }
    }

    /// Side of the square, texels.
    pub fn size(&self) -> u32 {
        self.size
    }

    /// How many images.
    pub fn layers(&self) -> u32 {
        // No more than were asked for, in 32 bits.
        self.layer_views.len() as u32
    }
}

fn layers_from(first: u32, count: u32) -> vk::ImageSubresourceRange {
    vk::ImageSubresourceRange {
        aspect_mask: vk::ImageAspectFlags::DEPTH,
        base_mip_level: 0,
        level_count: 1,
        base_array_layer: first,
        layer_count: count,
    }
}
