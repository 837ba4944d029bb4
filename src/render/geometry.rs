//! How do a scene's triangles come to the device?

use std::sync::Arc;

use super::draw_list::DrawList;
use crate::gpu::{Attribute, Buffer, BufferUse, Device, Error, Rate, Upload, VertexFormat};
use crate::interface::reflected::vertex_inputs;
use crate::scene::{Mesh, Scene};

/// The vertices and indices of all meshes.
pub struct Geometry {
    positions: Buffer,
    normals: Buffer,
    /// Where an effect needs them.
    coordinates: Option<Buffer>,
    /// Where an effect needs them.
    tangents: Option<Buffer>,
    /// Stands in for what no effect needs: one vertex for all.
    placeholder: Buffer,
    /// Indices of all meshes, then those of transparent objects again, sorted.
    pub indices: Buffer,
}

/// Which of the attributes that only some effects need a pipeline reads.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct Attributes {
    /// Texture coordinates.
    pub coordinates: bool,
    /// Tangents.
    pub tangents: bool,
}

impl Attributes {
    /// The attributes of `surface.vert`, in the order of [`Geometry::vertices`].
    pub fn surface(self) -> [Attribute; 4] {
        let attribute = |location, format, rate| Attribute {
            location,
            format,
            rate,
        };
        [
            attribute(
                vertex_inputs::in_position,
                VertexFormat::Rgb32Float,
                Rate::PerVertex,
            ),
            attribute(
                vertex_inputs::in_normal,
                VertexFormat::Rgb32Float,
                Rate::PerVertex,
            ),
            attribute(
                vertex_inputs::in_coordinates,
                VertexFormat::Rg32Float,
                rate(self.coordinates),
            ),
            attribute(
                vertex_inputs::in_tangent,
                VertexFormat::Rgba32Float,
                rate(self.tangents),
            ),
        ]
    }

    /// The attributes of `shadow.vert`, in the order of [`Geometry::outlines`].
    pub fn shadow(self) -> [Attribute; 2] {
        let [position, _, coordinates, _] = self.surface();
        [position, coordinates]
    }
}

fn rate(per_vertex: bool) -> Rate {
    match per_vertex {
        true => Rate::PerVertex,
        false => Rate::Constant,
    }
}

impl Geometry {
    /// Uploads all meshes, with the attributes that are needed.
    ///
    /// # Errors
    /// Beyond the device's limits, or no memory.
    pub fn new(
        device: &Arc<Device>,
        scene: &Scene,
        list: &DrawList,
        needed: Attributes,
    ) -> Result<Self, Error> {
        let meshes = &scene.meshes;
        let sorted = bytemuck::cast_slice(&list.sorted_indices);
        let indices = meshes
            .iter()
            .map(|mesh| bytemuck::cast_slice(&mesh.indices))
            .chain([sorted]);
        let optional = |needed: bool, name, of: fn(&Mesh) -> &[u8], bytes| {
            needed
                .then(|| padded(device, name, meshes, of, bytes))
                .transpose()
        };
        Ok(Self {
            positions: joined(device, "positions", BufferUse::Vertices, {
                meshes
                    .iter()
                    .map(|mesh| bytemuck::cast_slice(&mesh.positions))
            })?,
            normals: joined(device, "normals", BufferUse::Vertices, {
                meshes
                    .iter()
                    .map(|mesh| bytemuck::cast_slice(&mesh.normals))
            })?,
            coordinates: optional(
                needed.coordinates,
                "texture coordinates",
                |mesh| bytemuck::cast_slice(&mesh.coordinates),
                VertexFormat::Rg32Float.bytes(),
            )?,
            tangents: optional(
                needed.tangents,
                "tangents",
                |mesh| bytemuck::cast_slice(&mesh.tangents),
                VertexFormat::Rgba32Float.bytes(),
            )?,
            placeholder: Buffer::with_data(
                device,
                "placeholder vertex",
                BufferUse::Vertices,
                &[0; 16],
            )?,
            indices: joined(device, "indices", BufferUse::Indices, indices)?,
        })
    }

    /// The vertex buffers of `surface.vert`.
    pub fn vertices(&self, attributes: Attributes) -> [&Buffer; 4] {
        [
            &self.positions,
            &self.normals,
            self.or_placeholder(&self.coordinates, attributes.coordinates),
            self.or_placeholder(&self.tangents, attributes.tangents),
        ]
    }

    /// The vertex buffers of `shadow.vert`.
    pub fn outlines(&self, attributes: Attributes) -> [&Buffer; 2] {
        let [positions, _, coordinates, _] = self.vertices(attributes);
        [positions, coordinates]
    }

    fn or_placeholder<'a>(&'a self, buffer: &'a Option<Buffer>, wanted: bool) -> &'a Buffer {
        match buffer {
            Some(buffer) if wanted => buffer,
            _ => &self.placeholder,
        }
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

/// An attribute of all meshes, of `stride` bytes a vertex; zeros for a mesh that lacks it.
fn padded(
    device: &Arc<Device>,
    name: &str,
    meshes: &[Mesh],
    of: fn(&Mesh) -> &[u8],
    stride: u32,
) -> Result<Buffer, Error> {
    const ZEROS: [u8; 4096] = [0; 4096];
    let size = |mesh: &Mesh| mesh.positions.len() * stride as usize;
    let bytes = meshes.iter().map(|mesh| size(mesh) as u64).sum();
    let mut upload = Upload::new(device, name, BufferUse::Vertices, bytes)?;
    for mesh in meshes {
        upload.write(of(mesh))?;
        let mut missing = size(mesh).saturating_sub(of(mesh).len());
        while missing > 0 {
            let now = missing.min(ZEROS.len());
            upload.write(&ZEROS[..now])?;
            missing -= now;
        }
    }
    upload.finish()
}
