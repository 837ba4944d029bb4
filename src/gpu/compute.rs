//! How does a shader compute without drawing?

use std::sync::Arc;

use ash::vk;

use super::barriers;
use super::commands::Recorder;
use super::descriptors::DescriptorSet;
use super::device::Device;
use super::error::{Error, Named};
use super::executable_statistics::{self, Statistic};
use super::pipeline::{Constant, Module, Spirv, stage_info};
use super::pipeline_cache::PipelineCache;
use super::pipeline_layout::PipelineLayout;

/// Work groups that every device takes in one dispatch (Vulkan 1.3, "Required Limits").
pub const MOST_GROUPS: u32 = 65_535;

/// A compute pipeline; it holds the layout that it was made for.
pub struct ComputePipeline {
    raw: vk::Pipeline,
    layout: Arc<PipelineLayout>,
    device: Arc<Device>,
}

impl ComputePipeline {
    /// Makes the pipeline, for a layout of [`PipelineLayout::for_compute`].
    ///
    /// # Panics
    /// The layout or the cache is another device's.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(
        device: &Arc<Device>,
        layout: &Arc<PipelineLayout>,
        cache: &PipelineCache,
        name: &str,
        shader: Spirv,
        constants: &[Constant],
    ) -> Result<Self, Error> {
        assert!(
            layout.is_of(device) && cache.is_of(device),
            "{name}: device"
        );
        let module = Module::new(device, shader, constants, name)?;
        let info = vk::ComputePipelineCreateInfo::default()
            .flags(executable_statistics::flags(device))
            .stage(stage_info(vk::ShaderStageFlags::COMPUTE, &module))
            .layout(layout.raw);
        // SAFETY: every pointer lives until the call returns; the driver synchronises the cache.
        let made = unsafe {
            device
                .raw
                .create_compute_pipelines(cache.raw, &[info], None)
        };
        let raw = match made {
            Ok(pipelines) => pipelines[0],
            Err((_, result)) => return Err(result).named("vkCreateComputePipelines"),
        };
        device.name(raw, name);
        device.count_pipeline();
        Ok(Self {
            raw,
            layout: Arc::clone(layout),
            device: Arc::clone(device),
        })
    }

    /// What the driver tells of its code; nothing where it cannot tell.
    ///
    /// # Errors
    /// The driver fails.
    pub fn statistics(&self) -> Result<Vec<Statistic>, Error> {
        executable_statistics::of(&self.device, self.raw)
    }
}

impl Drop for ComputePipeline {
    fn drop(&mut self) {
        // SAFETY: recorders borrow the pipeline until the device is done with it.
        unsafe { self.device.raw.destroy_pipeline(self.raw, None) };
    }
}

impl<'a> Recorder<'a> {
    /// Runs `groups` work groups of a pipeline with its set and its push constants, after all that was recorded before.
    ///
    /// # Panics
    /// Pipeline, set and push constants are not of one layout or of another device, or there are more groups than every
    /// device takes, or none.
    pub fn dispatch(
        &mut self,
        pipeline: &'a ComputePipeline,
        set: &'a DescriptorSet,
        push: &[u8],
        groups: u32,
    ) {
        let layout = &pipeline.layout;
        assert!(Arc::ptr_eq(&pipeline.device, &self.device), "device");
        let stage = vk::ShaderStageFlags::COMPUTE;
        let fits = layout.push_stages == stage && layout.push_bytes as usize == push.len();
        assert!(fits, "the push constants of the pipeline's layout");
        assert!(Arc::ptr_eq(&layout.sets[0], set.layout()), "its set");
        assert!((1..=MOST_GROUPS).contains(&groups), "{groups} work groups");
        let barriers = [barriers::before_dispatch()];
        self.barrier(&vk::DependencyInfo::default().memory_barriers(&barriers));
        let (device, commands) = (&self.device.raw, self.commands);
        let point = vk::PipelineBindPoint::COMPUTE;
        // SAFETY: all is this device's and fits, as checked above; the recorder borrows it. Fetches and stores beyond a
        // buffer are defined (`Device` turns robustBufferAccess on).
        unsafe {
            device.cmd_bind_pipeline(commands, point, pipeline.raw);
            device.cmd_bind_descriptor_sets(commands, point, layout.raw, 0, &[set.raw], &[]);
            if !push.is_empty() {
                device.cmd_push_constants(commands, layout.raw, stage, 0, push);
            }
            device.cmd_dispatch(commands, groups, 1, 1);
        }
    }
}
