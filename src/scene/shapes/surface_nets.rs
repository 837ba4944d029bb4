//! Which triangles lie on the zero level of a distance function?
//!
//! Naive surface nets (S. Gibson, "Constrained Elastic Surface Nets", 1998): one vertex per
//! grid cell that the surface crosses, one quad per crossed grid edge. The vertices are then
//! drawn to the surface, and their normals are the function's gradient.

use glam::{UVec3, Vec3};
use rayon::prelude::*;

use super::surface::Surface;

/// Blocks of this many cells are skipped whole where the surface is far.
const BLOCK: usize = 4;

/// A box of sample points.
struct Grid {
    low: Vec3,
    cell: f32,
    /// Samples along each axis.
    size: [usize; 3],
    values: Vec<f32>,
}

/// Meshes `distance(p) = 0` inside the box `low..high` with cells of `cell` metres.
///
/// `place` takes grid space to model space; where it shrinks, cells are finer. The surface must
/// lie inside the box; `distance` must not change faster than 1.1 m per m of the grid, or parts
/// may be missed.
pub fn mesh(
    [low, high]: [Vec3; 2],
    cell: f32,
    place: impl Fn(Vec3) -> Vec3 + Sync,
    distance: impl Fn(Vec3) -> f32 + Sync,
) -> Surface {
    let grid = Grid::sample(low, high, cell, &|p| distance(place(p)));
    let (mut surface, vertices) = grid.vertices();
    surface.positions.iter_mut().for_each(|p| *p = place(*p));
    grid.faces(&vertices, &mut surface.indices);
    let positions = surface.positions.par_iter_mut();
    let vertices = positions.zip(&mut surface.normals);
    vertices.for_each(|(position, normal)| {
        (*position, *normal) = settle(&distance, *position, cell);
    });
    surface
}

/// Draws a vertex to the surface, and finds the normal there.
fn settle(distance: &impl Fn(Vec3) -> f32, p: Vec3, cell: f32) -> (Vec3, Vec3) {
    // Two fifths of a cell span the surface's noise without blurring its form.
    let (slope, level) = slope(distance, p, cell * 0.4);
    // One Newton step, bounded by half a cell so that neighbours keep their order; where
    // a crease flattens the gradient, a slope of 1/2 bounds it too.
    let step = slope * (level / slope.length_squared().max(0.25));
    (
        p - step.clamp_length_max(cell * 0.5),
        slope.try_normalize().unwrap_or(Vec3::Y),
    )
}

/// The gradient and the mean level, from four samples at the corners of a tetrahedron.
fn slope(distance: &impl Fn(Vec3) -> f32, p: Vec3, reach: f32) -> (Vec3, f32) {
    let corners = [
        Vec3::new(1.0, -1.0, -1.0),
        Vec3::new(-1.0, -1.0, 1.0),
        Vec3::new(-1.0, 1.0, -1.0),
        Vec3::ONE,
    ];
    let levels = corners.map(|corner| distance(p + corner * reach));
    let sum: Vec3 = corners
        .iter()
        .zip(levels)
        .map(|(corner, d)| *corner * d)
        .sum();
    (sum / (4.0 * reach), levels.iter().sum::<f32>() * 0.25)
}

impl Grid {
    fn sample(low: Vec3, high: Vec3, cell: f32, distance: &(impl Fn(Vec3) -> f32 + Sync)) -> Self {
        let blocks = ((high - low) / (cell * BLOCK as f32))
            .ceil()
            .as_uvec3()
            .max(UVec3::ONE);
        let size = blocks.to_array().map(|n| n as usize * BLOCK);
        let mut grid = Self {
            low,
            cell,
            size,
            values: vec![0.0; size[0] * size[1] * size[2]],
        };
        let layer = size[0] * size[1] * BLOCK;
        let layers = grid.values.par_chunks_mut(layer).enumerate();
        layers.for_each(|(n, values)| fill_layer(values, low, cell, size, n * BLOCK, distance));
        grid
    }

    fn at(&self, x: usize, y: usize, z: usize) -> usize {
        x + self.size[0] * (y + self.size[1] * z)
    }

