//! How do points and triangles become a shaded surface?

use glam::{Affine3A, Vec3, Vec3A};

/// Triangles over shared points, counter-clockwise from outside, not yet shaded.
#[derive(Clone, Default)]
pub struct Solid {
    pub points: Vec<Vec3>,
    pub faces: Vec<[u32; 3]>,
}

/// Triangles with a unit normal at each vertex.
#[derive(Clone, Default)]
pub struct Surface {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    pub indices: Vec<u32>,
}

impl Solid {
    pub fn point(&mut self, p: Vec3) -> u32 {
        self.points.push(p);
        (self.points.len() - 1) as u32
    }

    pub fn quad(&mut self, a: u32, b: u32, c: u32, d: u32) {
        self.faces.push([a, b, c]);
        self.faces.push([a, c, d]);
    }

    /// Moves every point; the map must not mirror.
    pub fn map(mut self, mut f: impl FnMut(Vec3) -> Vec3) -> Self {
        self.points.iter_mut().for_each(|p| *p = f(*p));
        self
    }

    /// Area vectors: twice the area, along the face's normal.
    fn face_vectors(&self) -> Vec<Vec3> {
        let corner = |index: u32| self.points[index as usize];
        self.faces
            .iter()
            .map(|f| {
                let a = corner(f[0]);
                (corner(f[1]) - a).cross(corner(f[2]) - a)
            })
            .collect()
    }

    /// For each point the corners (3 * face + k) that meet there: offsets and list.
    fn corners_by_point(&self, keep: &[bool]) -> (Vec<u32>, Vec<u32>) {
        let mut offsets = vec![0u32; self.points.len() + 1];
        let kept = || {
            self.faces
                .iter()
                .enumerate()
                .filter(|(face, _)| keep[*face])
        };
        for (_, face) in kept() {
            face.iter()
                .for_each(|point| offsets[*point as usize + 1] += 1);
        }
        for point in 0..self.points.len() {
            offsets[point + 1] += offsets[point];
        }
        let mut next = offsets.clone();
        let mut corners = vec![0u32; offsets[self.points.len()] as usize];
        for (index, face) in kept() {
            for (k, point) in face.iter().enumerate() {
                let slot = &mut next[*point as usize];
                corners[*slot as usize] = (index * 3 + k) as u32;
                *slot += 1;
            }
        }
        (offsets, corners)
    }

    /// Smooth normals, broken where two faces meet at more than `crease_degrees`.
    ///
    /// Faces weigh by area, so that a wide flat face stays flat and its bevel carries the turn.
    /// Faces without area are left out.
    pub fn shade(&self, crease_degrees: f32) -> Surface {
        let vectors = self.face_vectors();
        // 1e-14 m^2 is a square of 0.1 micrometres: what remains of a collapsed face.
        let keep: Vec<bool> = vectors.iter().map(|v| v.length() > 1e-14).collect();
        let units: Vec<Vec3> = vectors.iter().map(|v| v.normalize_or_zero()).collect();
        let (offsets, corners) = self.corners_by_point(&keep);
        let limit = crease_degrees.to_radians().cos();
        let mut surface = Surface::default();
        let mut vertex_of = vec![0u32; self.faces.len() * 3];
        for (point, p) in self.points.iter().enumerate() {
            let around = &corners[offsets[point] as usize..offsets[point + 1] as usize];
            let first = surface.positions.len();
            for corner in around {
                let own = units[*corner as usize / 3];
                let faces = around.iter().map(|other| *other as usize / 3);
                let sum: Vec3 = faces
                    .filter(|f| units[*f].dot(own) >= limit)
                    .map(|f| vectors[f])
                    .sum();
                let normal = sum.try_normalize().unwrap_or(own);
                // Same sum, same vertex: 1e-6 is above rounding and below what is seen.
                let known = (first..surface.normals.len())
                    .find(|v| surface.normals[*v].distance_squared(normal) < 1e-12);
                vertex_of[*corner as usize] =
                    known.unwrap_or_else(|| surface.vertex(*p, normal) as usize) as u32;
            }
        }
        let corners_of = |face: usize| [0, 1, 2].map(|k| vertex_of[face * 3 + k]);
        let kept = (0..self.faces.len()).filter(|face| keep[*face]);
        surface.indices = kept.flat_map(corners_of).collect();
        surface
    }
}

