//! Which textures do the materials of a scene need, and what becomes of a picture in its slot?
//!
//! Each picture is decoded when a material in use names it, and kept once per file, slot and
//! channel. All together may have 64 Mi pixels, 8192 a side; a file may have 256 MiB.
//!
//! * Slots of three numbers take red, green and blue; a grey picture is grey in all three. The alpha
//!   of a base colour has no effect: name the file as `alpha_mask` too.
//! * Slots of one number take the stated channel. Without one: of a grey picture its grey, of a
//!   colour picture its luminance as stored; the alpha mask takes alpha where that is not 1
//!   everywhere.
//! * Numbers of HDR and EXR that are out of range are clamped, with one warning per texture; NaN and
//!   infinity are refused.
//! * A normal map most of whose vectors are far from unit length, or point into the surface, is told
//!   of: it is some other picture.
//! * A picture that a scene names and that is missing, outside of the folder, of an unknown kind or
//!   without the stated channel is refused. Where an MTL file names it, the material is drawn without
//!   it, with a warning. A damaged or too large one is refused in both.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use glam::Vec3;

use super::description::{Channel, MapText, MtlOrigin};
use super::error::Error;
use super::image_file::{ImageFile, Picture};
use super::layers::Layers;
use super::maps::{Maps, Slot};
use super::texture::{self, Data, Kind, MAX_TEXTURE_PIXELS, Texels, Texture};
use super::warnings::Warnings;
use super::{paths, quote};

/// The most textures of a scene, as many small ones as anyone paints: each costs files and
/// descriptors besides its pixels.
pub const MAX_TEXTURES: usize = 4096;

/// The lengths that vectors of a normal map may have: averages of bent normals are shorter than 1,
/// those of 8 bits and JPEG a little longer. A mid-grey is 0, white 1.7.
const LENGTHS: std::ops::RangeInclusive<f32> = 0.7..=1.3;
/// Channels of a grey picture differ by no more: what JPEG makes of grey.
const GREY: f32 = 4.0 / 255.0;
/// How high white stands above black in a height map, as a part of the picture's width, times `-bm`:
/// a brick's joint in a picture of a metre. MTL files have no unit for it.
const BUMP_HEIGHT: f32 = 0.01;
/// The weights of red and blue in luminance (ITU-R BT.709; green has the rest).
const RED: f32 = 0.2126;
const BLUE: f32 = 0.0722;

/// What makes a texture one of its own: file, slot, channel, factor of heights.
type Key = (PathBuf, Slot, Option<Channel>, Option<u32>);

/// Loads textures, each once.
pub(super) struct TextureLoader {
    folder: PathBuf,
    known: HashMap<Key, usize>,
    /// The picture decoded last: the slots of a material often share one.
    last: Option<(PathBuf, Rc<Picture>)>,
    pixels: u64,
    pub textures: Vec<Texture>,
    pub warnings: Warnings,
}

/// Who names a picture.
struct Namer<'a> {
    key: [&'a str; 3],
    layers: &'a Layers,
    origin: Option<&'a MtlOrigin>,
}

impl Namer<'_> {
    /// What cannot be drawn: an error of the scene, a warning about an MTL.
    fn pass_over(&self, file: &str, message: String, warnings: &mut Warnings) -> Result<(), Error> {
        let file = quote::short(file);
        let Some(origin) = self.origin else {
            let key = quote::key(&self.key);
            let message = format!("{key} = '{file}' {message}");
            return Err(self.layers.error(&self.key, message));
        };
        let (path, line) = (quote::path(&origin.path), origin.line);
        warnings.push(format!(
            "{path}:{line}: '{file}' {message}; drawn without it"
        ));
        Ok(())
    }
}

