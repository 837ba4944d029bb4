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

/// The formats of vertex attributes; a buffer of them is tightly packed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum VertexFormat {
    /// Three 32-bit floats.
    Rgb32Float,
}

impl VertexFormat {
    pub(super) fn vulkan(self) -> vk::Format {
        match self {
            Self::Rgb32Float => vk::Format::R32G32B32_SFLOAT,
        }
    }

    /// Size of one attribute.
    pub fn bytes(self) -> u32 {
        match self {
            Self::Rgb32Float => 12,
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
