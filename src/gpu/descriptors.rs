//! What is the one descriptor set, and what does it hold?
//!
//! One layout, one set, bound once a pass: whatever differs between materials is data behind it.

use std::sync::Arc;

use ash::vk;

use super::buffer::{Buffer, BufferUse};
use super::device::Device;
use super::error::{Error, Named};

/// What the shaders find at a binding.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum BindingKind {
    /// A uniform block.
    Uniform,
    /// A read-only storage block.
    Storage,
}

impl BindingKind {
    fn vulkan(self) -> vk::DescriptorType {
        match self {
            Self::Uniform => vk::DescriptorType::UNIFORM_BUFFER,
            Self::Storage => vk::DescriptorType::STORAGE_BUFFER,
        }
    }

    fn buffer_use(self) -> BufferUse {
        match self {
            Self::Uniform => BufferUse::Uniform,
            Self::Storage => BufferUse::Storage,
        }
    }
}

/// One binding of the set.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Binding {
    /// The shaders' binding number; no two of a set are alike.
    pub slot: u32,
    /// What is there.
    pub kind: BindingKind,
}

/// The layout of the set and of the pipelines that use it.
pub struct SetLayout {
    pub(super) raw: vk::DescriptorSetLayout,
    pub(super) pipeline_layout: vk::PipelineLayout,
    bindings: Vec<Binding>,
    device: Arc<Device>,
}

impl SetLayout {
    pub(super) fn is_of(&self, device: &Arc<Device>) -> bool {
        Arc::ptr_eq(&self.device, device)
    }
}

impl SetLayout {
    /// The layout of `bindings`, seen by the vertex and fragment stages.
    ///
    /// # Panics
    /// Two bindings have one slot.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(device: &Arc<Device>, name: &str, bindings: &[Binding]) -> Result<Arc<Self>, Error> {
        for (i, binding) in bindings.iter().enumerate() {
            let before = &bindings[..i];
            assert!(
                before.iter().all(|other| other.slot != binding.slot),
                "{name}: slots"
            );
        }
        let entries: Vec<_> = bindings
            .iter()
            .map(|binding| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding.slot)
                    .descriptor_type(binding.kind.vulkan())
                    .descriptor_count(1)
                    .stage_flags(vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT)
            })
            .collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&entries);
        // SAFETY: `info` points at `entries`, alive until the call returns.
        let raw = unsafe { device.raw.create_descriptor_set_layout(&info, None) }
            .named("vkCreateDescriptorSetLayout")?;
        let layouts = [raw];
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts);
        // SAFETY: as above.
        let pipeline_layout = unsafe { device.raw.create_pipeline_layout(&info, None) }
            .named("vkCreatePipelineLayout")
            .inspect_err(|_| {
                // SAFETY: nothing uses the layout yet.
                unsafe { device.raw.destroy_descriptor_set_layout(raw, None) };
            })?;
        device.name(raw, name);
        device.name(pipeline_layout, name);
        Ok(Arc::new(Self {
            raw,
            pipeline_layout,
            bindings: bindings.to_vec(),
            device: Arc::clone(device),
        }))
    }
}

impl Drop for SetLayout {
    fn drop(&mut self) {
        // SAFETY: sets and pipelines hold an `Arc` of their layout, so none is left.
        unsafe {
            self.device
                .raw
                .destroy_pipeline_layout(self.pipeline_layout, None);
            self.device
                .raw
                .destroy_descriptor_set_layout(self.raw, None);
        }
    }
}

/// The set, with the buffers that it points at. Dropped: pool and set, then buffers, then layout.
pub struct DescriptorSet {
    pub(super) raw: vk::DescriptorSet,
    pool: vk::DescriptorPool,
    // Held, not read: the set points at them.
    _buffers: Vec<Arc<Buffer>>,
    pub(super) layout: Arc<SetLayout>,
}

impl DescriptorSet {
    /// A set in which binding `i` of the layout is `buffers[i]`.
    ///
    /// # Panics
    /// A buffer is missing, or of another use or device than its binding.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(
        layout: &Arc<SetLayout>,
        name: &str,
        buffers: &[Arc<Buffer>],
    ) -> Result<Self, Error> {
        assert_eq!(
            buffers.len(),
            layout.bindings.len(),
            "{name}: one buffer a binding"
        );
        for (buffer, binding) in buffers.iter().zip(&layout.bindings) {
            let fits = buffer.usage() == binding.kind.buffer_use() && buffer.is_of(&layout.device);
            assert!(fits, "{name}: binding {}", binding.slot);
        }
        let device = &layout.device;
        let pool = create_pool(device, &layout.bindings)?;
        let layouts = [layout.raw];
        let info = vk::DescriptorSetAllocateInfo::default()
            .descriptor_pool(pool)
            .set_layouts(&layouts);
        // SAFETY: the pool was made for exactly this set, and nobody else has it.
        let sets = unsafe { device.raw.allocate_descriptor_sets(&info) }
            .named("vkAllocateDescriptorSets")
            .inspect_err(|_| {
                // SAFETY: the pool has no sets.
                unsafe { device.raw.destroy_descriptor_pool(pool, None) };
            })?;
        let set = Self {
            raw: sets[0],
            pool,
            _buffers: buffers.to_vec(),
            layout: Arc::clone(layout),
        };
        device.name(set.raw, name);
        set.point_at(buffers);
        Ok(set)
    }

    fn point_at(&self, buffers: &[Arc<Buffer>]) {
        let infos: Vec<_> = buffers
            .iter()
            .map(|buffer| {
                [vk::DescriptorBufferInfo::default()
                    .buffer(buffer.raw)
                    .range(vk::WHOLE_SIZE)]
            })
            .collect();
        let writes: Vec<_> = self
            .layout
            .bindings
            .iter()
            .zip(&infos)
            .map(|(binding, info)| {
                vk::WriteDescriptorSet::default()
                    .dst_set(self.raw)
                    .dst_binding(binding.slot)
                    .descriptor_type(binding.kind.vulkan())
                    .buffer_info(info)
            })
            .collect();
        // SAFETY: the set is new, so no work uses it; the buffers are held by it from now on.
        unsafe { self.layout.device.raw.update_descriptor_sets(&writes, &[]) };
    }
}

impl Drop for DescriptorSet {
    fn drop(&mut self) {
        // SAFETY: recorders borrow the set until the device is done with it; the pool takes the
        // set with it.
        unsafe {
            self.layout
                .device
                .raw
                .destroy_descriptor_pool(self.pool, None)
        };
    }
}

fn create_pool(device: &Device, bindings: &[Binding]) -> Result<vk::DescriptorPool, Error> {
    let sizes: Vec<_> = bindings
        .iter()
        .map(|binding| {
            vk::DescriptorPoolSize::default()
                .ty(binding.kind.vulkan())
                .descriptor_count(1)
        })
        .collect();
    let info = vk::DescriptorPoolCreateInfo::default()
        .max_sets(1)
        .pool_sizes(&sizes);
    // SAFETY: `info` points at `sizes`, alive until the call returns.
    unsafe { device.raw.create_descriptor_pool(&info, None) }.named("vkCreateDescriptorPool")
}