impl TextureLoader {
    /// A loader of pictures that a scene in `folder` names.
    pub(super) fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_path_buf(),
            known: HashMap::new(),
            last: None,
            pixels: 0,
            textures: Vec::new(),
            warnings: Warnings::default(),
        }
    }

    /// Loads the pictures of the material `name` into its `maps`.
    pub(super) fn dress(
        &mut self,
        maps: &mut Maps,
        name: &str,
        list: &[(Slot, MapText)],
        layers: &Layers,
    ) -> Result<(), Error> {
        for (slot, map) in list {
            if let Some(texture) = self.load(name, *slot, map, layers)? {
                maps.set(*slot, texture);
            }
        }
        Ok(())
    }

    /// Refuses pictures that a material which nothing is made of could not have.
    pub(super) fn check(
        &mut self,
        name: &str,
        list: &[(Slot, MapText)],
        layers: &Layers,
    ) -> Result<(), Error> {
        for (slot, map) in list.iter().filter(|(_, map)| map.origin.is_none()) {
            self.locate(&namer(name, *slot, map, layers), *slot, map)?;
        }
        Ok(())
    }

    /// The file of a picture; None where it was passed over.
    fn locate(
        &mut self,
        namer: &Namer<'_>,
        slot: Slot,
        map: &MapText,
    ) -> Result<Option<paths::Found>, Error> {
        let key = quote::key(&namer.key);
        let Some(file) = &map.file else {
            let message = format!("{key} has no file: give file = \"...\"");
            return Err(namer.layers.error(&namer.key, message));
        };
        if slot.is_colored() && map.channel.is_some() && namer.origin.is_none() {
            let message = format!("{key}: a {} map has no channel: it takes all", slot.name());
            return Err(namer.layers.error(&namer.key, message));
        }
        let folder = match namer.origin {
            Some(origin) => origin.path.parent().unwrap_or(Path::new("")),
            None => &self.folder,
        };
        match paths::inside(folder, file) {
            Ok(Some(found)) => return Ok(Some(found)),
            Ok(None) => {
                let folder = quote::path(paths::shown(folder));
                let message = format!("is missing: no such file in '{folder}'");
                namer.pass_over(file, message, &mut self.warnings)?;
            }
            Err(message) => namer.pass_over(file, message, &mut self.warnings)?,
        }
        Ok(None)
    }

    fn load(
        &mut self,
        material: &str,
        slot: Slot,
        map: &MapText,
        layers: &Layers,
    ) -> Result<Option<usize>, Error> {
        let namer = namer(material, slot, map, layers);
        let Some(found) = self.locate(&namer, slot, map)? else {
            return Ok(None);
        };
        let file = map.file.as_deref().unwrap_or_default();
        let bump = map.origin.as_ref().and_then(|origin| origin.bump);
        let key = (found.real, slot, map.channel, bump.map(f32::to_bits));
        if let Some(&texture) = self.known.get(&key) {
            return Ok(Some(texture));
        }
        let picture = match self.picture(&found.path, &key.0)? {
            Ok(picture) => picture,
            Err(message) => {
                namer.pass_over(file, message, &mut self.warnings)?;
                return Ok(None);
            }
        };
        let texels = match self.texels(&found.path, &picture, slot, map.channel, bump) {
            Ok(texels) => texels,
            Err(message) => {
                namer.pass_over(file, message, &mut self.warnings)?;
                return Ok(None);
            }
        };
        let size = [picture.width, picture.height];
        let made = Texture::new(file, slot, size, texels);
        let Some(texture) = made.filter(|_| self.textures.len() < MAX_TEXTURES) else {
            let message = format!("more than {MAX_TEXTURES} textures: use fewer pictures");
            return Err(layers.error(&namer.key, message));
        };
        self.pixels += u64::from(picture.width) * u64::from(picture.height);
        self.known.insert(key, self.textures.len());
        self.textures.push(texture);
        Ok(Some(self.textures.len() - 1))
    }

    /// The picture in the file; a message where it is of an unknown kind.
    fn picture(&mut self, path: &Path, real: &Path) -> Result<Result<Rc<Picture>, String>, Error> {
        let room = MAX_TEXTURE_PIXELS - self.pixels;
        if let Some((last, picture)) = &self.last
            && last == real
            && u64::from(picture.width) * u64::from(picture.height) <= room
        {
            return Ok(Ok(picture.clone()));
        }
        self.last = None;
        let file = ImageFile::open(path)?;
        if let Some(message) = file.foreign() {
            return Ok(Err(message));
        }
        let picture = Rc::new(file.decode(room)?);
        if picture.animated {
            self.warn(path, "is animated: its still picture is taken");
        }
        self.last = Some((real.to_path_buf(), picture.clone()));
        Ok(Ok(picture))
    }

    fn warn(&mut self, path: &Path, message: &str) {
        self.warnings
            .push(format!("{}: {message}", quote::path(path)));
    }

    /// The numbers that a slot takes of a picture; a message where it has no such channel.
    fn texels(
        &mut self,
        path: &Path,
        picture: &Picture,
        slot: Slot,
        channel: Option<Channel>,
        bump: Option<f32>,
    ) -> Result<Texels, String> {
        let heights = bump.filter(|_| channel.is_some() || picture.is_grey());
        let mut texels = if let Some(bump) = heights {
            let slope = bump * BUMP_HEIGHT * picture.width as f32;
            Texels {
                data: picture.channel(slot, channel)?,
                kind: Kind::Height(slope),
            }
        } else if slot.is_colored() {
            let floats = matches!(picture.data, Data::F32(_));
            Texels {
                data: picture.color(),
                kind: match slot {
                    Slot::Normal => Kind::Vector,
                    _ if floats => Kind::Linear,
                    _ => Kind::Encoded,
                },
            }
        } else {
            Texels {
                data: picture.channel(slot, channel)?,
                kind: Kind::Grey,
            }
        };
        let clamped = clamp(slot, &mut texels.data);
        if clamped > 0 {
            let (name, largest) = (slot.name(), texture::largest(slot));
            let message = format!(
                "{clamped} numbers of the {name} map lie outside 0 to {largest} and are clamped"
            );
            self.warn(path, &message);
        }
        if texels.kind == Kind::Vector && !mostly_unit(&texels.data) {
            let message = "is used as a normal map, and most of its vectors have no unit length or \
                           point inwards: is it another picture?";
            self.warn(path, message);
        }
        Ok(texels)
    }
}

