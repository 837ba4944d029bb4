//! Where does a texture lie on a surface that has no coordinates?
//!
//! As on a box around it, in the mesh's own frame: each triangle takes the axis nearest to its
//! normal, and its coordinates are metres along the two others. Seen from outside, u goes to the
//! right and v up, so that text can be read on all six sides: on upright ones v is +y; on the upper
//! side it is -z, on the lower +z, as the sides that are folded from the front. Vertices between
//! triangles of different axes are split.

use glam::{DVec3, Vec3};

use super::mesh::Mesh;
use super::normals::{TooManyVertices, face_normal};

/// A triangle nearer to a later axis by no more than this takes the first: the two triangles of a
/// bevel of 45 degrees differ by rounding, and stay together.
const TIE: f64 = 1e-4;

/// The six sides, as u and v: u x v points out.
const SIDES: [[Vec3; 2]; 6] = [
    [Vec3::X, Vec3::NEG_Z],
    [Vec3::X, Vec3::Z],
    [Vec3::NEG_Z, Vec3::Y],
    [Vec3::Z, Vec3::Y],
    [Vec3::X, Vec3::Y],
    [Vec3::NEG_X, Vec3::Y],
];

/// Gives a mesh coordinates.
pub(super) fn project(mesh: &mut Mesh) -> Result<(), TooManyVertices> {
    // Which side each vertex took first, and the copies that other sides took.
    let mut sides: Vec<Option<usize>> = vec![None; mesh.positions.len()];
    let mut copies: Vec<[u32; 6]> = Vec::new();
    let mut copies_of: Vec<u32> = vec![u32::MAX; mesh.positions.len()];
    mesh.coordinates = vec![[0.0; 2]; mesh.positions.len()];
    let (triangles, _) = mesh.indices.as_chunks_mut::<3>();
    for triangle in triangles {
        let corners = triangle.map(|vertex| mesh.positions[vertex as usize]);
        let side = side(face_normal(corners));
        for vertex in triangle {
            let place = *vertex as usize;
            let taken = *sides[place].get_or_insert(side);
            let own = if taken == side {
                *vertex
            } else {
                if copies_of[place] == u32::MAX {
                    copies_of[place] = copies.len() as u32;
                    copies.push([u32::MAX; 6]);
                }
                let copy = &mut copies[copies_of[place] as usize][side];
                if *copy == u32::MAX {
                    *copy = new_vertex(mesh.positions.len())?;
                    mesh.positions.push(mesh.positions[place]);
                    mesh.normals.push(mesh.normals[place]);
                    mesh.coordinates.push([0.0; 2]);
                }
                *copy
            };
            let position = Vec3::from_array(mesh.positions[place]);
            mesh.coordinates[own as usize] = SIDES[side].map(|axis| axis.dot(position));
            *vertex = own;
        }
    }
    Ok(())
}

/// The number of a vertex after `count` others; `u32::MAX` is kept free, since it marks "none".
pub(super) fn new_vertex(count: usize) -> Result<u32, TooManyVertices> {
    let number = u32::try_from(count).ok();
    number
        .filter(|&number| number < u32::MAX)
        .ok_or(TooManyVertices)
}

/// The side of a face, as a number in `SIDES`.
fn side(normal: DVec3) -> usize {
    let size = normal.abs();
    let near = size.max_element() - TIE;
    if size.y >= near {
        usize::from(normal.y < 0.0)
    } else if size.x >= near {
        2 + usize::from(normal.x < 0.0)
    } else {
        4 + usize::from(normal.z < 0.0)
    }
}
