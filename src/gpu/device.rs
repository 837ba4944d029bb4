//! Who talks to the device, and who owns it?

use std::ffi::CString;
use std::mem::ManuallyDrop;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ash::khr::pipeline_executable_properties;
use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{
    Allocation, AllocationCreateDesc, AllocationScheme, Allocator, AllocatorCreateDesc,
};

use super::error::{Error, Named};
use super::executable_statistics;
use super::format::Samples;
use super::instance::Instance;
use super::requirements;
use super::selection::DeviceInfo;

/// A device, its one queue, its allocator.
///
/// Everything made from it holds an `Arc` of it. Dropped in this order: allocator (which frees its
/// blocks), device, and the `Arc` of the instance last, as the fields stand.
pub struct Device {
    allocator: ManuallyDrop<Mutex<Allocator>>,
    pub(super) raw: ash::Device,
    pub(super) debug_utils: Option<ash::ext::debug_utils::Device>,
    queue: Mutex<vk::Queue>,
    pub(super) queue_family: u32,
    pub(super) limits: vk::PhysicalDeviceLimits,
    /// Bits of a timestamp that count; 0 where the queue has no clock.
    pub(super) timestamp_bits: u32,
    /// The largest buffer, and the largest piece of memory behind one.
    pub(super) max_buffer_bytes: u64,
    pub(super) preserves_nan: bool,
    draws_indirect: bool,
    /// Where the driver tells of the code that it makes.
    pub(super) executable_properties: Option<pipeline_executable_properties::Device>,
    pub(super) cache_key: CacheKey,
    samples: Vec<Samples>,
    info: DeviceInfo,
    pipelines_created: AtomicU64,
    images_created: AtomicU64,
    buffers_created: AtomicU64,
    pub(super) instance: Arc<Instance>,
}

/// What a pipeline cache must match to be of use; the driver checks the same.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct CacheKey {
    pub vendor: u32,
    pub device: u32,
    pub uuid: [u8; 16],
}

impl Device {
    /// Opens the device that `info` describes, with one graphics queue.
    ///
    /// # Errors
    /// The device is not (or no longer) there, it lacks what Umber needs, or the driver fails.
    pub fn open(instance: &Arc<Instance>, info: &DeviceInfo) -> Result<Arc<Self>, Error> {
        let (physical, info) = instance.find(info)?;
        let unsuitable = |missing: String| Error::Unsuitable {
            device: info.name.clone(),
            missing,
        };
        if !info.missing.is_empty() {
            return Err(unsuitable(info.missing.join(", ")));
        }
        let (queue_family, family) = requirements::graphics_queue(&instance.raw, physical)
            .ok_or_else(|| unsuitable("a graphics queue".into()))?;
        let extras = Extras {
            draws_indirect: requirements::draws_indirect(&instance.raw, physical),
            tells_statistics: executable_statistics::are_told(&instance.raw, physical),
        };
        let raw = create(instance, physical, queue_family, extras)?;
        // SAFETY: family and index are those the device was created with.
        let queue = unsafe { raw.get_device_queue(queue_family, 0) };
        let allocator = match create_allocator(instance, &raw, physical) {
            Ok(allocator) => allocator,
            Err(error) => {
                // SAFETY: nothing was made from the device yet.
                unsafe { raw.destroy_device(None) };
                return Err(error);
            }
        };
        let facts = Facts::read(instance, physical);
        Ok(Arc::new(Self {
            allocator: ManuallyDrop::new(Mutex::new(allocator)),
            debug_utils: instance
                .has_debug_utils()
                .then(|| ash::ext::debug_utils::Device::new(&instance.raw, &raw)),
            executable_properties: extras
                .tells_statistics
                .then(|| pipeline_executable_properties::Device::new(&instance.raw, &raw)),
            raw,
            queue: Mutex::new(queue),
            queue_family,
            limits: facts.limits,
            timestamp_bits: family.timestamp_valid_bits,
            max_buffer_bytes: facts.max_buffer_bytes,
            preserves_nan: facts.preserves_nan,
            draws_indirect: extras.draws_indirect,
            cache_key: facts.cache_key,
            samples: requirements::sample_counts(&instance.raw, physical),
            info,
            pipelines_created: AtomicU64::new(0),
            images_created: AtomicU64::new(0),
            buffers_created: AtomicU64::new(0),
            instance: Arc::clone(instance),
        }))
    }

