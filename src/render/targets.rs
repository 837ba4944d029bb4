//! What is drawn to, and how does the host see it?

use std::sync::Arc;

use super::picture::Picture;
use crate::gpu::{
    Buffer, BufferUse, Device, Error, Image, ImageInfo, PassInfo, Recorder, Samples, requirements,
};

/// Colour, depth, where colour is resolved to, and the buffer that brings it home.
pub struct Targets {
    color: Image,
    resolved: Option<Image>,
    depth: Image,
    readback: Buffer,
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
        let readback = Buffer::new(
            device,
            "shading: readback",
            BufferUse::Readback,
            color.bytes(),
        )?;
        Ok(Self {
            color,
            resolved,
            depth,
            readback,
        })
    }

    /// A pass that draws to these targets.
    pub fn pass<'a>(&'a self, name: &'a str) -> PassInfo<'a> {
        PassInfo {
            name,
            color: &self.color,
            resolve: self.resolved.as_ref(),
            depth: &self.depth,
        }
    }

    /// Records the copy to the host.
    pub fn record_readback<'a>(&'a self, recorder: &mut Recorder<'a>) {
        let image = self.resolved.as_ref().unwrap_or(&self.color);
        recorder.copy_image(image, &self.readback);
    }

    /// What the last readback brought.
    ///
    /// # Errors
    /// The driver gave memory that the host cannot see.
    pub fn picture(&self) -> Result<Picture, Error> {
        let (width, height) = self.color.size();
        Ok(Picture {
            width,
            height,
            pixels: bytemuck::pod_collect_to_vec(self.readback.read()?),
        })
    }
}
