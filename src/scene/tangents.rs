//! Which way do u and v run on a surface?
//!
//! As in MikkTSpace, by which the tools bake normal maps, with v up (green up, as in OpenGL and
//! glTF). It gives a tangent to each corner of a triangle; a vertex whose corners differ is split.
//! Where coordinates say nothing (a triangle without an area in the picture), the tangent is some
//! unit vector at right angles to the normal.

use std::collections::HashMap;

use bevy_mikktspace::{Geometry, TangentSpace};
use glam::Vec3;

use super::box_projection::new_vertex;
use super::mesh::Mesh;
use super::normals::TooManyVertices;

/// How far a tangent may be from unit length and from right angles to its normal: hundreds of f32
/// roundings. MikkTSpace is off by more only where its sums overflow or cancel.
const OFF: f32 = 1e-4;

/// Gives a mesh with coordinates tangents.
pub(super) fn make(mesh: &mut Mesh) -> Result<(), TooManyVertices> {
    let mut corners = Corners {
        tangents: vec![[0.0; 4]; mesh.indices.len()],
        mesh,
    };
    let Ok(()) = bevy_mikktspace::generate_tangents(&mut corners) else {
        // The library has no error so far; should it get one, every tangent is a made one.
        return split(mesh, &[]);
    };
    let tangents = corners.tangents;
    split(mesh, &tangents)
}

/// Hands each corner's tangent to its vertex, or to a copy of it.
fn split(mesh: &mut Mesh, tangents: &[[f32; 4]]) -> Result<(), TooManyVertices> {
    let count = mesh.positions.len();
    let mut first: Vec<Option<[u32; 4]>> = vec![None; count];
    let mut copies: HashMap<(u32, [u32; 4]), u32> = HashMap::new();
    mesh.tangents = vec![[0.0; 4]; count];
    for corner in 0..mesh.indices.len() {
        let vertex = mesh.indices[corner];
        let place = vertex as usize;
        let normal = Vec3::from_array(mesh.normals[place]);
        let tangent = sound(tangents.get(corner).copied().unwrap_or_default(), normal);
        // Adding zero makes -0 and 0 one number.
        let bits = tangent.map(|x| (x + 0.0).to_bits());
        if *first[place].get_or_insert(bits) == bits {
            mesh.tangents[place] = tangent;
            continue;
        }
        let copy = match copies.get(&(vertex, bits)) {
            Some(&copy) => copy,
            None => {
                let copy = new_vertex(mesh.positions.len())?;
                mesh.positions.push(mesh.positions[place]);
                mesh.normals.push(mesh.normals[place]);
                mesh.coordinates.push(mesh.coordinates[place]);
                mesh.tangents.push(tangent);
                copies.insert((vertex, bits), copy);
                copy
            }
        };
        mesh.indices[corner] = copy;
    }
    // Vertices of no triangle.
    for (place, tangent) in mesh.tangents.iter_mut().enumerate().take(count) {
        if first[place].is_none() {
            *tangent = sound([0.0; 4], Vec3::from_array(mesh.normals[place]));
        }
    }
    Ok(())
}

/// The tangent, or some other where it is none.
fn sound(tangent: [f32; 4], normal: Vec3) -> [f32; 4] {
    let [x, y, z, _] = tangent;
    let along = Vec3::new(x, y, z);
    // NaN is not near.
    let near = |x: f32| x.abs() <= OFF;
    if near(along.length() - 1.0) && near(along.dot(normal)) {
        return tangent;
    }
    let across = normal.try_normalize().unwrap_or(Vec3::Z);
    let made = along.reject_from_normalized(across).try_normalize();
    let made = made.unwrap_or_else(|| across.any_orthonormal_vector());
    let hand = if tangent[3] < 0.0 { -1.0 } else { 1.0 };
    [made.x, made.y, made.z, hand]
}

/// The corners of a mesh as MikkTSpace asks for them.
struct Corners<'a> {
    mesh: &'a Mesh,
    /// One for each entry of the mesh's indices.
    tangents: Vec<[f32; 4]>,
}

impl Corners<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.mesh.indices[3 * face + corner] as usize
    }
}

impl Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.triangle_count()
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.positions[self.vertex(face, corner)]
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.normals[self.vertex(face, corner)]
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.mesh.coordinates[self.vertex(face, corner)]
    }

    fn set_tangent(&mut self, tangent: Option<TangentSpace>, face: usize, corner: usize) {
        if let Some(tangent) = tangent {
            self.tangents[3 * face + corner] = tangent.tangent_encoded();
        }
    }
}