    /// The device as the user sees it.
    pub fn info(&self) -> &DeviceInfo {
        &self.info
    }

    /// The instance, with the validation log.
    pub fn instance(&self) -> &Instance {
        &self.instance
    }

    /// Checks a target's size against the device.
    ///
    /// # Errors
    /// Zero, or beyond what a framebuffer and an image may have.
    pub fn check_target_size(&self, width: u32, height: u32) -> Result<(), Error> {
        let limits = &self.limits;
        let allowed = [
            ("the width", width, limits.max_framebuffer_width),
            ("the height", height, limits.max_framebuffer_height),
        ];
        for (what, value, limit) in allowed {
            let limit = limit.min(limits.max_image_dimension2_d);
            if value == 0 || value > limit {
                return Err(self.beyond(what.into(), u64::from(value), u64::from(limit)));
            }
        }
        Ok(())
    }

    /// Checks that targets of this sample count exist.
    ///
    /// # Errors
    /// They do not; the message lists those that do.
    pub fn check_samples(&self, samples: Samples) -> Result<(), Error> {
        if self.samples.contains(&samples) {
            return Ok(());
        }
        let counts: Vec<_> = self.samples.iter().map(|s| s.count().to_string()).collect();
        Err(Error::NoSuchSampleCount {
            device: self.info.name.clone(),
            wanted: samples.count(),
            available: counts.join(", "),
        })
    }

    /// The largest storage buffer that a shader may see, bytes.
    pub fn max_storage_bytes(&self) -> u64 {
        u64::from(self.limits.max_storage_buffer_range)
    }

    /// The largest side of a texture, texels; at least 4096.
    pub fn max_texture_size(&self) -> u32 {
        self.limits.max_image_dimension2_d
    }

    /// The most layers of an array of images; at least 256.
    pub fn max_layers(&self) -> u32 {
        self.limits.max_image_array_layers
    }

    /// Checks the side and the layers of an array of square images against the device.
    pub(super) fn check_array(&self, name: &str, size: u32, layers: u32) -> Result<(), Error> {
        let allowed = [
            ("side", size, self.max_texture_size()),
            ("layers", layers, self.max_layers()),
        ];
        for (what, value, limit) in allowed {
            if value == 0 || value > limit {
                let what = format!("the array '{name}' in {what}");
                return Err(self.beyond(what, u64::from(value), u64::from(limit)));
            }
        }
        Ok(())
    }

    /// A window on uniform blocks can stand at multiples of this, bytes: a power of two, at most 256.
    pub fn uniform_alignment(&self) -> u32 {
        let alignment = self.limits.min_uniform_buffer_offset_alignment;
        u32::try_from(alignment).unwrap_or(u32::MAX).max(1)
    }

    /// Whether one command can draw many objects, each of its own instance.
    pub fn draws_indirect(&self) -> bool {
        self.draws_indirect
    }

    /// Memory that its buffers and images take, bytes.
    pub fn memory_in_use(&self) -> u64 {
        self.allocator().generate_report().total_allocated_bytes
    }

    /// Corners are snapped to 2^-bits of a pixel before they are filled; at least 4.
    pub fn subpixel_bits(&self) -> u32 {
        self.limits.sub_pixel_precision_bits
    }

    /// How many pipelines were made on it so far.
    pub fn pipelines_created(&self) -> u64 {
        self.pipelines_created.load(Ordering::Relaxed)
    }

    pub(super) fn count_pipeline(&self) {
        self.pipelines_created.fetch_add(1, Ordering::Relaxed);
    }

    /// How many images were made on it so far: targets, texture arrays and depth arrays.
    pub fn images_created(&self) -> u64 {
        self.images_created.load(Ordering::Relaxed)
    }

    pub(super) fn count_image(&self) {
        self.images_created.fetch_add(1, Ordering::Relaxed);
    }

    /// How many buffers were made on it so far, those for staging and readback included.
    pub fn buffers_created(&self) -> u64 {
        self.buffers_created.load(Ordering::Relaxed)
    }

