//! Where do the textures live that shaders sample?

use std::sync::Arc;

use ash::vk;

use super::device::Device;
use super::error::Error;
use super::format::TextureFormat;
use super::image_memory::{ImageMemory, array_info};

/// What a texture array is.
#[derive(Clone, Copy, Debug)]
pub struct TextureInfo<'a> {
    /// Its role, for captures and messages.
    pub name: &'a str,
    /// Texel format.
    pub format: TextureFormat,
    /// Side of the square at level 0, texels.
    pub size: u32,
    /// How many textures.
    pub layers: u32,
    /// Levels of detail: level `i` has the side `size >> i`, at least 1.
    pub levels: u32,
}

impl TextureInfo<'_> {
    /// How many levels a side has down to one texel.
    pub fn all_levels(size: u32) -> u32 {
        u32::BITS - size.leading_zeros()
    }

    /// Side of a level, texels.
    pub fn side(&self, level: u32) -> u32 {
        (self.size >> level).max(1)
    }
}

/// Textures of one size and format, one a layer: shaders see a `texture2DArray`, of one layer too.
/// Made by a `TextureUpload`, which leaves it ready to be sampled for good.
pub struct TextureArray {
    pub(super) image: ImageMemory,
    pub(super) view: vk::ImageView,
    format: TextureFormat,
    size: u32,
    layers: u32,
    levels: u32,
}

impl TextureArray {
    /// An array of undefined content.
    pub(super) fn new(device: &Arc<Device>, info: &TextureInfo) -> Result<Self, Error> {
        let TextureInfo {
            name,
            format,
            size,
            layers,
            levels,
        } = *info;
        device.check_array(name, size, layers)?;
        let possible = (1..=TextureInfo::all_levels(size)).contains(&levels);
        assert!(possible, "{name}: {levels} levels of a side of {size}");
        let usage = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST;
        let create = array_info(format.vulkan(), size, layers, levels, usage);
        let mut image = ImageMemory::new(device, name, &create)?;
        let view = image.view(
            name,
            vk::ImageViewType::TYPE_2D_ARRAY,
            whole(layers, levels),
        )?;
        Ok(Self {
            image,
            view,
            format,
            size,
            layers,
            levels,
        })
    }

    pub(super) fn is_of(&self, device: &Arc<Device>) -> bool {
        self.image.is_of(device)
    }

    pub(super) fn range(&self) -> vk::ImageSubresourceRange {
        whole(self.layers, self.levels)
    }

    /// Texel format.
    pub fn format(&self) -> TextureFormat {
        self.format
    }

    /// Side of the square at level 0, texels.
    pub fn size(&self) -> u32 {
        self.size
    }

    /// How many textures.
    pub fn layers(&self) -> u32 {
        self.layers
    }

    /// Levels of detail.
    pub fn levels(&self) -> u32 {
        self.levels
    }
}

fn whole(layers: u32, levels: u32) -> vk::ImageSubresourceRange {
    vk::ImageSubresourceRange {
        aspect_mask: vk::ImageAspectFlags::COLOR,
        base_mip_level: 0,
        level_count: levels,
        base_array_layer: 0,
        layer_count: layers,
    }
}
