//! Which formats and sample counts does Umber know?

use ash::vk;

/// The texel formats of render targets.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TargetFormat {
    /// Red, green, blue, alpha as 32-bit floats.
    Rgba32Float,
    /// Depth as a 32-bit float.
    Depth32Float,
}

impl TargetFormat {
    pub(super) fn vulkan(self) -> vk::Format {
        match self {
            Self::Rgba32Float => vk::Format::R32G32B32A32_SFLOAT,
            Self::Depth32Float => vk::Format::D32_SFLOAT,
        }
    }

    /// Size of one texel.
    pub fn bytes(self) -> u64 {
        match self {
            Self::Rgba32Float => 16,
            Self::Depth32Float => 4,
        }
    }

    pub(super) fn aspect(self) -> vk::ImageAspectFlags {
        match self {
            Self::Depth32Float => vk::ImageAspectFlags::DEPTH,
            Self::Rgba32Float => vk::ImageAspectFlags::COLOR,
        }
    }
}

/// The texel formats of sampled textures: four bytes each, and each filters linearly on every device
/// (Vulkan 1.3, "Required Format Support").
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TextureFormat {
    /// Red, green, blue in sRGB's coding, decoded before they are filtered; alpha as it is.
    Rgba8Srgb,
    /// Four fractions of 255.
    Rgba8,
    /// Red and green as 16-bit floats.
    Rg16Float,
    /// Red, green, blue of nine bits with one exponent of five; never negative.
    Rgb9E5,
}

impl TextureFormat {
    /// Every format.
    pub const ALL: &'static [Self] = &[Self::Rgba8Srgb, Self::Rgba8, Self::Rg16Float, Self::Rgb9E5];
    /// Size of one texel.
    pub const TEXEL_BYTES: u64 = 4;

    pub(super) fn vulkan(self) -> vk::Format {
        match self {
            Self::Rgba8Srgb => vk::Format::R8G8B8A8_SRGB,
            Self::Rgba8 => vk::Format::R8G8B8A8_UNORM,
            Self::Rg16Float => vk::Format::R16G16_SFLOAT,
            Self::Rgb9E5 => vk::Format::E5B9G9R9_UFLOAT_PACK32,
        }
    }
}

/// The formats of vertex attributes; a buffer of them is tightly packed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum VertexFormat {
    /// Two 32-bit floats.
    Rg32Float,
    /// Three 32-bit floats.
    Rgb32Float,
    /// Four 32-bit floats.
    Rgba32Float,
}

impl VertexFormat {
    pub(super) fn vulkan(self) -> vk::Format {
        match self {
            Self::Rg32Float => vk::Format::R32G32_SFLOAT,
            Self::Rgb32Float => vk::Format::R32G32B32_SFLOAT,
            Self::Rgba32Float => vk::Format::R32G32B32A32_SFLOAT,
        }
    }

    /// Size of one attribute.
    pub fn bytes(self) -> u32 {
        match self {
            Self::Rg32Float => 8,
            Self::Rgb32Float => 12,
            Self::Rgba32Float => 16,
        }
    }
}

/// Samples a pixel.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Samples {
    /// One: what physics, NaN and golden tests use, since a resolve would hide them.
    One,
    /// Two.
    Two,
    /// Four: the default of pictures.
    Four,
    /// Eight.
    Eight,
}

impl Samples {
    /// Every count.
    pub const ALL: &'static [Self] = &[Self::One, Self::Two, Self::Four, Self::Eight];

    /// The count as a number.
    pub fn count(self) -> u32 {
        match self {
            Self::One => 1,
            Self::Two => 2,
            Self::Four => 4,
            Self::Eight => 8,
        }
    }

    /// The count from a number.
    pub fn from_count(count: u32) -> Option<Self> {
        Self::ALL.iter().copied().find(|s| s.count() == count)
    }

    pub(super) fn vulkan(self) -> vk::SampleCountFlags {
        match self {
            Self::One => vk::SampleCountFlags::TYPE_1,
            Self::Two => vk::SampleCountFlags::TYPE_2,
            Self::Four => vk::SampleCountFlags::TYPE_4,
            Self::Eight => vk::SampleCountFlags::TYPE_8,
        }
    }
}