    pub(super) fn count_buffer(&self) {
        self.buffers_created.fetch_add(1, Ordering::Relaxed);
    }

    pub(super) fn beyond(&self, what: String, value: u64, limit: u64) -> Error {
        Error::BeyondLimit {
            what,
            value,
            limit,
            device: self.info.name.clone(),
        }
    }

    pub(super) fn allocator(&self) -> MutexGuard<'_, Allocator> {
        // The allocator keeps its own invariants; a panic elsewhere does not break them.
        self.allocator
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    /// Memory for a resource of these requirements.
    pub(super) fn allocate(
        &self,
        name: &str,
        requirements: vk::MemoryRequirements,
        location: MemoryLocation,
        linear: bool,
    ) -> Result<Allocation, Error> {
        let description = AllocationCreateDesc {
            name,
            requirements,
            location,
            linear,
            allocation_scheme: AllocationScheme::GpuAllocatorManaged,
        };
        self.allocator()
            .allocate(&description)
            .map_err(|error| Error::Memory {
                what: name.to_owned(),
                bytes: requirements.size,
                reason: error.to_string(),
            })
    }

    /// The memory, if it could be bound; else it is freed.
    pub(super) fn keep_if(
        &self,
        bound: Result<(), vk::Result>,
        allocation: Allocation,
        call: &'static str,
    ) -> Result<Allocation, Error> {
        match bound.named(call) {
            Ok(()) => Ok(allocation),
            Err(error) => {
                // The caller hears of the failed bind; a failed free on top of it adds nothing.
                let _ = self.allocator().free(allocation);
                Err(error)
            }
        }
    }

    /// Names an object for captures and validation messages; nothing where the extension is absent.
    pub(super) fn name<T: vk::Handle>(&self, object: T, name: &str) {
        let (Some(debug_utils), Ok(name)) = (&self.debug_utils, CString::new(name)) else {
            return;
        };
        let info = vk::DebugUtilsObjectNameInfoEXT::default()
            .object_handle(object)
            .object_name(&name);
        // SAFETY: the object belongs to this device. A name that fails to stick harms nothing.
        let _ = unsafe { debug_utils.set_debug_utils_object_name(&info) };
    }

    /// Submits `commands` and waits until the device has done them. `last` is the last pass in them,
    /// for the message if the device is lost.
    pub(super) fn run(
        &self,
        commands: vk::CommandBuffer,
        last: Option<String>,
    ) -> Result<(), Error> {
        let fence = Fence::new(self)?;
        let done = self.submit(commands, &fence).and_then(|()| {
            // SAFETY: the fence is this device's and was just submitted.
            unsafe { self.raw.wait_for_fences(&[fence.raw], true, u64::MAX) }
                .named("vkWaitForFences")
        });
        done.map_err(|error| {
            // Whatever failed, nothing may be destroyed while the device uses it. A device that
            // cannot be waited for is lost, and uses nothing.
            let _queue = self.queue.lock().unwrap_or_else(PoisonError::into_inner);
            // SAFETY: waiting for the device needs its queues for itself; the lock gives the one.
            let _ = unsafe { self.raw.device_wait_idle() };
            error.during(last)
        })
    }

    fn submit(&self, commands: vk::CommandBuffer, fence: &Fence) -> Result<(), Error> {
        let infos = [vk::CommandBufferSubmitInfo::default().command_buffer(commands)];
        let submit = [vk::SubmitInfo2::default().command_buffer_infos(&infos)];
        let queue = self.queue.lock().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: the lock is the queue's external synchronisation; `commands` is recorded and
        // ended, and its owner borrows all that it uses until `run` returns.
        unsafe { self.raw.queue_submit2(*queue, &submit, fence.raw) }.named("vkQueueSubmit2")
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        // SAFETY: every resource held an `Arc` of this device, so none is left, and each waited for
        // its work. The allocator goes before the device, whose memory it frees, and is not used
        // again.
        unsafe {
            ManuallyDrop::drop(&mut self.allocator);
            self.raw.destroy_device(None);
        }
    }
}

/// What is asked of the physical device once.
struct Facts {
    limits: vk::PhysicalDeviceLimits,
    max_buffer_bytes: u64,
    preserves_nan: bool,
    cache_key: CacheKey,
}

