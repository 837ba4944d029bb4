//! What does a descriptor set hold, and what may a shader find at each binding?
//!
//! The renderer has one set, bound once a pass: whatever differs between materials is data behind it. The
//! benchmark has more, to say what they cost.

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
    /// A uniform block; all stages may see it.
    Uniform,
    /// A window on a buffer of uniform blocks, which is moved when the set is bound. At most one in a set.
    UniformWindow,
    /// A read-only storage block.
    Storage,
    /// A storage block that is written; seen by the compute stage alone.
    Written,
    /// A `texture2DArray`, of textures or of depth; seen by the fragment stage alone.
    Texture,
    /// A `sampler`; seen by the fragment stage alone.
    Sampler,
}

impl BindingKind {
    fn vulkan(self) -> vk::DescriptorType {
        match self {
            Self::Uniform => vk::DescriptorType::UNIFORM_BUFFER,
            Self::UniformWindow => vk::DescriptorType::UNIFORM_BUFFER_DYNAMIC,
            Self::Storage | Self::Written => vk::DescriptorType::STORAGE_BUFFER,
            Self::Texture => vk::DescriptorType::SAMPLED_IMAGE,
            Self::Sampler => vk::DescriptorType::SAMPLER,
        }
    }

    fn stages(self) -> vk::ShaderStageFlags {
        match self {
            Self::Uniform => {
                vk::ShaderStageFlags::VERTEX
                    | vk::ShaderStageFlags::FRAGMENT
                    | vk::ShaderStageFlags::COMPUTE
            }
            Self::UniformWindow | Self::Storage => {
                vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT
            }
            Self::Written => vk::ShaderStageFlags::COMPUTE,
            // The barriers of `ImageUse::ShaderRead` wait for no other stage.
            Self::Texture | Self::Sampler => vk::ShaderStageFlags::FRAGMENT,
        }
    }
}

/// How many of a kind one stage may see on every device (Vulkan 1.3, "Required Limits"); of windows one, so
/// that binding a set takes one offset.
fn of_a_kind(kind: BindingKind) -> usize {
    match kind {
        BindingKind::Uniform => 12,
        BindingKind::UniformWindow => 1,
        BindingKind::Storage | BindingKind::Written => 4,
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

/// The layout of a set.
pub struct SetLayout {
    pub(super) raw: vk::DescriptorSetLayout,
    bindings: Vec<Binding>,
    device: Arc<Device>,
}

impl SetLayout {
    pub(super) fn is_of(&self, device: &Arc<Device>) -> bool {
        Arc::ptr_eq(&self.device, device)
    }

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
        device.name(raw, name);
        Ok(Arc::new(Self {
            raw,
            bindings: bindings.to_vec(),
            device: Arc::clone(device),
        }))
    }

    /// Asserts that binding `i` can be `resources[i]`.
    fn check(&self, name: &str, resources: &[Resource]) {
        let bindings = &self.bindings;
        assert_eq!(
            resources.len(),
            bindings.len(),
            "{name}: one resource a binding"
        );
        for (resource, binding) in resources.iter().zip(bindings) {
            let fits = resource.fits(binding.kind) && resource.is_of(&self.device);
            assert!(fits, "{name}: binding {}", binding.slot);
        }
    }
}

impl Drop for SetLayout {
    fn drop(&mut self) {
        // SAFETY: sets and pipeline layouts hold an `Arc` of it, so none is left.
        unsafe {
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
    /// So many bytes of a buffer of uniform blocks, at a `UniformWindow` binding.
    Window(Arc<Buffer>, u32),
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
                    | (BufferUse::Written, BindingKind::Written)
            ),
            Self::Window(buffer, bytes) => {
                kind == BindingKind::UniformWindow
                    && buffer.usage() == BufferUse::UniformWindows
                    && buffer.fits_window(0, *bytes)
            }
            Self::Texture(_) | Self::Depth(_) => kind == BindingKind::Texture,
            Self::Sampler(_) => kind == BindingKind::Sampler,
        }
    }

    fn is_of(&self, device: &Arc<Device>) -> bool {
        match self {
            Self::Buffer(buffer) | Self::Window(buffer, _) => buffer.is_of(device),
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
            Self::Window(held, bytes) => {
                let buffer = buffer.buffer(held.raw).range(u64::from(*bytes));
                ([buffer], [image])
            }
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

/// The set, with what it points at. Dropped: what it points at, its layout, and the pool with the last of its sets.
pub struct DescriptorSet {
    pub(super) raw: vk::DescriptorSet,
    resources: Vec<Resource>,
    pub(super) layout: Arc<SetLayout>,
    _pool: Arc<Pool>,
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
        let mut sets = Self::several(layout, name, &[resources.to_vec()])?;
        Ok(sets.swap_remove(0))
    }

    /// A set for each of `contents`, out of one pool; at least one.
    ///
    /// # Panics
    /// As `new`, or there are no contents.
    ///
    /// # Errors
    /// The driver fails.
    pub fn several(
        layout: &Arc<SetLayout>,
        name: &str,
        contents: &[Vec<Resource>],
    ) -> Result<Vec<Self>, Error> {
        for resources in contents {
            layout.check(name, resources);
        }
        let pool = Arc::new(Pool::new(layout, contents.len())?);
        let layouts = vec![layout.raw; contents.len()];
        let info = vk::DescriptorSetAllocateInfo::default()
            .descriptor_pool(pool.raw)
            .set_layouts(&layouts);
        // SAFETY: the pool was made for exactly these sets, and nobody else has it.
        let raw = unsafe { layout.device.raw.allocate_descriptor_sets(&info) }
            .named("vkAllocateDescriptorSets")?;
        let sets = raw.into_iter().zip(contents).map(|(raw, resources)| {
            let set = Self {
                raw,
                resources: resources.clone(),
                layout: Arc::clone(layout),
                _pool: Arc::clone(&pool),
            };
            layout.device.name(set.raw, name);
            set.point_at();
            set
        });
        Ok(sets.collect())
    }

    /// Its layout.
    pub fn layout(&self) -> &Arc<SetLayout> {
        &self.layout
    }

    /// What its window looks at, if it has one.
    pub(super) fn window(&self) -> Option<(&Buffer, u32)> {
        self.resources.iter().find_map(|resource| match resource {
            Resource::Window(buffer, bytes) => Some((&**buffer, *bytes)),
            _ => None,
        })
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

/// Where sets of one layout come from.
struct Pool {
    raw: vk::DescriptorPool,
    device: Arc<Device>,
}

impl Pool {
    /// A pool for `count` sets.
    fn new(layout: &SetLayout, count: usize) -> Result<Self, Error> {
        let count = u32::try_from(count).unwrap_or(u32::MAX);
        assert!(count > 0, "a pool of no sets");
        let sizes: Vec<_> = layout
            .bindings
            .iter()
            .map(|binding| {
                vk::DescriptorPoolSize::default()
                    .ty(binding.kind.vulkan())
                    .descriptor_count(count)
            })
            .collect();
        let info = vk::DescriptorPoolCreateInfo::default()
            .max_sets(count)
            .pool_sizes(&sizes);
        // SAFETY: `info` points at `sizes`, alive until the call returns.
        let raw = unsafe { layout.device.raw.create_descriptor_pool(&info, None) }
            .named("vkCreateDescriptorPool")?;
        Ok(Self {
            raw,
            device: Arc::clone(&layout.device),
        })
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        // SAFETY: its sets hold an `Arc` of it, so none is left that a recorder could borrow.
        unsafe { self.device.raw.destroy_descriptor_pool(self.raw, None) };
    }
}
