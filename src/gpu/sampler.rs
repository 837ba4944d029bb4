//! How are textures filtered?

use std::sync::Arc;

use ash::vk;

use super::device::Device;
use super::error::{Error, Named};

/// The ways in which a shader reads between texels.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Filter {
    /// The nearest texel of level 0; beyond the edge, that of the edge. For depth.
    Nearest,
    /// Linear between texels and between levels, repeated beyond the edge. For textures.
    Trilinear,
}

/// A sampler.
pub struct Sampler {
    pub(super) raw: vk::Sampler,
    device: Arc<Device>,
}

impl Sampler {
    /// A sampler of this filter.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(device: &Arc<Device>, name: &str, filter: Filter) -> Result<Arc<Self>, Error> {
        // SAFETY: the filters ask for nothing that is a feature.
        let raw = unsafe { device.raw.create_sampler(&create_info(filter), None) }
            .named("vkCreateSampler")?;
        device.name(raw, name);
        Ok(Arc::new(Self {
            raw,
            device: Arc::clone(device),
        }))
    }

    pub(super) fn is_of(&self, device: &Arc<Device>) -> bool {
        Arc::ptr_eq(&self.device, device)
    }
}

impl Drop for Sampler {
    fn drop(&mut self) {
        // SAFETY: sets hold an `Arc` of what they point at, and recorders borrow sets.
        unsafe { self.device.raw.destroy_sampler(self.raw, None) };
    }
}

fn create_info(filter: Filter) -> vk::SamplerCreateInfo<'static> {
    let (texels, levels, address, last_level) = match filter {
        Filter::Nearest => (
            vk::Filter::NEAREST,
            vk::SamplerMipmapMode::NEAREST,
            vk::SamplerAddressMode::CLAMP_TO_EDGE,
            0.0,
        ),
        Filter::Trilinear => (
            vk::Filter::LINEAR,
            vk::SamplerMipmapMode::LINEAR,
            vk::SamplerAddressMode::REPEAT,
            vk::LOD_CLAMP_NONE,
        ),
    };
    vk::SamplerCreateInfo::default()
        .mag_filter(texels)
        .min_filter(texels)
        .mipmap_mode(levels)
        .address_mode_u(address)
        .address_mode_v(address)
        .address_mode_w(address)
        .min_lod(0.0)
        .max_lod(last_level)
}
