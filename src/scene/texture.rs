//! What does a texture hold, and which number is a texel?
//!
//! Texels are kept as the file has them (8 or 16 bits or f32 per channel, and only the channels that
//! the slot needs) and become linear numbers when they are read:
//!
//! * base colour and emission: linear sRGB; integers are decoded by the sRGB curve;
//! * normal: 2 c - 1 of each channel, made a unit vector. A z below 0 points into the surface and
//!   counts as 0; what has no length then is (0, 0, 1). A height map gives the normal of its slope;
//! * the rest: the number as stored, in red, green and blue alike.

use std::sync::LazyLock;

use glam::Vec3;

use super::maps::Slot;

/// The longest side of a texture, pixels: what Vulkan's Roadmap 2022 profile asks of devices, and more
/// texels than any picture can show.
pub const MAX_TEXTURE_SIDE: u32 = 8192;
/// The most pixels of all textures of a scene together: one of the longest sides, or sixteen of
/// 2048 x 2048. As RGBA8 they take 256 MiB.
pub const MAX_TEXTURE_PIXELS: u64 = 64 << 20;
/// The largest emission of a texel: the largest number of the shared-exponent format
/// E5B9G9R9, so that any format of a GPU can hold it.
pub const MAX_TEXEL_EMISSION: f32 = 65408.0;

/// A picture for one slot of materials. Row 0 is its top.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    name: String,
    slot: Slot,
    width: u32,
    height: u32,
    texels: Texels,
}

/// The numbers of a texture, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Texels {
    pub data: Data,
    pub kind: Kind,
}

/// One number per texel and channel, as stored.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Data {
    U8(Vec<u8>),
    U16(Vec<u16>),
    F32(Vec<f32>),
}

/// What the numbers are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// One channel, linear.
    Grey,
    /// Three channels, linear.
    Linear,
    /// Three channels of integers, sRGB-encoded.
    Encoded,
    /// Three channels that hold a vector as (v + 1) / 2.
    Vector,
    /// Three channels that hold a unit vector as it is.
    Unit,
    /// One channel, heights; a step of 1 between neighbours is a slope of this.
    Height(f32),
}

impl Kind {
    fn channels(self) -> usize {
        match self {
            Self::Grey | Self::Height(_) => 1,
            Self::Linear | Self::Encoded | Self::Vector | Self::Unit => 3,
        }
    }
}

impl Data {
    /// The numbers as 0..1 for integers, as they are for floats.
    pub(super) fn at(&self, place: usize) -> f32 {
        match self {
            Self::U8(data) => data
                .get(place)
                .map_or(0.0, |&x| f32::from(x) / f32::from(u8::MAX)),
            Self::U16(data) => data
                .get(place)
                .map_or(0.0, |&x| f32::from(x) / f32::from(u16::MAX)),
            Self::F32(data) => data.get(place).copied().unwrap_or(0.0),
        }
    }

    pub(super) fn len(&self) -> usize {
        match self {
            Self::U8(data) => data.len(),
            Self::U16(data) => data.len(),
            Self::F32(data) => data.len(),
        }
    }
}

impl Texture {
    /// A texture of numbers as [`Texture::texel`] gives them, row by row from the top; a slot of one
    /// channel takes red. Numbers out of range are clamped, normals made unit vectors. None for a
    /// side of 0 or above [`MAX_TEXTURE_SIDE`], a count that is not width times height, or a number
    /// that is not finite.
    pub fn from_linear(
        name: &str,
        slot: Slot,
        width: u32,
        height: u32,
        texels: &[[f32; 4]],
    ) -> Option<Self> {
        if texels.iter().flatten().any(|x| !x.is_finite()) {
            return None;
        }
        let (data, kind) = if slot.is_colored() {
            let rgb = texels.iter().map(|&[r, g, b, _]| match slot {
                Slot::Normal => unit([r, g, b]),
                _ => [r, g, b].map(|x| clamp(slot, x)),
            });
            let kind = match slot {
                Slot::Normal => Kind::Unit,
                _ => Kind::Linear,
            };
            (rgb.flatten().collect(), kind)
        } else {
            let grey = texels.iter().map(|texel| clamp(slot, texel[0]));
            (grey.collect(), Kind::Grey)
        };
        let data = Data::F32(data);
        Self::new(name, slot, [width, height], Texels { data, kind })
    }

