//! How do a scene's textures become arrays on the device?
//!
//! Each slot has one format of four bytes a texel; a format has up to [`SIZE_CLASSES`] arrays, of sides that are
//! powers of two and come from the textures themselves. A texture fills its layer, so that it repeats without a seam, and
//! has all its levels. They are made on the host, from linear values: the same on every driver.

mod classes;
mod encode;
mod pyramid;

use std::sync::Arc;

use crate::gpu::{Device, Error, TextureArray, TextureFormat, TextureInfo, TextureUpload};
use crate::interface::reflected::values;
use crate::scene::{Scene, Slot, Texture};
pub use classes::SIZE_CLASSES;
use classes::{class_of, classes, side_of};
use encode::encode;
use pyramid::pyramid;

/// The formats, in the order of the set's bindings.
const FORMATS: [TextureFormat; 4] = [
    TextureFormat::Rgba8Srgb,
    TextureFormat::Rgba8,
    TextureFormat::Rg16Float,
    TextureFormat::Rgb9E5,
];

/// How the maps of a slot are stored.
fn format(slot: Slot) -> TextureFormat {
    match slot {
        Slot::BaseColor => TextureFormat::Rgba8Srgb,
        Slot::Roughness | Slot::Metalness | Slot::Occlusion | Slot::AlphaMask => {
            TextureFormat::Rgba8
        }
        // x and y; 8 bits would show as steps in a smooth highlight.
        Slot::Normal => TextureFormat::Rg16Float,
        Slot::Emission => TextureFormat::Rgb9E5,
    }
}

/// The handle of a map that is not there; no bit of an effect lets it be read.
const NONE: u32 = u32::MAX;

/// The maps of a scene.
pub struct Maps {
    /// For each texture of the scene its class and layer.
    handles: Vec<u32>,
    /// For each format its classes, small to large.
    arrays: [[Option<Arc<TextureArray>>; SIZE_CLASSES]; FORMATS.len()],
}

impl Maps {
    /// Uploads the textures of the slots that are `needed`.
    ///
    /// # Errors
    /// More textures of one size than the device has layers, no memory, or the driver fails.
    pub fn new(
        device: &Arc<Device>,
        scene: &Scene,
        needed: impl Fn(Slot) -> bool,
    ) -> Result<Self, Error> {
        let mut maps = Self {
            handles: vec![NONE; scene.textures.len()],
            arrays: [const { [const { None }; SIZE_CLASSES] }; FORMATS.len()],
        };
        for (arrays, of) in maps.arrays.iter_mut().zip(FORMATS) {
            let textures = scene.textures.iter().enumerate();
            let textures: Vec<_> = textures
                .filter(|(_, texture)| format(texture.slot()) == of && needed(texture.slot()))
                .collect();
            let sides = classes(textures.iter().map(|(_, texture)| side_of(texture)));
            check_texels(
                device,
                textures.iter().map(|(_, texture)| side_of(texture)),
                &sides,
            )?;
            for (class, (array, side)) in arrays.iter_mut().zip(&sides).enumerate() {
                let layers: Vec<_> = textures
                    .iter()
                    .filter(|(_, texture)| class_of(side_of(texture), &sides) == class)
                    .collect();
                for (layer, (number, _)) in (0..).zip(&layers) {
                    maps.handles[*number] = (class as u32) << values::MAP_CLASS_SHIFT | layer;
                }
                let textures = layers.iter().map(|(_, texture)| *texture);
                *array = Some(upload(device, of, *side, textures)?);
            }
        }
        Ok(maps)
    }

    /// The handle of a texture of the scene.
    pub fn handle(&self, texture: Option<usize>) -> u32 {
        let handle = texture.and_then(|number| self.handles.get(number));
        handle.copied().unwrap_or(NONE)
    }

    /// The most size classes of any format, at least 1.
    pub fn classes(&self) -> i32 {
        let of_format = |arrays: &[Option<_>; SIZE_CLASSES]| arrays.iter().flatten().count();
        let most = self.arrays.iter().map(of_format).max();
        most.unwrap_or(0).max(1) as i32
    }

    /// The arrays, format by format, small to large.
    pub fn arrays(&self) -> impl Iterator<Item = Option<&Arc<TextureArray>>> {
        self.arrays.as_flattened().iter().map(Option::as_ref)
    }
}

/// A texture in an array of its own.
///
/// # Errors
/// No memory, or the driver fails.
pub fn alone(device: &Arc<Device>, texture: &Texture) -> Result<Arc<TextureArray>, Error> {
    let of = format(texture.slot());
    upload(device, of, side_of(texture), [texture].into_iter())
}

/// The most texels of one format's arrays, largest level: 512 MiB on the device, 683 with all levels.
const MOST_TEXELS: u64 = 128 << 20;

/// A long and thin picture grows where it is made square: what the loader counted is not what it takes.
fn check_texels(
    device: &Device,
    wanted: impl Iterator<Item = u32>,
    sides: &[u32],
) -> Result<(), Error> {
    let side = |wanted| u64::from(sides[class_of(wanted, sides)]);
    let texels = wanted.map(|wanted| side(wanted).pow(2)).sum();
    if texels > MOST_TEXELS {
        return Err(Error::BeyondLimit {
            what: "the maps of one kind, each made square, in texels".into(),
            value: texels,
            limit: MOST_TEXELS,
            device: device.info().name.clone(),
        });
    }
    Ok(())
}

/// An array of textures of one format, each of which fills a layer.
fn upload<'a>(
    device: &Arc<Device>,
    format: TextureFormat,
    side: u32,
    textures: impl ExactSizeIterator<Item = &'a Texture>,
) -> Result<Arc<TextureArray>, Error> {
    let info = TextureInfo {
        name: &format!("maps {format:?} {side}"),
        format,
        size: side,
        // A scene's textures are counted by its loader, far below this.
        layers: textures.len() as u32,
        levels: TextureInfo::all_levels(side),
    };
    let mut upload = TextureUpload::new(device, &info)?;
    for (layer, texture) in (0..).zip(textures) {
        for (number, level) in (0..).zip(pyramid(texture, side)) {
            upload.write(number, layer, &encode(&level.texels, format))?;
        }
    }
    upload.finish()
}
