//! What is the one descriptor set, and what does it hold?
//!
//! One layout, one set, bound once a pass: whatever differs between materials is data behind it.

use std::sync::Arc;

use ash::vk;

use super::buffer::{Buffer, BufferUse};
use super::depth_array::DepthArray;
use super::device::Device;
use super::error::{Error, Named};
use super::sampler::Sampler;
use super::texture_array::TextureArray;

/// What the shaders find at a binding.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum BindingKind {
    /// A uniform block.
    Uniform,
    /// A read-only storage block.
    Storage,
    /// A `texture2DArray`, of textures or of depth; seen by the fragment stage alone.
    Texture,
    /// A `sampler`; seen by the fragment stage alone.
    Sampler,
}

impl BindingKind {
    fn vulkan(self) -> vk::DescriptorType {
        match self {
            Self::Uniform => vk::DescriptorType::UNIFORM_BUFFER,
            Self::Storage => vk::DescriptorType::STORAGE_BUFFER,
            Self::Texture => vk::DescriptorType::SAMPLED_IMAGE,
            Self::Sampler => vk::DescriptorType::SAMPLER,
        }
    }

    fn stages(self) -> vk::ShaderStageFlags {
        match self {
            Self::Uniform | Self::Storage => {
                vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT
            }
            // The barriers of `ImageUse::ShaderRead` wait for no other stage.
            Self::Texture | Self::Sampler => vk::ShaderStageFlags::FRAGMENT,
        }
    }
}

/// How many of a kind one stage may see on every device (Vulkan 1.3, "Required Limits").
fn of_a_kind(kind: BindingKind) -> usize {
    match kind {
        BindingKind::Uniform => 12,
        BindingKind::Storage => 4,
        BindingKind::Texture | BindingKind::Sampler => 16,
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
    /// The layout of `bindings`.
    ///
    /// # Panics
    /// Two bindings have one slot, or there are more of a kind than every device has.
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
            let alike = before.iter().filter(|other| other.kind == binding.kind);
            assert!(alike.count() < of_a_kind(binding.kind), "{name}: too many");
        }
        let entries: Vec<_> = bindings
            .iter()
            .map(|binding| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding.slot)
                    .descriptor_type(binding.kind.vulkan())
                    .descriptor_count(1)
                    .stage_flags(binding.kind.stages())
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

/// What a binding points at.
#[derive(Clone)]
pub enum Resource {
    /// A uniform or storage block.
    Buffer(Arc<Buffer>),
    /// Textures, at a `Texture` binding.
    Texture(Arc<TextureArray>),
    /// Depth, at a `Texture` binding; the passes that draw with the set name it in their `reads`.
    Depth(Arc<DepthArray>),
    /// A sampler.
    Sampler(Arc<Sampler>),
}

impl Resource {
    fn fits(&self, kind: BindingKind) -> bool {
        match self {
            Self::Buffer(buffer) => matches!(
                (buffer.usage(), kind),
                (BufferUse::Uniform, BindingKind::Uniform)
                    | (BufferUse::Storage, BindingKind::Storage)
            ),
            Self::Texture(_) | Self::Depth(_) => kind == BindingKind::Texture,
            Self::Sampler(_) => kind == BindingKind::Sampler,
        }
    }

    fn is_of(&self, device: &Arc<Device>) -> bool {
        match self {
            Self::Buffer(buffer) => buffer.is_of(device),
            Self::Texture(array) => array.is_of(device),
            Self::Depth(array) => array.is_of(device),
            Self::Sampler(sampler) => sampler.is_of(device),
        }
    }

    /// Both halves of a write; Vulkan reads the one that the binding's type asks for.
    fn infos(&self) -> ([vk::DescriptorBufferInfo; 1], [vk::DescriptorImageInfo; 1]) {
        let buffer = vk::DescriptorBufferInfo::default().range(vk::WHOLE_SIZE);
        let image = vk::DescriptorImageInfo::default();
        let sampled = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        match self {
            Self::Buffer(held) => ([buffer.buffer(held.raw)], [image]),
            Self::Texture(array) => {
                let image = image.image_view(array.view).image_layout(sampled);
                ([buffer], [image])
            }
            Self::Depth(array) => {
                let image = image.image_view(array.view).image_layout(sampled);
                ([buffer], [image])
            }
            Self::Sampler(sampler) => ([buffer], [image.sampler(sampler.raw)]),
        }
    }
}

/// The set, with what it points at. Dropped: pool and set, then what it points at, then layout.
pub struct DescriptorSet {
    pub(super) raw: vk::DescriptorSet,
    pool: vk::DescriptorPool,
    resources: Vec<Resource>,
    pub(super) layout: Arc<SetLayout>,
}

impl DescriptorSet {
    /// A set in which binding `i` of the layout is `resources[i]`.
    ///
    /// # Panics
    /// A resource is missing, or of another kind or device than its binding.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(layout: &Arc<SetLayout>, name: &str, resources: &[Resource]) -> Result<Self, Error> {
        assert_eq!(
            resources.len(),
            layout.bindings.len(),
            "{name}: one resource a binding"
        );
        for (resource, binding) in resources.iter().zip(&layout.bindings) {
            let fits = resource.fits(binding.kind) && resource.is_of(&layout.device);
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
            resources: resources.to_vec(),
            layout: Arc::clone(layout),
        };
        device.name(set.raw, name);
        set.point_at();
        Ok(set)
    }

    /// The depth that a pass with this set may sample.
    pub(super) fn depth_arrays(&self) -> impl Iterator<Item = &Arc<DepthArray>> {
        self.resources.iter().filter_map(|resource| match resource {
            Resource::Depth(array) => Some(array),
            _ => None,
        })
    }

    fn point_at(&self) {
        let infos: Vec<_> = self.resources.iter().map(Resource::infos).collect();
        let writes: Vec<_> = self
            .layout
            .bindings
            .iter()
            .zip(&infos)
            .map(|(binding, (buffer, image))| {
                vk::WriteDescriptorSet::default()
                    .dst_set(self.raw)
                    .dst_binding(binding.slot)
                    .descriptor_type(binding.kind.vulkan())
                    .buffer_info(buffer)
                    .image_info(image)
            })
            .collect();
        // SAFETY: the set is new, so no work uses it; it holds what it points at.
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