    /// A texture of stored numbers, which are in range; None as above.
    pub(super) fn new(
        name: &str,
        slot: Slot,
        [width, height]: [u32; 2],
        texels: Texels,
    ) -> Option<Self> {
        let sides = 1..=MAX_TEXTURE_SIDE;
        let count = width as usize * height as usize * texels.kind.channels();
        let fits = sides.contains(&width) && sides.contains(&height);
        (fits && texels.data.len() == count).then(|| Self {
            name: name.to_owned(),
            slot,
            width,
            height,
            texels,
        })
    }

    /// What messages call it: its file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What it says of a surface.
    pub fn slot(&self) -> Slot {
        self.slot
    }

    /// Pixels from left to right, 1 to [`MAX_TEXTURE_SIDE`].
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Pixels from top to bottom, 1 to [`MAX_TEXTURE_SIDE`].
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The linear numbers of a texel, row 0 at the top; the last is 1. Base colour and emission:
    /// linear sRGB. Normal: a unit vector. Slots of one channel: the number in red, green and blue.
    /// Always finite; 0..1, emission 0..[`MAX_TEXEL_EMISSION`]. Beyond the edge: the edge's texel.
    pub fn texel(&self, x: u32, y: u32) -> [f32; 4] {
        let (x, y) = (x.min(self.width - 1), y.min(self.height - 1));
        let [r, g, b] = match self.texels.kind {
            Kind::Grey => [self.stored(x, y, 0); 3],
            Kind::Linear | Kind::Unit => [0, 1, 2].map(|channel| self.stored(x, y, channel)),
            Kind::Encoded => [0, 1, 2].map(|channel| self.decoded(x, y, channel)),
            Kind::Vector => unit([0, 1, 2].map(|c| 2.0 * self.stored(x, y, c) - 1.0)),
            Kind::Height(slope) => self.slope(x, y, slope),
        };
        [r, g, b, 1.0]
    }

    fn stored(&self, x: u32, y: u32, channel: usize) -> f32 {
        self.texels.data.at(self.place(x, y, channel))
    }

    fn place(&self, x: u32, y: u32, channel: usize) -> usize {
        let pixel = y as usize * self.width as usize + x as usize;
        pixel * self.texels.kind.channels() + channel
    }

    /// A number of an sRGB-encoded texture, linear. Of 8 bits by a table: a scene may have 200 million.
    fn decoded(&self, x: u32, y: u32, channel: usize) -> f32 {
        static CODES: LazyLock<[f32; 256]> = LazyLock::new(|| {
            std::array::from_fn(|code| decode_srgb(code as f32 / f32::from(u8::MAX)))
        });
        match &self.texels.data {
            Data::U8(data) => data
                .get(self.place(x, y, channel))
                .map_or(0.0, |&code| CODES[usize::from(code)]),
            _ => decode_srgb(self.stored(x, y, channel)),
        }
    }

    /// The normal of a height map by central differences, where the picture repeats; y is up, and
    /// rows go down.
    fn slope(&self, x: u32, y: u32, slope: f32) -> [f32; 3] {
        let (width, height) = (self.width, self.height);
        let at = |x: u32, y: u32| self.stored(x % width, y % height, 0);
        let across = at(x + 1, y) - at(x + width - 1, y);
        let upward = at(x, y + height - 1) - at(x, y + 1);
        unit([-0.5 * slope * across, -0.5 * slope * upward, 1.0])
    }
}

/// A number of a texel within the range of its slot.
pub(super) fn clamp(slot: Slot, x: f32) -> f32 {
    // `clamp` keeps -0, and a shader would divide by it.
    x.clamp(0.0, largest(slot)) + 0.0
}

/// The largest number of a texel in a slot.
pub(super) fn largest(slot: Slot) -> f32 {
    match slot {
        Slot::Emission => MAX_TEXEL_EMISSION,
        _ => 1.0,
    }
}

/// A normal of a map as a unit vector that does not point into the surface.
fn unit([x, y, z]: [f32; 3]) -> [f32; 3] {
    Vec3::new(x, y, z.max(0.0)).normalize_or(Vec3::Z).to_array()
}

/// The linear value of an sRGB-encoded one (IEC 61966-2-1).
fn decode_srgb(x: f32) -> f32 {
    if x <= 0.04045 {
        x / 12.92
    } else {
        ((x + 0.055) / 1.055).powf(2.4)
    }
}