impl Facts {
    fn read(instance: &Instance, physical: vk::PhysicalDevice) -> Self {
        let mut controls = vk::PhysicalDeviceFloatControlsProperties::default();
        let mut maintenance_3 = vk::PhysicalDeviceMaintenance3Properties::default();
        let mut maintenance_4 = vk::PhysicalDeviceMaintenance4Properties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default()
            .push_next(&mut controls)
            .push_next(&mut maintenance_3)
            .push_next(&mut maintenance_4);
        // SAFETY: `physical` is this instance's; the chain lives until the call returns.
        unsafe {
            instance
                .raw
                .get_physical_device_properties2(physical, &mut properties);
        }
        let core = properties.properties;
        Self {
            limits: core.limits,
            max_buffer_bytes: maintenance_4
                .max_buffer_size
                .min(maintenance_3.max_memory_allocation_size),
            preserves_nan: controls.shader_signed_zero_inf_nan_preserve_float32 == vk::TRUE,
            cache_key: CacheKey {
                vendor: core.vendor_id,
                device: core.device_id,
                uuid: core.pipeline_cache_uuid,
            },
        }
    }
}

/// What no frame needs, where the device has it.
#[derive(Clone, Copy)]
struct Extras {
    draws_indirect: bool,
    tells_statistics: bool,
}

fn create(
    instance: &Instance,
    physical: vk::PhysicalDevice,
    queue_family: u32,
    extras: Extras,
) -> Result<ash::Device, Error> {
    let priorities = [1.0];
    let queues = [vk::DeviceQueueCreateInfo::default()
        .queue_family_index(queue_family)
        .queue_priorities(&priorities)];
    // Robust access makes every fetch through an index defined, whatever the index: without it, a
    // safe function could not take one.
    let core = vk::PhysicalDeviceFeatures::default()
        .robust_buffer_access(true)
        .full_draw_index_uint32(true)
        .multi_draw_indirect(extras.draws_indirect)
        .draw_indirect_first_instance(extras.draws_indirect);
    let mut core_13 = vk::PhysicalDeviceVulkan13Features::default()
        .dynamic_rendering(true)
        .synchronization2(true)
        .shader_demote_to_helper_invocation(true);
    let mut statistics = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default()
        .pipeline_executable_info(true);
    let extensions = [pipeline_executable_properties::NAME.as_ptr()];
    let mut info = vk::DeviceCreateInfo::default()
        .queue_create_infos(&queues)
        .enabled_features(&core)
        .push_next(&mut core_13);
    if extras.tells_statistics {
        info = info
            .enabled_extension_names(&extensions)
            .push_next(&mut statistics);
    }
    // SAFETY: `physical` is this instance's; every pointer in `info` lives until the call returns;
    // `requirements` found the features present.
    unsafe { instance.raw.create_device(physical, &info, None) }.named("vkCreateDevice")
}

fn create_allocator(
    instance: &Instance,
    device: &ash::Device,
    physical: vk::PhysicalDevice,
) -> Result<Allocator, Error> {
    Allocator::new(&AllocatorCreateDesc {
        instance: instance.raw.clone(),
        device: device.clone(),
        physical_device: physical,
        debug_settings: gpu_allocator::AllocatorDebugSettings::default(),
        buffer_device_address: false,
        allocation_sizes: gpu_allocator::AllocationSizes::default(),
    })
    .map_err(|error| Error::Memory {
        what: "the allocator".into(),
        bytes: 0,
        reason: error.to_string(),
    })
}

/// A fence that is destroyed on every path.
struct Fence<'a> {
    device: &'a Device,
    raw: vk::Fence,
}

impl<'a> Fence<'a> {
    fn new(device: &'a Device) -> Result<Self, Error> {
        // SAFETY: the device is alive.
        let raw = unsafe {
            device
                .raw
                .create_fence(&vk::FenceCreateInfo::default(), None)
        }
        .named("vkCreateFence")?;
        Ok(Self { device, raw })
    }
}

impl Drop for Fence<'_> {
    fn drop(&mut self) {
        // SAFETY: the submission was waited for, or failed, or the device is lost.
        unsafe { self.device.raw.destroy_fence(self.raw, None) };
    }
}