/// Who names the picture in a slot of the material `name`.
fn namer<'a>(name: &'a str, slot: Slot, map: &'a MapText, layers: &'a Layers) -> Namer<'a> {
    let key = match slot {
        Slot::BaseColor => "base_color_map",
        Slot::Roughness => "roughness_map",
        Slot::Metalness => "metalness_map",
        Slot::Normal => "normal_map",
        Slot::Emission => "emission_map",
        Slot::Occlusion => "occlusion_map",
        Slot::AlphaMask => "alpha_mask",
    };
    Namer {
        key: ["material", name, key],
        layers,
        origin: map.origin.as_ref(),
    }
}

/// Brings floats into the range of the slot; how many were outside. Integers always are inside.
fn clamp(slot: Slot, data: &mut Data) -> usize {
    let Data::F32(list) = data else {
        return 0;
    };
    let mut count = 0;
    for x in list {
        let inside = texture::clamp(slot, *x);
        count += usize::from(inside != *x);
        *x = inside;
    }
    count
}

/// True where at least half of the vectors of a normal map could be normals.
fn mostly_unit(data: &Data) -> bool {
    let pixels = data.len() / 3;
    let vector = |pixel: usize| [0, 1, 2].map(|c| 2.0 * data.at(3 * pixel + c) - 1.0);
    let good = (0..pixels)
        .map(vector)
        .filter(|&[x, y, z]| z >= 0.0 && LENGTHS.contains(&Vec3::new(x, y, z).length()));
    2 * good.count() >= pixels
}

impl Picture {
    fn has_color(&self) -> bool {
        self.channels >= 3
    }

    fn has_alpha(&self) -> bool {
        self.channels.is_multiple_of(2)
    }

    /// The data's places pixel by pixel.
    fn pixels(&self) -> impl Iterator<Item = usize> {
        (0..self.data.len()).step_by(self.channels)
    }

    /// True where red, green and blue are the same but for noise.
    fn is_grey(&self) -> bool {
        !self.has_color()
            || self.pixels().all(|place| {
                let [r, g, b] = [0, 1, 2].map(|c| self.data.at(place + c));
                r.max(g).max(b) - r.min(g).min(b) <= GREY
            })
    }

    /// Three numbers per pixel.
    fn color(&self) -> Data {
        let last = if self.has_color() { 2 } else { 0 };
        self.pick(&[0, last / 2, last])
    }

    /// One number per pixel: the stated channel, or the one that the slot takes.
    fn channel(&self, slot: Slot, channel: Option<Channel>) -> Result<Data, String> {
        let color = |number: usize| if self.has_color() { number } else { 0 };
        let alpha = self.channels - 1;
        let opaque = || {
            self.pixels()
                .all(|place| self.data.at(place + alpha) == 1.0)
        };
        Ok(match channel {
            Some(Channel::Red) => self.pick(&[0]),
            Some(Channel::Green) => self.pick(&[color(1)]),
            Some(Channel::Blue) => self.pick(&[color(2)]),
            Some(Channel::Alpha) if self.has_alpha() => self.pick(&[alpha]),
            Some(Channel::Alpha) => {
                return Err("has no alpha channel: state r, g or b".to_owned());
            }
            None if slot == Slot::AlphaMask && self.has_alpha() && !opaque() => self.pick(&[alpha]),
            None if self.has_color() => self.luminance(),
            None => self.pick(&[0]),
        })
    }

    /// The given channels of each pixel, as they are stored.
    fn pick(&self, channels: &[usize]) -> Data {
        fn pick<T: Copy>(data: &[T], step: usize, channels: &[usize]) -> Vec<T> {
            let mut picked = Vec::with_capacity(data.len() / step * channels.len());
            for pixel in data.chunks_exact(step) {
                picked.extend(channels.iter().map(|&channel| pixel[channel]));
            }
            picked
        }
        match &self.data {
            Data::U8(data) => Data::U8(pick(data, self.channels, channels)),
            Data::U16(data) => Data::U16(pick(data, self.channels, channels)),
            Data::F32(data) => Data::F32(pick(data, self.channels, channels)),
        }
    }

    /// The luminance of each pixel; of 8 bits with 16, so that the mean of three keeps its parts.
    fn luminance(&self) -> Data {
        let luminance = |place: usize| -> f32 {
            let [r, g, b] = [0, 1, 2].map(|c| self.data.at(place + c));
            // In this order grey stays the number that it is.
            g + RED * (r - g) + BLUE * (b - g)
        };
        let list = self.pixels().map(luminance);
        match self.data {
            Data::F32(_) => Data::F32(list.collect()),
            Data::U8(_) | Data::U16(_) => Data::U16(
                list.map(|x| (x * f32::from(u16::MAX)).round() as u16)
                    .collect(),
            ),
        }
    }
}
