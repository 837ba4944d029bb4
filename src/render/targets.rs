//! What is drawn to, and how does the host see it?

use std::sync::Arc;

use super::picture::Picture;
use crate::gpu::{
    Buffer, BufferUse, DepthArray, Device, Error, Image, ImageInfo, PassInfo, Recorder, Samples,
    requirements,
};

/// Colour, depth, and where colour is resolved to.
pub struct Targets {
    color: Image,
    resolved: Option<Image>,
    depth: Image,
}

impl Targets {
    /// Targets of one size.
    ///
    /// # Errors
    /// The size or sample count is beyond the device, or there is no memory.
    pub fn new(
        device: &Arc<Device>,
        width: u32,
        height: u32,
        samples: Samples,
    ) -> Result<Self, Error> {
        let image = |name, format, samples| {
            let info = ImageInfo {
                name,
                format,
                width,
                height,
                samples,
            };
            Image::new(device, &info)
        };
        let color = image("shading: colour", requirements::COLOR, samples)?;
        let resolved = match samples {
            Samples::One => None,
            _ => Some(image(
                "shading: resolved colour",
                requirements::COLOR,
                Samples::One,
            )?),
        };
        let depth = image("shading: depth", requirements::DEPTH, samples)?;
        Ok(Self {
            color,
            resolved,
            depth,
        })
    }

    /// A pass that draws to these targets and samples `reads`.
    pub fn pass<'a>(&'a self, name: &'a str, reads: &'a [&'a DepthArray]) -> PassInfo<'a> {
        PassInfo {
            name,
            color: &self.color,
            resolve: self.resolved.as_ref(),
            depth: &self.depth,
            reads,
        }
    }

    /// A buffer that the picture fits in.
    ///
    /// # Errors
    /// Beyond the device, or no memory.
    pub fn readback(&self, device: &Arc<Device>) -> Result<Buffer, Error> {
        let bytes = self.color.bytes();
        Buffer::new(device, "shading: readback", BufferUse::Readback, bytes)
    }

    /// Records the copy to the host.
    pub fn record_readback<'a>(&'a self, recorder: &mut Recorder<'a>, readback: &'a mut Buffer) {
        let image = self.resolved.as_ref().unwrap_or(&self.color);
        recorder.copy_image(image, readback);
    }

    /// What a readback brought.
    ///
    /// # Errors
    /// The driver gave memory that the host cannot see, or there is none left for the picture.
    pub fn picture(&self, readback: &Buffer) -> Result<Picture, Error> {
        let (width, height) = self.color.size();
        let texels: &[[f32; 4]] = bytemuck::cast_slice(readback.read()?);
        let mut pixels = Vec::new();
        pixels
            .try_reserve_exact(texels.len())
            .map_err(|error| Error::Memory {
                what: "the picture".into(),
                bytes: readback.bytes(),
                reason: error.to_string(),
            })?;
        pixels.extend_from_slice(texels);
        Ok(Picture {
            width,
            height,
            pixels,
        })
    }
}
