//! What can go wrong on the GPU floor, and what should the reader do about it?

use std::fmt;

/// Everything that this floor refuses or fails at. Programmer errors are asserts; these are the world's.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// No `libvulkan` on this system.
    #[error("no Vulkan loader: {reason}\n{}", install_line())]
    NoLoader {
        /// What the dynamic linker said.
        reason: String,
    },
    /// A loader, but nothing behind it.
    #[error("the Vulkan loader finds no driver ({reason})\n{}", install_line())]
    NoDriver {
        /// What the loader said.
        reason: String,
    },
    /// Validation was asked for, and the layer is not installed.
    #[error(
        "the validation layer VK_LAYER_KHRONOS_validation is not installed\n\
         on Debian or Ubuntu: apt-get install vulkan-validationlayers"
    )]
    NoValidationLayer,
    /// No device fits `--device`.
    #[error("no device fits '{wanted}'; there is:\n{available}")]
    NoSuchDevice {
        /// The selector as the user gave it.
        wanted: String,
        /// One line a device.
        available: String,
    },
    /// The device lacks something that Umber is built on.
    #[error("{device} cannot run Umber: it lacks {missing}; see `umber devices` for others")]
    Unsuitable {
        /// The device's name.
        device: String,
        /// What it lacks, separated by commas.
        missing: String,
    },
    /// A size or count beyond the device's limits.
    #[error("{what} is {value}, but {device} allows at most {limit}")]
    BeyondLimit {
        /// What was asked for.
        what: String,
        /// How much of it.
        value: u64,
        /// The device's limit.
        limit: u64,
        /// The device's name.
        device: String,
    },
    /// A sample count that the device does not have.
    #[error("{device} has no {wanted}x multisampling for this target; it has {available}")]
    NoSuchSampleCount {
        /// Samples a pixel, as asked for.
        wanted: u32,
        /// The counts it has.
        available: String,
        /// The device's name.
        device: String,
    },
    /// A Vulkan call failed.
    #[error("{call} failed: {result}{}", during(.pass))]
    Call {
        /// The call's Vulkan name.
        call: &'static str,
        /// Its result.
        result: VulkanResult,
        /// The last pass of what was submitted, if any.
        pass: Option<String>,
    },
    /// The allocator failed.
    #[error("no memory for {what} ({bytes} bytes): {reason}")]
    Memory {
        /// The name of the resource.
        what: String,
        /// Its size.
        bytes: u64,
        /// What the allocator said.
        reason: String,
    },
}

/// A result code of Vulkan, kept opaque so that the floors above need not know ash.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct VulkanResult(pub(super) ash::vk::Result);

impl fmt::Debug for VulkanResult {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.0)
    }
}

impl fmt::Display for VulkanResult {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({:?})", self.0, self.0)
    }
}

/// The line that installs a Vulkan driver on this system.
pub fn install_line() -> &'static str {
    if cfg!(target_os = "macos") {
        "on macOS: brew install molten-vk vulkan-loader"
    } else if cfg!(target_os = "windows") {
        "on Windows: install your graphics card's driver"
    } else {
        "on Debian or Ubuntu: apt-get install libvulkan1 mesa-vulkan-drivers\n\
         on Fedora: dnf install vulkan-loader mesa-vulkan-drivers\n\
         on Arch: pacman -S vulkan-icd-loader vulkan-swrast"
    }
}

impl Error {
    /// The same error, with the pass that was under way.
    pub(super) fn during(mut self, last: Option<String>) -> Self {
        if let Self::Call { pass, .. } = &mut self {
            *pass = last;
        }
        self
    }
}

fn during(pass: &Option<String>) -> String {
    match pass {
        Some(pass) => format!(" (in a submission that ends with the pass '{pass}')"),
        None => String::new(),
    }
}

/// Attaches the name of the call to its result.
pub(super) trait Named<T> {
    fn named(self, call: &'static str) -> Result<T, Error>;
}

impl<T> Named<T> for Result<T, ash::vk::Result> {
    fn named(self, call: &'static str) -> Result<T, Error> {
        self.map_err(|result| Error::Call {
            call,
            result: VulkanResult(result),
            pass: None,
        })
    }
}
