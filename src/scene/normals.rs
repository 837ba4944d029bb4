//! Which way does a surface face where its file does not say?
//!
//! Triangles that share an edge belong to one smooth surface where their faces differ by less than
//! the crease angle. Around a point, the corners that such edges join share one normal: the sum of
//! their faces' unit normals, each weighted by the corner's angle (Thuermer and Wuethrich 1998,
//! "Computing vertex normals from polygonal facets"), so that the way a surface is cut into
//! triangles does not turn it. Both sides of a smooth edge then have the same normals.

use std::collections::HashMap;
use std::hash::{BuildHasher, RandomState};

use glam::DVec3;

/// Edges sharper than this stay sharp, degrees. A cylinder of 10 sides or more bends by at most 36
/// degrees per side and becomes round; an octagon's 45 degrees, a box's 90 and a bevel's 45 stay.
pub const CREASE_DEGREES: f64 = 40.0;

/// Faces on one edge that are compared with each: real surfaces have two, and a file with more
/// (leaves, paper sheets) still costs a bounded time.
const FACES_PER_EDGE: usize = 8;

/// Triangles over vertices, some of whose normals are zero and wanted.
pub(super) struct Surface {
    pub positions: Vec<[f32; 3]>,
    pub normals: Vec<[f32; 3]>,
    pub indices: Vec<u32>,
    /// Texture coordinates, one per position or none at all.
    pub coordinates: Vec<[f32; 2]>,
}

/// More vertices than a u32 can number.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct TooManyVertices;

/// Gives each vertex without a normal one, splitting it at creases. Triangles must have an area.
/// Vertices that stand at the same place count as one point, so pieces of a surface meet smoothly.
pub(super) fn fill_missing(
    surface: &mut Surface,
    crease_degrees: f64,
) -> Result<(), TooManyVertices> {
    if surface.normals.iter().all(|normal| *normal != [0.0; 3]) {
        return Ok(());
    }
    let corners = CornersByPoint::new(surface);
    let mut point = Point::new(crease_degrees.to_radians().cos());
    for range in corners.ranges() {
        point.gather(surface, &corners.list[range]);
        if point.missing.contains(&true) {
            point.join();
            point.assign(surface)?;
        }
    }
    Ok(())
}

/// The unit normal of a triangle, computed in f64 so that neither tiny nor huge ones are lost; zero
/// where it has no area.
pub(super) fn face_normal(corners: [[f32; 3]; 3]) -> DVec3 {
    let [a, b, c] = corners.map(|corner| DVec3::from_array(corner.map(f64::from)));
    (b - a).cross(c - a).normalize_or_zero()
}

/// The unit vector along `vector`; zero for a zero vector.
pub(super) fn unit(vector: [f32; 3]) -> [f32; 3] {
    let wide = DVec3::from_array(vector.map(f64::from));
    wide.normalize_or_zero().as_vec3().to_array()
}

/// The corners (places in `indices`) of the triangles around each point.
struct CornersByPoint {
    /// Where each point's corners begin in `list`; one entry more than there are points.
    starts: Vec<u32>,
    list: Vec<u32>,
}

impl CornersByPoint {
    fn new(surface: &Surface) -> Self {
        let (point_of, points) = weld(&surface.positions);
        let mut starts = vec![0_u32; points + 1];
        for &vertex in &surface.indices {
            starts[point_of[vertex as usize] as usize + 1] += 1;
        }
        for point in 0..points {
            starts[point + 1] += starts[point];
        }
        let mut list = vec![0_u32; surface.indices.len()];
        for (corner, &vertex) in surface.indices.iter().enumerate() {
            let point = point_of[vertex as usize] as usize;
            // `starts` runs ahead by each point's count here, and is set back below.
            list[starts[point] as usize] = corner as u32;
            starts[point] += 1;
        }
        for point in (1..=points).rev() {
            starts[point] = starts[point - 1];
        }
        starts[0] = 0;
        Self { starts, list }
    }

    fn ranges(&self) -> impl Iterator<Item = std::ops::Range<usize>> {
        self.starts
            .windows(2)
            .map(|pair| pair[0] as usize..pair[1] as usize)
    }
}

/// Numbers the points: vertices of equal position get the same number. Also gives their count.
fn weld(positions: &[[f32; 3]]) -> (Vec<u32>, usize) {
    const EMPTY: u32 = u32::MAX;
    // Half full at most, so that a search ends soon. Keys are random per process: a hostile file
    // cannot aim all its vertices at one slot. The numbering does not depend on them.
    let slots = (positions.len() * 2).next_power_of_two();
    let mut table = vec![EMPTY; slots];
    let keys = RandomState::new();
    let mut point_of = vec![0_u32; positions.len()];
    let mut points = 0;
    for (vertex, position) in positions.iter().enumerate() {
        // Adding zero makes -0 and 0 one place.
        let bits = position.map(|x| (x + 0.0).to_bits());
        let mut slot = keys.hash_one(bits) as usize & (slots - 1);
        point_of[vertex] = loop {
            let found = table[slot];
            if found == EMPTY {
                table[slot] = vertex as u32;
                points += 1;
                break (points - 1) as u32;
            }
            if positions[found as usize].map(|x| (x + 0.0).to_bits()) == bits {
                break point_of[found as usize];
            }
            slot = (slot + 1) & (slots - 1);
        };
    }
    (point_of, points)
}

