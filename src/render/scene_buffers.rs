//! How do a scene's records come to the device, and what is in the one set?

use std::sync::Arc;

use super::effects::Effects;
use super::maps::Maps;
use super::renderer::Renderer;
use super::shadow_maps::ShadowMaps;
use super::uploaded::Uploaded;
use super::{camera, records};
use crate::gpu::{
    Binding, BindingKind, Buffer, BufferUse, DepthArray, DescriptorSet, Error, Resource,
};
use crate::interface::reflected::bindings;
use crate::interface::{Frame, Material};
use crate::reference::ladders::Mix;
use crate::scene::{self, Scene};

/// The one set: everything that a material, an object, a light or a frame is, is data here.
pub const BINDINGS: [Binding; 20] = [
    of(bindings::FrameBlock, BindingKind::Uniform),
    of(bindings::InstanceBlock, BindingKind::Storage),
    of(bindings::MaterialBlock, BindingKind::Storage),
    of(bindings::LightBlock, BindingKind::Storage),
    of(bindings::ShadowBlock, BindingKind::Storage),
    of(bindings::shadow_depths, BindingKind::Texture),
    of(bindings::shadow_sampler, BindingKind::Sampler),
    of(bindings::map_sampler, BindingKind::Sampler),
    of(bindings::base_color_maps_small, BindingKind::Texture),
    of(bindings::base_color_maps_medium, BindingKind::Texture),
    of(bindings::base_color_maps_large, BindingKind::Texture),
    of(bindings::number_maps_small, BindingKind::Texture),
    of(bindings::number_maps_medium, BindingKind::Texture),
    of(bindings::number_maps_large, BindingKind::Texture),
    of(bindings::normal_maps_small, BindingKind::Texture),
    of(bindings::normal_maps_medium, BindingKind::Texture),
    of(bindings::normal_maps_large, BindingKind::Texture),
    of(bindings::emission_maps_small, BindingKind::Texture),
    of(bindings::emission_maps_medium, BindingKind::Texture),
    of(bindings::emission_maps_large, BindingKind::Texture),
];

const fn of(slot: u32, kind: BindingKind) -> Binding {
    Binding { slot, kind }
}

/// The records that shaders read.
pub struct SceneBuffers {
    /// `Frame`, `Instance[]`, `Material[]`, `Light[]`, `ShadowMap[]`: the first of `BINDINGS`.
    records: [Arc<Buffer>; 5],
}

/// What materials and lights are recorded for.
#[derive(Clone, Copy)]
pub struct Look {
    /// The frame's effects.
    pub effects: Effects,
    /// Its tiers.
    pub mix: Mix,
}

impl Look {
    /// A material's record.
    pub fn record(&self, material: &scene::Material, maps: &Maps) -> Material {
        let bits = self.effects.material_bits(material);
        records::material(material, bits, self.mix.fresnel, maps)
    }
}

impl SceneBuffers {
    /// Uploads the records of a scene as seen through its camera in a picture of this aspect.
    ///
    /// # Errors
    /// More objects than the device's storage range holds, or no memory.
    pub fn new(
        renderer: &Renderer,
        uploaded: &Uploaded,
        aspect: f32,
        look: &Look,
        shadows: &ShadowMaps,
    ) -> Result<Self, Error> {
        let device = &renderer.device;
        let Uploaded { scene, maps, .. } = uploaded;
        let instances: Vec<_> = scene
            .objects
            .iter()
            .map(|object| records::instance(&object.transform, index(object.material)))
            .collect();
        let materials: Vec<_> = scene
            .materials
            .iter()
            .map(|material| look.record(material, maps))
            .collect();
        let lights: Vec<_> = scene
            .lights
            .iter()
            .zip(&shadows.of_light)
            .map(|(light, maps)| records::light(light, look.effects.light_bits(light), *maps))
            .collect();
        let storage = |name, bytes: &[u8]| {
            Buffer::with_data(device, name, BufferUse::Storage, bytes).map(Arc::new)
        };
        let frame = frame(scene, aspect);
        let frame = bytemuck::bytes_of(&frame);
        Ok(Self {
            records: [
                Buffer::with_data(device, "frame", BufferUse::Uniform, frame).map(Arc::new)?,
                storage("instances", bytemuck::cast_slice(&instances))?,
                storage("materials", bytemuck::cast_slice(&materials))?,
                storage("lights", bytemuck::cast_slice(&lights))?,
                storage("shadow maps", bytemuck::cast_slice(&shadows.maps))?,
            ],
        })
    }

    /// The one set: the records, and maps, or what stands in for maps that nobody calls for.
    ///
    /// # Errors
    /// The driver fails.
    pub fn set(
        &self,
        renderer: &Renderer,
        depths: Option<&Arc<DepthArray>>,
        maps: &Maps,
    ) -> Result<DescriptorSet, Error> {
        let placeholders = &renderer.placeholders;
        let mut resources: Vec<_> = self.records.iter().cloned().map(Resource::Buffer).collect();
        resources.push(match depths {
            Some(depths) => Resource::Depth(Arc::clone(depths)),
            None => placeholders.texture(),
        });
        resources.push(placeholders.shadow_sampler());
        resources.push(placeholders.map_sampler());
        resources.extend(maps.arrays().map(|array| match array {
            Some(array) => Resource::Texture(Arc::clone(array)),
            None => placeholders.texture(),
        }));
        DescriptorSet::new(&renderer.layout, "the set", &resources)
    }
}

fn frame(scene: &Scene, aspect: f32) -> Frame {
    let view_projection = camera::view_projection(&scene.camera, aspect, &scene.bounds());
    Frame {
        view_projection: view_projection.to_cols_array_2d(),
        eye: camera::eye(&scene.camera).to_array(),
        sky: scene.ambient.sky,
        light_count: index(scene.lights.len()),
        ground: scene.ambient.ground,
        object_count: index(scene.objects.len()),
    }
}

/// The loaders bound every count far below this.
fn index(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}
