//! What is a triangle mesh, and what box does it fill?

use glam::{Affine3A, Vec3};

/// A list of triangles over shared vertices, in metres, counter-clockwise seen from the front.
///
/// `normals` has one unit vector per position; `indices` has three entries per triangle. Coordinates
/// are there where a material in use has pictures, tangents where one of them is a normal map.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// What messages call it: a shape's part, or an object of an OBJ file.
    pub name: String,
    /// Positions in the mesh's own frame, m.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals, one per position.
    pub normals: Vec<[f32; 3]>,
    /// Three vertex numbers per triangle.
    pub indices: Vec<u32>,
    /// Texture coordinates, one per position or none at all: u to the right, v up, the picture's
    /// lower left corner at (0, 0). Finite.
    pub coordinates: Vec<[f32; 2]>,
    /// One per position or none at all: a unit vector along u at right angles to the normal, and
    /// 1, or -1 where the picture lies mirrored. The direction of v is w (normal x tangent).
    pub tangents: Vec<[f32; 4]>,
}

impl Mesh {
    /// The number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.indices.len() / 3
    }

    /// The smallest box around all vertices; empty for a mesh without any.
    pub fn bounds(&self) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for &position in &self.positions {
            bounds.add(Vec3::from_array(position));
        }
        bounds
    }
}

/// A box with sides along the axes, m. Empty where `min` exceeds `max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub min: Vec3,
    pub max: Vec3,
}

impl Bounds {
    /// The box around nothing.
    pub const EMPTY: Self = Self {
        min: Vec3::INFINITY,
        max: Vec3::NEG_INFINITY,
    };

    /// The box around meshes that stand somewhere: numbers of `meshes`, each with its transform.
    pub(super) fn around<'a>(
        meshes: &[Mesh],
        placed: impl Iterator<Item = (usize, &'a Affine3A)>,
    ) -> Self {
        let boxes: Vec<Self> = meshes.iter().map(Mesh::bounds).collect();
        let mut all = Self::EMPTY;
        for (mesh, transform) in placed {
            for corner in boxes[mesh].corners() {
                all.add(transform.transform_point3(corner));
            }
        }
        all
    }

    /// Grows the box to hold `point`.
    pub fn add(&mut self, point: Vec3) {
        self.min = self.min.min(point);
        self.max = self.max.max(point);
    }

    /// True for the box around nothing.
    pub fn is_empty(&self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    /// The middle of the box; of an empty one, the origin.
    pub fn center(&self) -> Vec3 {
        if self.is_empty() {
            return Vec3::ZERO;
        }
        // Halved before the sum: the sum of two large coordinates may overflow.
        self.min * 0.5 + self.max * 0.5
    }

    /// Half the diagonal, m: the radius of the sphere about `center` that holds the box.
    pub fn radius(&self) -> f32 {
        if self.is_empty() {
            return 0.0;
        }
        (self.max * 0.5 - self.min * 0.5).length()
    }

    /// The eight corners; none of an empty box.
    pub fn corners(&self) -> impl Iterator<Item = Vec3> {
        let (min, max) = (self.min, self.max);
        let count = if self.is_empty() { 0 } else { 8 };
        (0..count).map(move |number| {
            let pick = |axis: usize| {
                if number >> axis & 1 == 0 {
                    min[axis]
                } else {
                    max[axis]
                }
            };
            Vec3::new(pick(0), pick(1), pick(2))
        })
    }
}