    /// One vertex per crossed cell: the mean of the crossings of its edges.
    fn vertices(&self) -> (Surface, Vec<u32>) {
        let mut surface = Surface::default();
        let mut vertices = vec![u32::MAX; self.values.len()];
        for z in 0..self.size[2] - 1 {
            for y in 0..self.size[1] - 1 {
                for x in 0..self.size[0] - 1 {
                    let corners = self.corners(x, y, z);
                    let inside = corners.iter().filter(|d| **d < 0.0).count();
                    if inside == 0 || inside == 8 {
                        continue;
                    }
                    let p = Vec3::new(x as f32, y as f32, z as f32) + crossing(&corners);
                    vertices[self.at(x, y, z)] = surface.vertex(self.low + p * self.cell, Vec3::Y);
                }
            }
        }
        (surface, vertices)
    }

    fn corners(&self, x: usize, y: usize, z: usize) -> [f32; 8] {
        let base = self.at(x, y, z);
        let (up, deep) = (self.size[0], self.size[0] * self.size[1]);
        [0, 1, up, up + 1, deep, deep + 1, deep + up, deep + up + 1]
            .map(|step| self.values[base + step])
    }

    /// One quad around each crossed grid edge, from the four cells that share it.
    fn faces(&self, vertices: &[u32], indices: &mut Vec<u32>) {
        let strides = [1, self.size[0], self.size[0] * self.size[1]];
        for z in 1..self.size[2] - 1 {
            for y in 1..self.size[1] - 1 {
                for x in 1..self.size[0] - 1 {
                    let here = self.at(x, y, z);
                    if vertices[here] == u32::MAX {
                        continue;
                    }
                    for axis in 0..3 {
                        let (u, v) = (strides[(axis + 1) % 3], strides[(axis + 2) % 3]);
                        let inside = self.values[here] < 0.0;
                        if inside == (self.values[here + strides[axis]] < 0.0) {
                            continue;
                        }
                        let quad = [here - u - v, here - v, here, here - u].map(|i| vertices[i]);
                        let [a, b, c, d] = quad;
                        // Outside lies along +axis where the near end is inside.
                        indices.extend(if inside {
                            [a, b, c, a, c, d]
                        } else {
                            [a, c, b, a, d, c]
                        });
                    }
                }
            }
        }
    }
}

/// Samples one layer of blocks; far blocks get their centre's value.
fn fill_layer(
    values: &mut [f32],
    low: Vec3,
    cell: f32,
    size: [usize; 3],
    first_z: usize,
    distance: &impl Fn(Vec3) -> f32,
) {
    // Half a block's diagonal from its first to its last sample, plus a cell, at 1.1 m per m.
    let far = ((BLOCK as f32 - 1.0) * 0.5 * 3f32.sqrt() + 1.0) * cell * 1.1;
    let middle = Vec3::splat((BLOCK as f32 - 1.0) * 0.5);
    let point = |x: usize, y: usize, z: usize| Vec3::new(x as f32, y as f32, (first_z + z) as f32);
    for by in (0..size[1]).step_by(BLOCK) {
        for bx in (0..size[0]).step_by(BLOCK) {
            let centre = distance(low + (point(bx, by, 0) + middle) * cell);
            for z in 0..BLOCK {
                for y in by..by + BLOCK {
                    let row = (z * size[1] + y) * size[0] + bx;
                    for x in 0..BLOCK {
                        let sample = || distance(low + point(bx + x, y, z) * cell);
                        values[row + x] = if centre.abs() > far { centre } else { sample() };
                    }
                }
            }
        }
    }
}

/// The mean of the zero crossings on a cell's edges, in units of the cell.
fn crossing(corners: &[f32; 8]) -> Vec3 {
    let place = |k: usize| Vec3::new((k & 1) as f32, (k >> 1 & 1) as f32, (k >> 2) as f32);
    let (mut sum, mut count) = (Vec3::ZERO, 0.0);
    for a in 0..8 {
        for bit in [1, 2, 4] {
            let b = a | bit;
            if b != a && (corners[a] < 0.0) != (corners[b] < 0.0) {
                let t = corners[a] / (corners[a] - corners[b]);
                sum += place(a).lerp(place(b), t);
                count += 1.0;
            }
        }
    }
    sum / count
}