impl Surface {
    pub fn vertex(&mut self, position: Vec3, normal: Vec3) -> u32 {
        self.positions.push(position);
        self.normals.push(normal);
        (self.positions.len() - 1) as u32
    }

    /// Adds `other` through a map that turns, moves and scales evenly.
    pub fn append(&mut self, other: &Surface, place: Affine3A) {
        let first = self.positions.len() as u32;
        let turn = place.matrix3;
        self.positions
            .extend(other.positions.iter().map(|p| place.transform_point3(*p)));
        self.normals.extend(
            other
                .normals
                .iter()
                .map(|n| Vec3::from(turn * Vec3A::from(*n)).normalize()),
        );
        self.indices
            .extend(other.indices.iter().map(|index| index + first));
    }

    /// The same surface elsewhere: turned, moved and evenly scaled.
    pub fn placed(&self, place: Affine3A) -> Surface {
        let mut surface = Surface::default();
        surface.append(self, place);
        surface
    }

    /// Cuts along `level(p) = 0`: the part where it is above, and the part where it is not.
    ///
    /// The level is sampled at the vertices and taken as linear between them. This paints
    /// a pattern (growth rings, nails) on a model without a texture.
    pub fn split(&self, level: impl Fn(Vec3) -> f32) -> [Surface; 2] {
        let levels: Vec<f32> = self.positions.iter().map(|p| level(*p)).collect();
        let mut cutter = Cutter::new(self, levels);
        for face in self.indices.chunks_exact(3) {
            cutter.cut([face[0], face[1], face[2]]);
        }
        cutter.sides
    }
}

/// Sorts the triangles of one surface to the two sides of a level set.
struct Cutter<'a> {
    source: &'a Surface,
    levels: Vec<f32>,
    sides: [Surface; 2],
    /// Where each source vertex went, per side; `u32::MAX` when it did not.
    moved: [Vec<u32>; 2],
}

impl<'a> Cutter<'a> {
    fn new(source: &'a Surface, levels: Vec<f32>) -> Self {
        let unmoved = vec![u32::MAX; levels.len()];
        Self {
            source,
            levels,
            sides: Default::default(),
            moved: [unmoved.clone(), unmoved],
        }
    }

    fn side(&self, vertex: u32) -> usize {
        usize::from(self.levels[vertex as usize] <= 0.0)
    }

    fn keep(&mut self, side: usize, vertex: u32) -> u32 {
        let v = vertex as usize;
        if self.moved[side][v] == u32::MAX {
            self.moved[side][v] =
                self.sides[side].vertex(self.source.positions[v], self.source.normals[v]);
        }
        self.moved[side][v]
    }

    /// The point of an edge at level 0, for both sides. The lower index goes first, so that
    /// the two triangles of an edge find the same point to the bit.
    fn cross(&mut self, a: u32, b: u32) -> [u32; 2] {
        let (a, b) = (a.min(b) as usize, a.max(b) as usize);
        // Kept off the ends, so that no sliver collapses to nothing.
        let t = (self.levels[a] / (self.levels[a] - self.levels[b])).clamp(0.02, 0.98);
        let position = self.source.positions[a].lerp(self.source.positions[b], t);
        let blend = self.source.normals[a].lerp(self.source.normals[b], t);
        let normal = blend.try_normalize().unwrap_or(self.source.normals[a]);
        [0, 1].map(|side| self.sides[side].vertex(position, normal))
    }

    fn cut(&mut self, face: [u32; 3]) {
        let sides = face.map(|v| self.side(v));
        if sides[0] == sides[1] && sides[1] == sides[2] {
            let kept = face.map(|v| self.keep(sides[0], v));
            self.sides[sides[0]].indices.extend(kept);
            return;
        }
        // Turn the triangle so that its first corner is alone on its side.
        let alone = (0..3)
            .find(|k| sides[(k + 1) % 3] == sides[(k + 2) % 3])
            .unwrap_or(0);
        let [a, b, c] = [0, 1, 2].map(|k| face[(alone + k) % 3]);
        let (near, far) = (sides[alone], 1 - sides[alone]);
        let (ab, ac) = (self.cross(a, b), self.cross(a, c));
        let (ka, kb, kc) = (self.keep(near, a), self.keep(far, b), self.keep(far, c));
        self.sides[near].indices.extend([ka, ab[near], ac[near]]);
        self.sides[far]
            .indices
            .extend([ab[far], kb, kc, ab[far], kc, ac[far]]);
    }
}
