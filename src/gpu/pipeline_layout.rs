//! Which sets and which constants does a pipeline find beside its own code?

use std::sync::Arc;

use ash::vk;

use super::descriptors::SetLayout;
use super::device::Device;
use super::error::{Error, Named};

/// Sets that a pipeline may see on every device (Vulkan 1.3, "Required Limits").
pub(super) const MOST_SETS: usize = 4;

/// The bytes of push constants that every device has (same table).
const MOST_PUSH_BYTES: u32 = 128;

/// The stages of a picture that see push constants.
const DRAWING: vk::ShaderStageFlags = vk::ShaderStageFlags::from_raw(
    vk::ShaderStageFlags::VERTEX.as_raw() | vk::ShaderStageFlags::FRAGMENT.as_raw(),
);

/// The sets of a pipeline, and the bytes pushed to it.
pub struct PipelineLayout {
    pub(super) raw: vk::PipelineLayout,
    pub(super) sets: Vec<Arc<SetLayout>>,
    pub(super) push_bytes: u32,
    pub(super) push_stages: vk::ShaderStageFlags,
    device: Arc<Device>,
}

impl PipelineLayout {
    /// A layout with set `i` as `sets[i]`, and `push_bytes` of push constants.
    ///
    /// # Panics
    /// There is no set, there are more than every device has, or they are another device's; the
    /// push constants are no multiple of 4 or more than every device has.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(
        device: &Arc<Device>,
        name: &str,
        sets: &[&Arc<SetLayout>],
        push_bytes: u32,
    ) -> Result<Arc<Self>, Error> {
        Self::of_stages(device, name, sets, push_bytes, DRAWING)
    }

    /// The same for compute pipelines, which find one set.
    ///
    /// # Panics
    /// As `new`.
    ///
    /// # Errors
    /// The driver fails.
    pub fn for_compute(
        device: &Arc<Device>,
        name: &str,
        set: &Arc<SetLayout>,
        push_bytes: u32,
    ) -> Result<Arc<Self>, Error> {
        let stage = vk::ShaderStageFlags::COMPUTE;
        Self::of_stages(device, name, &[set], push_bytes, stage)
    }

    fn of_stages(
        device: &Arc<Device>,
        name: &str,
        sets: &[&Arc<SetLayout>],
        push_bytes: u32,
        push_stages: vk::ShaderStageFlags,
    ) -> Result<Arc<Self>, Error> {
        assert!((1..=MOST_SETS).contains(&sets.len()), "{name}: sets");
        assert!(sets.iter().all(|set| set.is_of(device)), "{name}: device");
        assert!(
            push_bytes.is_multiple_of(4) && push_bytes <= MOST_PUSH_BYTES,
            "{name}: push constants"
        );
        let raw_sets: Vec<_> = sets.iter().map(|set| set.raw).collect();
        let range = vk::PushConstantRange::default()
            .stage_flags(push_stages)
            .size(push_bytes);
        let ranges = Vec::from_iter((push_bytes > 0).then_some(range));
        let info = vk::PipelineLayoutCreateInfo::default()
            .set_layouts(&raw_sets)
            .push_constant_ranges(&ranges);
        // SAFETY: `info` points at locals, alive until the call returns; counts and sizes were checked.
        let raw = unsafe { device.raw.create_pipeline_layout(&info, None) }
            .named("vkCreatePipelineLayout")?;
        device.name(raw, name);
        Ok(Arc::new(Self {
            raw,
            sets: sets.iter().copied().cloned().collect(),
            push_bytes,
            push_stages,
            device: Arc::clone(device),
        }))
    }

    pub(super) fn is_of(&self, device: &Arc<Device>) -> bool {
        Arc::ptr_eq(&self.device, device)
    }
}

impl Drop for PipelineLayout {
    fn drop(&mut self) {
        // SAFETY: pipelines hold an `Arc` of their layout, so none is left; recorders borrow pipelines
        // until the device is done with them.
        unsafe { self.device.raw.destroy_pipeline_layout(self.raw, None) };
    }
}
