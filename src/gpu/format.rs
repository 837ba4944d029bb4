//! Which formats, sample counts and uses of memory does Umber know?

use ash::vk;

/// The texel and vertex formats in use.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Format {
    /// Four floats: the colour target.
    Rgba32Float,
    /// Three floats: positions and normals.
    Rgb32Float,
    /// One float of depth.
    Depth32Float,
}

impl Format {
    pub(super) fn vulkan(self) -> vk::Format {
        match self {
            Self::Rgba32Float => vk::Format::R32G32B32A32_SFLOAT,
            Self::Rgb32Float => vk::Format::R32G32B32_SFLOAT,
            Self::Depth32Float => vk::Format::D32_SFLOAT,
        }
    }

    /// Size of one texel or vertex attribute.
    pub fn bytes(self) -> u32 {
        match self {
            Self::Rgba32Float => 16,
            Self::Rgb32Float => 12,
            Self::Depth32Float => 4,
        }
    }

    pub(super) fn aspect(self) -> vk::ImageAspectFlags {
        match self {
            Self::Depth32Float => vk::ImageAspectFlags::DEPTH,
            Self::Rgba32Float | Self::Rgb32Float => vk::ImageAspectFlags::COLOR,
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
