//! What stands where nobody calls for anything?
//!
//! Every binding of the set must be valid on every driver, whatever a pipeline reads of it.

use std::sync::Arc;

use crate::gpu::{
    Device, Error, Filter, Resource, Sampler, TextureArray, TextureFormat, TextureInfo,
    TextureUpload,
};

/// Made once for all scenes.
pub struct Placeholders {
    texture: Arc<TextureArray>,
    maps: Arc<Sampler>,
    shadows: Arc<Sampler>,
}

impl Placeholders {
    /// One texture of one texel, and the two samplers.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(device: &Arc<Device>) -> Result<Self, Error> {
        let info = TextureInfo {
            name: "placeholder texture",
            format: TextureFormat::Rgba8,
            size: 1,
            layers: 1,
            levels: 1,
        };
        let mut upload = TextureUpload::new(device, &info)?;
        upload.write(0, 0, &[0; 4])?;
        Ok(Self {
            texture: upload.finish()?,
            maps: Sampler::new(device, "maps", Filter::Trilinear)?,
            shadows: Sampler::new(device, "shadow maps", Filter::Nearest)?,
        })
    }

    /// The texture in place of any array.
    pub fn texture(&self) -> Resource {
        Resource::Texture(Arc::clone(&self.texture))
    }

    /// The sampler of maps.
    pub fn map_sampler(&self) -> Resource {
        Resource::Sampler(Arc::clone(&self.maps))
    }

    /// The sampler of shadow maps.
    pub fn shadow_sampler(&self) -> Resource {
        Resource::Sampler(Arc::clone(&self.shadows))
    }
}