/// The corners around one point; the buffers are kept from point to point.
struct Point {
    crease_cosine: f64,
    corners: Vec<u32>,
    face_normals: Vec<DVec3>,
    angles: Vec<f64>,
    missing: Vec<bool>,
    /// The other end of each edge at the point, as bits, with the corner that has it.
    edges: Vec<([u32; 3], u32)>,
    /// Each corner's parent in its group of smoothly joined corners (union-find).
    parents: Vec<u32>,
    /// Per group: the sum of normals, and the vertex that was given it.
    sums: Vec<DVec3>,
    vertices: Vec<Option<u32>>,
    /// Instead of `vertices` where there are coordinates: a vertex for each that a group has.
    seams: HashMap<(usize, [u32; 2]), u32>,
}

impl Point {
    fn new(crease_cosine: f64) -> Self {
        Self {
            crease_cosine,
            corners: Vec::new(),
            face_normals: Vec::new(),
            angles: Vec::new(),
            missing: Vec::new(),
            edges: Vec::new(),
            parents: Vec::new(),
            sums: Vec::new(),
            vertices: Vec::new(),
            seams: HashMap::new(),
        }
    }

    /// Reads the triangles around the point.
    fn gather(&mut self, surface: &Surface, corners: &[u32]) {
        self.corners.clear();
        self.corners.extend_from_slice(corners);
        self.face_normals.clear();
        self.angles.clear();
        self.missing.clear();
        self.edges.clear();
        for (number, &corner) in corners.iter().enumerate() {
            let corner = corner as usize;
            let first = corner - corner % 3;
            let at = |turn: usize| {
                let vertex = surface.indices[first + (corner - first + turn) % 3];
                surface.positions[vertex as usize]
            };
            let (here, next, last) = (at(0), at(1), at(2));
            let [p, q, r] = [here, next, last].map(|x| DVec3::from_array(x.map(f64::from)));
            let cross = (q - p).cross(r - p);
            self.face_normals.push(cross.normalize_or_zero());
            self.angles.push(cross.length().atan2((q - p).dot(r - p)));
            let vertex = surface.indices[corner] as usize;
            self.missing.push(surface.normals[vertex] == [0.0; 3]);
            for end in [next, last] {
                let bits = end.map(|x| (x + 0.0).to_bits());
                self.edges.push((bits, number as u32));
            }
        }
    }

    /// Joins corners across edges that are not creases.
    fn join(&mut self) {
        self.parents.clear();
        self.parents.extend(0..self.corners.len() as u32);
        self.edges.sort_unstable();
        for later in 0..self.edges.len() {
            let (end, corner) = self.edges[later];
            let earlier = later.saturating_sub(FACES_PER_EDGE)..later;
            for &(other_end, other) in self.edges[earlier].iter().rev() {
                if other_end != end {
                    break;
                }
                let cosine =
                    self.face_normals[corner as usize].dot(self.face_normals[other as usize]);
                if cosine >= self.crease_cosine {
                    let root = find(&mut self.parents, corner);
                    let other_root = find(&mut self.parents, other);
                    // The smaller number leads, so that the result does not depend on the order.
                    self.parents[root.max(other_root) as usize] = root.min(other_root);
                }
            }
        }
    }

    /// Gives each group's missing corners a vertex with the group's normal.
    fn assign(&mut self, surface: &mut Surface) -> Result<(), TooManyVertices> {
        self.sums.clear();
        self.sums.resize(self.corners.len(), DVec3::ZERO);
        self.seams.clear();
        self.vertices.clear();
        self.vertices.resize(self.corners.len(), None);
        for number in 0..self.corners.len() {
            let group = find(&mut self.parents, number as u32) as usize;
            self.sums[group] += self.face_normals[number] * self.angles[number];
        }
        for number in 0..self.corners.len() {
            if !self.missing[number] {
                continue;
            }
            let group = find(&mut self.parents, number as u32) as usize;
            let corner = self.corners[number] as usize;
            let old = surface.indices[corner];
            let seam = surface.coordinates.get(old as usize);
            let seam = seam.map(|pair| (group, pair.map(f32::to_bits)));
            let known = match &seam {
                None => self.vertices[group],
                Some(seam) => self.seams.get(seam).copied(),
            };
            let vertex = match known {
                Some(vertex) => vertex,
                None => {
                    let vertex = claim(surface, old, self.normal(group, number))?;
                    match seam {
                        None => self.vertices[group] = Some(vertex),
                        Some(seam) => drop(self.seams.insert(seam, vertex)),
                    }
                    vertex
                }
            };
            surface.indices[corner] = vertex;
        }
        Ok(())
    }

    /// The group's unit normal; where its faces cancel, that of the corner's own face.
    fn normal(&self, group: usize, number: usize) -> [f32; 3] {
        let sum = self.sums[group].normalize_or(self.face_normals[number]);
        sum.as_vec3().to_array()
    }
}

/// The vertex itself if it has no normal yet, else a copy of it.
fn claim(surface: &mut Surface, vertex: u32, normal: [f32; 3]) -> Result<u32, TooManyVertices> {
    if surface.normals[vertex as usize] == [0.0; 3] {
        surface.normals[vertex as usize] = normal;
        return Ok(vertex);
    }
    // u32::MAX itself is kept free: it marks "none" elsewhere.
    let copy = u32::try_from(surface.positions.len())
        .ok()
        .filter(|&copy| copy < u32::MAX)
        .ok_or(TooManyVertices)?;
    let position = surface.positions[vertex as usize];
    surface.positions.push(position);
    surface.normals.push(normal);
    if let Some(&pair) = surface.coordinates.get(vertex as usize) {
        surface.coordinates.push(pair);
    }
    Ok(copy)
}

/// The first corner of the group that `corner` belongs to.
fn find(parents: &mut [u32], mut corner: u32) -> u32 {
    while parents[corner as usize] != corner {
        // Shortens the path on the way.
        let grandparent = parents[parents[corner as usize] as usize];
        parents[corner as usize] = grandparent;
        corner = grandparent;
    }
    corner
}
