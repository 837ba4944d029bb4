//! How does a scene come to the device?

use std::sync::Arc;

use super::draw_list::DrawList;
use super::{camera, records};
use crate::gpu::{
    Binding, BindingKind, Buffer, BufferUse, DescriptorSet, Device, Error, Resource, SetLayout,
    Upload,
};
use crate::interface::reflected::bindings;
use crate::interface::{Frame, Light};
use crate::scene::Scene;

/// The one set: everything that a material, an object, a light or a frame is, is data here.
pub const BINDINGS: [Binding; 4] = [
    Binding {
        slot: bindings::FrameBlock,
        kind: BindingKind::Uniform,
    },
    Binding {
        slot: bindings::InstanceBlock,
        kind: BindingKind::Storage,
    },
    Binding {
        slot: bindings::MaterialBlock,
        kind: BindingKind::Storage,
    },
    Binding {
        slot: bindings::LightBlock,
        kind: BindingKind::Storage,
    },
];

/// Everything that the shading pass reads.
pub struct SceneBuffers {
    /// `Frame`, `Instance[]`, `Material[]`, `Light[]`: in the order of `BINDINGS`.
    records: [Arc<Buffer>; 4],
    /// Positions of all meshes.
    pub positions: Buffer,
    /// Normals of all meshes.
    pub normals: Buffer,
    /// Indices of all meshes, then those of transparent objects again, sorted.
    pub indices: Buffer,
}

impl SceneBuffers {
    /// Uploads a scene as seen through its camera in a picture of this aspect.
    ///
    /// # Errors
    /// More objects than the device's storage range holds, or no memory.
    pub fn new(
        device: &Arc<Device>,
        scene: &Scene,
        list: &DrawList,
        aspect: f32,
    ) -> Result<Self, Error> {
        let instances: Vec<_> = scene
            .objects
            .iter()
            .map(|object| records::instance(&object.transform, index(object.material)))
            .collect();
        let materials: Vec<_> = scene.materials.iter().map(records::material).collect();
        let lights: Vec<Light> = scene.lights.iter().map(records::light).collect();
        let frame = frame(scene, aspect);
        let storage = |name, bytes: &[u8]| {
            Buffer::with_data(device, name, BufferUse::Storage, bytes).map(Arc::new)
        };
        let vertices = |name, of: fn(&crate::scene::Mesh) -> &[[f32; 3]]| {
            let pieces = scene
                .meshes
                .iter()
                .map(|mesh| bytemuck::cast_slice(of(mesh)));
            joined(device, name, BufferUse::Vertices, pieces)
        };
        let sorted = bytemuck::cast_slice(&list.sorted_indices);
        let indices = scene
            .meshes
            .iter()
            .map(|mesh| bytemuck::cast_slice(&mesh.indices))
            .chain([sorted]);
        let frame = bytemuck::bytes_of(&frame);
        Ok(Self {
            records: [
                Buffer::with_data(device, "frame", BufferUse::Uniform, frame).map(Arc::new)?,
                storage("instances", bytemuck::cast_slice(&instances))?,
                storage("materials", bytemuck::cast_slice(&materials))?,
                storage("lights", bytemuck::cast_slice(&lights))?,
            ],
            positions: vertices("positions", |mesh| &mesh.positions)?,
            normals: vertices("normals", |mesh| &mesh.normals)?,
            indices: joined(device, "indices", BufferUse::Indices, indices)?,
        })
    }

    /// The set that points at the records.
    ///
    /// # Errors
    /// The driver fails.
    pub fn set(&self, layout: &Arc<SetLayout>) -> Result<DescriptorSet, Error> {
        let resources = self.records.clone().map(Resource::Buffer);
        DescriptorSet::new(layout, "the set", &resources)
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
        frame_padding: 0.0,
    }
}

/// One buffer of several pieces, which are never joined on the host.
fn joined<'a>(
    device: &Arc<Device>,
    name: &str,
    usage: BufferUse,
    pieces: impl Iterator<Item = &'a [u8]> + Clone,
) -> Result<Buffer, Error> {
    let bytes = pieces.clone().map(|piece| piece.len() as u64).sum();
    let mut upload = Upload::new(device, name, usage, bytes)?;
    for piece in pieces {
        upload.write(piece)?;
    }
    upload.finish()
}

/// The loaders bound every count far below this.
fn index(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}
