//! How do texels of the host become a texture array on the device?

use std::sync::Arc;

use ash::vk;

use super::barriers::ImageUse;
use super::buffer::{Buffer, BufferUse};
use super::commands::Recorder;
use super::device::Device;
use super::error::Error;
use super::format::TextureFormat;
use super::texture_array::{TextureArray, TextureInfo};
use super::upload::STAGING_BYTES;

/// Fills a texture array, a layer of a level at a time and in any order.
pub struct TextureUpload {
    device: Arc<Device>,
    array: TextureArray,
    staging: Buffer,
    staged: u64,
    /// The copies that the staged bytes wait for.
    copies: Vec<vk::BufferImageCopy>,
    /// What the array was last used for: a later copy must not undo an earlier one by a transition
    /// from nothing.
    pub(super) used: ImageUse,
    /// Which layers of which levels were written: `level * layers + layer`.
    written: Vec<bool>,
}

impl TextureUpload {
    /// A new array, to be filled whole.
    ///
    /// # Panics
    /// There are no levels, or more than the side has.
    ///
    /// # Errors
    /// Side or layers are beyond the device's limits, or no memory.
    pub fn new(device: &Arc<Device>, info: &TextureInfo) -> Result<Self, Error> {
        let array = TextureArray::new(device, info)?;
        let texels: u64 = (0..info.levels)
            .map(|level| u64::from(info.side(level)).pow(2) * u64::from(info.layers))
            .sum();
        let bytes = (texels * TextureFormat::TEXEL_BYTES).min(STAGING_BYTES);
        let name = format!("{}: staging", info.name);
        let staging = Buffer::new(device, &name, BufferUse::Staging, bytes)?;
        Ok(Self {
            device: Arc::clone(device),
            staging,
            staged: 0,
            copies: Vec::new(),
            used: ImageUse::Undefined,
            written: vec![false; info.levels as usize * info.layers as usize],
            array,
        })
    }

    /// Writes all texels of `layer` at `level`, from the top row down, without padding.
    ///
    /// # Panics
    /// There is no such level or layer, it was written before, or the bytes are not its size.
    ///
    /// # Errors
    /// A failed copy.
    pub fn write(&mut self, level: u32, layer: u32, texels: &[u8]) -> Result<(), Error> {
        let (levels, layers) = (self.array.levels(), self.array.layers());
        assert!(
            level < levels && layer < layers,
            "level {level} of {levels}, layer {layer} of {layers}"
        );
        let side = (self.array.size() >> level).max(1);
        let row = u64::from(side) * TextureFormat::TEXEL_BYTES;
        assert_eq!(
            texels.len() as u64,
            row * u64::from(side),
            "texels of level {level}"
        );
        let place = level as usize * layers as usize + layer as usize;
        assert!(
            !self.written[place],
            "level {level} of layer {layer} is written once"
        );
        self.written[place] = true;
        let mut top = 0;
        while top < side {
            if self.staging.bytes() - self.staged < row {
                self.flush(ImageUse::TransferDestination)?;
            }
            let room = (self.staging.bytes() - self.staged) / row;
            let rows = u64::from(side - top).min(room);
            // Both fit: they are parts of `texels`.
            let start = (u64::from(top) * row) as usize;
            let piece = &texels[start..start + (rows * row) as usize];
            self.staging.write(self.staged, piece)?;
            self.copies
                .push(rows_copy(self.staged, level, layer, side, top, rows as u32));
            self.staged += rows * row;
            top += rows as u32;
        }
        Ok(())
    }

    /// The filled array.
    ///
    /// # Panics
    /// A layer of a level was not written.
    ///
    /// # Errors
    /// A failed copy.
    pub fn finish(mut self) -> Result<Arc<TextureArray>, Error> {
        let missing = self.written.iter().filter(|written| !**written).count();
        assert_eq!(missing, 0, "layers of levels that were not written");
        self.flush(ImageUse::ShaderRead)?;
        Ok(Arc::new(self.array))
    }

    /// Copies what is staged; the array is then ready for `then`.
    fn flush(&mut self, then: ImageUse) -> Result<(), Error> {
        let mut recorder = Recorder::new(&self.device, "upload of textures")?;
        recorder.fill(
            &self.staging,
            &mut self.array,
            &self.copies,
            self.used,
            then,
        );
        recorder.submit()?;
        self.used = then;
        self.copies.clear();
        self.staged = 0;
        Ok(())
    }
}

/// A copy of whole rows.
fn rows_copy(
    offset: u64,
    level: u32,
    layer: u32,
    side: u32,
    top: u32,
    rows: u32,
) -> vk::BufferImageCopy {
    vk::BufferImageCopy::default()
        .buffer_offset(offset)
        .image_subresource(vk::ImageSubresourceLayers {
            aspect_mask: vk::ImageAspectFlags::COLOR,
            mip_level: level,
            base_array_layer: layer,
            layer_count: 1,
        })
        .image_offset(vk::Offset3D {
            x: 0,
            // Below every device's largest side.
            y: top as i32,
            z: 0,
        })
        .image_extent(vk::Extent3D {
            width: side,
            height: rows,
            depth: 1,
        })
}
