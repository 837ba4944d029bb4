//! Where do bytes live that shaders read, and how do they get there and back?

use std::mem::ManuallyDrop;
use std::sync::Arc;

use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::Allocation;

use super::device::Device;
use super::error::{Error, Named};
use super::upload::Upload;

/// What a buffer is for; it decides usage flags and memory.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum BufferUse {
    /// A uniform block.
    Uniform,
    /// Uniform blocks, each at a multiple of [`Device::uniform_alignment`].
    UniformWindows,
    /// A storage block.
    Storage,
    /// A storage block that compute shaders write.
    Written,
    /// Vertices.
    Vertices,
    /// 32-bit indices.
    Indices,
    /// Draw commands.
    Indirect,
    /// Written by the host, copied from.
    Staging,
    /// Copied to, read by the host.
    Readback,
}

impl BufferUse {
    fn usage(self) -> vk::BufferUsageFlags {
        let from_staging = vk::BufferUsageFlags::TRANSFER_DST;
        match self {
            Self::Uniform | Self::UniformWindows => {
                vk::BufferUsageFlags::UNIFORM_BUFFER | from_staging
            }
            Self::Storage => vk::BufferUsageFlags::STORAGE_BUFFER | from_staging,
            Self::Written => {
                vk::BufferUsageFlags::STORAGE_BUFFER
                    | from_staging
                    | vk::BufferUsageFlags::TRANSFER_SRC
            }
            Self::Vertices => vk::BufferUsageFlags::VERTEX_BUFFER | from_staging,
            Self::Indices => vk::BufferUsageFlags::INDEX_BUFFER | from_staging,
            Self::Indirect => vk::BufferUsageFlags::INDIRECT_BUFFER | from_staging,
            Self::Staging => vk::BufferUsageFlags::TRANSFER_SRC,
            Self::Readback => vk::BufferUsageFlags::TRANSFER_DST,
        }
    }

    fn location(self) -> MemoryLocation {
        match self {
            Self::Staging => MemoryLocation::CpuToGpu,
            // Cached on the host: an uncached readback is read at a hundredth of the speed.
            Self::Readback => MemoryLocation::GpuToCpu,
            _ => MemoryLocation::GpuOnly,
        }
    }
}

/// A buffer and its memory. Dropped: the buffer, its memory, then its hold on the device.
pub struct Buffer {
    pub(super) raw: vk::Buffer,
    allocation: ManuallyDrop<Allocation>,
    bytes: u64,
    usage: BufferUse,
    device: Arc<Device>,
}

impl Buffer {
    /// An uninitialised buffer of `bytes` (at least 1).
    ///
    /// # Errors
    /// Beyond the device's limits, or no memory.
    pub fn new(
        device: &Arc<Device>,
        name: &str,
        usage: BufferUse,
        bytes: u64,
    ) -> Result<Self, Error> {
        assert!(bytes > 0, "{name}: a buffer of no bytes");
        check_size(device, name, usage, bytes)?;
        let info = vk::BufferCreateInfo::default()
            .size(bytes)
            .usage(usage.usage());
        // SAFETY: the size is not 0 (VUID-VkBufferCreateInfo-size-00912) nor beyond maxBufferSize
        // (VUID-VkBufferCreateInfo-size-06409): both were checked.
        let raw = unsafe { device.raw.create_buffer(&info, None) }.named("vkCreateBuffer")?;
        let allocation = match allocate(device, name, raw, usage) {
            Ok(allocation) => allocation,
            Err(error) => {
                // SAFETY: the buffer was never used.
                unsafe { device.raw.destroy_buffer(raw, None) };
                return Err(error);
            }
        };
        device.name(raw, name);
        device.count_buffer();
        Ok(Self {
            raw,
            allocation: ManuallyDrop::new(allocation),
            bytes,
            usage,
            device: Arc::clone(device),
        })
    }

    /// A device buffer that holds `data`.
    ///
    /// # Errors
    /// Beyond the device's limits, no memory, or a failed copy.
    pub fn with_data(
        device: &Arc<Device>,
        name: &str,
        usage: BufferUse,
        data: &[u8],
    ) -> Result<Self, Error> {
        let mut upload = Upload::new(device, name, usage, data.len() as u64)?;
        upload.write(data)?;
        upload.finish()
    }

    pub(super) fn is_of(&self, device: &Arc<Device>) -> bool {
        Arc::ptr_eq(&self.device, device)
    }

    /// Size in bytes.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// What the buffer is for.
    pub fn usage(&self) -> BufferUse {
        self.usage
    }

    /// Whether a window of `bytes` can stand at `offset`.
    pub(super) fn fits_window(&self, offset: u32, bytes: u32) -> bool {
        let aligned = offset.is_multiple_of(self.device.uniform_alignment());
        let limit = self.device.limits.max_uniform_buffer_range;
        aligned && bytes <= limit && u64::from(offset) + u64::from(bytes) <= self.bytes
    }

    /// The bytes of a readback buffer.
    ///
    /// # Errors
    /// The memory is not mapped: the buffer is of another use.
    pub fn read(&self) -> Result<&[u8], Error> {
        let length = usize::try_from(self.bytes).unwrap_or(usize::MAX);
        self.allocation
            .mapped_slice()
            .and_then(|slice| slice.get(..length))
            .ok_or_else(|| self.not_mapped())
    }

    /// Writes into a staging buffer.
    pub(super) fn write(&mut self, offset: u64, data: &[u8]) -> Result<(), Error> {
        let start = usize::try_from(offset).unwrap_or(usize::MAX);
        let mapped = self.allocation.mapped_slice_mut();
        match mapped.and_then(|slice| slice.get_mut(start..)?.get_mut(..data.len())) {
            Some(place) => {
                place.copy_from_slice(data);
                Ok(())
            }
            None => Err(self.not_mapped()),
        }
    }

    fn not_mapped(&self) -> Error {
        Error::Memory {
            what: format!("a mapped {:?} buffer", self.usage),
            bytes: self.bytes,
            reason: "the driver gave memory that the host cannot see".into(),
        }
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: recorders borrow what they use until the device is done with it, so no work
        // is left that needs this buffer; the allocation is taken once.
        let allocation = unsafe {
            self.device.raw.destroy_buffer(self.raw, None);
            ManuallyDrop::take(&mut self.allocation)
        };
        // A failure to free is a leak, and there is nobody left to tell.
        let _ = self.device.allocator().free(allocation);
    }
}

fn check_size(device: &Device, name: &str, usage: BufferUse, bytes: u64) -> Result<(), Error> {
    let limits = &device.limits;
    let range = match usage {
        BufferUse::Storage | BufferUse::Written => limits.max_storage_buffer_range.into(),
        BufferUse::Uniform => limits.max_uniform_buffer_range.into(),
        _ => u64::MAX,
    };
    let limit = range.min(device.max_buffer_bytes);
    if bytes > limit {
        return Err(device.beyond(format!("the buffer '{name}' in bytes"), bytes, limit));
    }
    Ok(())
}

fn allocate(
    device: &Device,
    name: &str,
    buffer: vk::Buffer,
    usage: BufferUse,
) -> Result<Allocation, Error> {
    // SAFETY: the buffer is this device's.
    let requirements = unsafe { device.raw.get_buffer_memory_requirements(buffer) };
    let allocation = device.allocate(name, requirements, usage.location(), true)?;
    // SAFETY: memory of the buffer's own requirements, bound once.
    let bound = unsafe {
        device
            .raw
            .bind_buffer_memory(buffer, allocation.memory(), allocation.offset())
    };
    device.keep_if(bound, allocation, "vkBindBufferMemory")
}
