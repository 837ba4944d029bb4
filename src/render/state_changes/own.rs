//! What of a material is bound for its draws alone?

use std::sync::Arc;

use super::super::maps;
use super::mode::{Mode, Source};
use super::stage::Stage;
use crate::gpu::{
    Binding, BindingKind, Buffer, BufferUse, DescriptorSet, Device, Error, Pass, PipelineLayout,
    Resource, SetLayout, TextureArray,
};
use crate::interface::Material;
use crate::interface::reflected::bindings;

/// The place of the set that a draw has of its own; the one set is at 0.
const PLACE: u32 = 1;

/// What is bound, by the material's number.
pub(super) enum Own {
    /// Nothing.
    Nothing,
    /// Its number.
    Number,
    /// A set for each.
    Sets(Vec<DescriptorSet>),
    /// One set, whose window stands at multiples of a stride.
    Window { set: DescriptorSet, stride: u32 },
}

impl Own {
    /// Makes the sets that a mode needs.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn new(stage: &Stage, mode: &Mode) -> Result<Self, Error> {
        let device = &stage.renderer.device;
        let materials = &stage.records(mode.source.has_pictures()).materials;
        match mode.source {
            Source::Record | Source::RecordOfAnyScene | Source::RecordWithArray | Source::Baked => {
                Ok(Self::Nothing)
            }
            Source::Pushed => Ok(Self::Number),
            Source::OwnSet | Source::BakedWithOwnSet => blocks(device, materials).map(Self::Sets),
            Source::RecordWithOwnImage => images(stage).map(Self::Sets),
            Source::Window => window(device, materials),
        }
    }

    /// How many there are to choose from; `None` where nothing is chosen.
    pub fn count(&self) -> Option<u32> {
        match self {
            Self::Sets(sets) => u32::try_from(sets.len()).ok(),
            _ => None,
        }
    }

    /// Sets and push constants that are bound before the first draw.
    pub fn first_binds(&self) -> [u64; 2] {
        match self {
            Self::Nothing => [0, 0],
            Self::Number => [0, 1],
            Self::Sets(_) | Self::Window { .. } => [1, 0],
        }
    }

    /// Binds what draws of this key need.
    pub fn bind<'a>(&'a self, pass: &mut Pass<'_, 'a>, key: u32) {
        match self {
            Self::Nothing => {}
            Self::Number => pass.push_constants(&key.to_ne_bytes()),
            Self::Sets(sets) => pass.bind_set(PLACE, &sets[key as usize]),
            Self::Window { set, stride } => pass.bind_set_at(PLACE, set, key * stride),
        }
    }

    /// The layout of pipelines that see this beside the one set.
    ///
    /// # Errors
    /// The driver fails.
    pub fn pipeline_layout(&self, stage: &Stage) -> Result<Arc<PipelineLayout>, Error> {
        let device = &stage.renderer.device;
        let first = &stage.renderer.layout;
        let second = match self {
            Self::Nothing => return PipelineLayout::new(device, "one set", &[first], 0),
            Self::Number => {
                let bytes = size_of::<u32>() as u32;
                return PipelineLayout::new(device, "one set and a number", &[first], bytes);
            }
            Self::Sets(sets) => sets[0].layout(),
            Self::Window { set, .. } => set.layout(),
        };
        PipelineLayout::new(device, "two sets", &[first, second], 0)
    }
}

fn layout(device: &Arc<Device>, slot: u32, kind: BindingKind) -> Result<Arc<SetLayout>, Error> {
    SetLayout::new(device, "a set of its own", &[Binding { slot, kind }])
}

/// A uniform block and a set for each material.
fn blocks(device: &Arc<Device>, materials: &[Material]) -> Result<Vec<DescriptorSet>, Error> {
    let block = |material: &Material| {
        let bytes = bytemuck::bytes_of(material);
        let buffer = Buffer::with_data(device, "a material", BufferUse::Uniform, bytes)?;
        Ok(vec![Resource::Buffer(Arc::new(buffer))])
    };
    let contents: Vec<_> = materials.iter().map(block).collect::<Result<_, Error>>()?;
    let layout = layout(device, bindings::OwnMaterialBlock, BindingKind::Uniform)?;
    DescriptorSet::several(&layout, "a material's set", &contents)
}

/// All materials in one buffer, and one set that looks at one of them.
fn window(device: &Arc<Device>, materials: &[Material]) -> Result<Own, Error> {
    let bytes = size_of::<Material>() as u32;
    let stride = bytes.next_multiple_of(device.uniform_alignment());
    let mut data = vec![0; materials.len() * stride as usize];
    for (place, material) in data.chunks_exact_mut(stride as usize).zip(materials) {
        place[..bytes as usize].copy_from_slice(bytemuck::bytes_of(material));
    }
    let buffer = Buffer::with_data(device, "materials", BufferUse::UniformWindows, &data)?;
    let layout = layout(
        device,
        bindings::OwnMaterialBlock,
        BindingKind::UniformWindow,
    )?;
    let resources = [Resource::Window(Arc::new(buffer), bytes)];
    let set = DescriptorSet::new(&layout, "materials", &resources)?;
    Ok(Own::Window { set, stride })
}

/// An image and a set for each picture.
fn images(stage: &Stage) -> Result<Vec<DescriptorSet>, Error> {
    let device = &stage.renderer.device;
    let image = |texture| {
        let array: Arc<TextureArray> = maps::alone(device, texture)?;
        Ok(vec![Resource::Texture(array)])
    };
    let textures = stage.uploaded.scene.textures.iter();
    let contents: Vec<_> = textures.map(image).collect::<Result<_, Error>>()?;
    let layout = layout(device, bindings::own_picture, BindingKind::Texture)?;
    DescriptorSet::several(&layout, "a picture's set", &contents)
}
