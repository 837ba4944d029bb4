//! What do the plain shapes look like: ball, plane, box, pedestals, backdrop?

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::loft::{at, lathe, ring, rounded_box};
use super::surface::{Solid, Surface};
use super::{Part, part};

pub fn sphere() -> Vec<Part> {
    // The outline's error is 1 - cos(pi/96) = 0.05 %, below a pixel at 1,000 pixels.
    vec![part("sphere", ball(96, 48))]
}

/// A ball of radius 1 m around the origin.
pub fn ball(segments: usize, rows: usize) -> Surface {
    let latitude = |row: usize| PI * (row as f32 / rows as f32 - 0.5);
    let profile: Vec<_> = (0..=rows)
        .map(|row| Vec2::new(latitude(row).cos(), latitude(row).sin()))
        .collect();
    let mut surface = lathe(&profile, segments).shade(180.0);
    // The ball's own normals, not those of its facets.
    surface.normals = surface.positions.iter().map(|p| p.normalize()).collect();
    surface
}

/// A sheet in x and z, `columns` x `rows` quads, facing up.
fn sheet(half: f32, cells: usize) -> Solid {
    let mut solid = Solid::default();
    for row in 0..=cells {
        for column in 0..=cells {
            let place = |n: usize| half * (2.0 * n as f32 / cells as f32 - 1.0);
            solid.point(Vec3::new(place(column), 0.0, place(row)));
        }
    }
    let index = |column: usize, row: usize| (row * (cells + 1) + column) as u32;
    for row in 0..cells {
        for column in 0..cells {
            let (next_column, next_row) = (column + 1, row + 1);
            solid.quad(
                index(column, row),
                index(column, next_row),
                index(next_column, next_row),
                index(next_column, row),
            );
        }
    }
    solid
}

pub fn plane() -> Vec<Part> {
    vec![part("plane", sheet(1.0, 8).shade(30.0))]
}

pub fn cube() -> Vec<Part> {
    let mut solid = Solid::default();
    // Corner n has the bits of n as x, y and z: exact coordinates, shared by the faces.
    for n in 0..8 {
        let place = |bit: u32| (n >> bit & 1) as f32;
        solid.point(Vec3::new(place(0) - 0.5, place(1), place(2) - 0.5));
    }
    let sides = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    for [a, b, c, d] in sides {
        solid.quad(a, b, c, d);
    }
    let surface = solid.shade(30.0);
    vec![part("cube", surface)]
}

pub fn plinth() -> Vec<Part> {
    let mut surface = Surface::default();
    // Base, shaft and top board; the joints are shadow gaps of 6 mm.
    let slabs = [(0.0, 0.07, 0.40), (0.076, 0.924, 0.36), (0.93, 1.0, 0.40)];
    for (low, high, half) in slabs {
        let slab = rounded_box(Vec3::new(half, (high - low) * 0.5, half), 0.008, 3).shade(50.0);
        surface.append(&slab, at(0.0, (low + high) * 0.5, 0.0));
    }
    let neck = rounded_box(Vec3::new(0.34, 0.49, 0.34), 0.004, 1).shade(50.0);
    surface.append(&neck, at(0.0, 0.5, 0.0));
    vec![part("plinth", surface)]
}

/// A profile's edge at `corner`, rounded over a quarter circle from `from` to `to` degrees.
fn rounded_edge(profile: &mut Vec<Vec2>, centre: Vec2, radius: f32, from: f32, to: f32) {
    for step in 0..=4 {
        let angle = (from + (to - from) * step as f32 / 4.0).to_radians();
        profile.push(centre + Vec2::new(angle.cos(), angle.sin()) * radius);
    }
}

pub fn drum() -> Vec<Part> {
    let mut profile = vec![Vec2::ZERO];
    for (low, high, radius) in [(0.0, 0.07, 0.42), (0.076, 0.924, 0.38), (0.93, 1.0, 0.42)] {
        rounded_edge(
            &mut profile,
            Vec2::new(radius - 0.008, low + 0.008),
            0.008,
            -90.0,
            0.0,
        );
        rounded_edge(
            &mut profile,
            Vec2::new(radius - 0.008, high - 0.008),
            0.008,
            0.0,
            90.0,
        );
        if high < 1.0 {
            profile.extend([Vec2::new(0.35, high), Vec2::new(0.35, high + 0.006)]);
        }
    }
    profile.push(Vec2::new(0.0, 1.0));
    vec![part("drum", lathe(&profile, 72).shade(40.0))]
}

/// Discs stacked 0.2 mm apart, each smaller than the one below. Drawn with a black material of
/// low opacity they darken the ground in steps too small to see.
pub fn shadow() -> Vec<Part> {
    let (discs, corners) = (16, 28);
    let mut solid = Solid::default();
    for disc in 0..discs {
        let t = disc as f32 / discs as f32;
        let height = 0.0008 + 0.0002 * disc as f32;
        let first = solid.points.len() as u32;
        solid
            .points
            .extend(ring(corners, height, |_| 1.0 - 0.70 * t));
        let centre = solid.point(Vec3::Y * height);
        for j in 0..corners as u32 {
            solid
                .faces
                .push([centre, first + j, first + (j + 1) % corners as u32]);
        }
    }
    vec![part("shadow", solid.shade(30.0))]
}

pub fn backdrop() -> Vec<Part> {
    // Floor 14 m deep, wall 9 m high, 30 m wide: more than a camera in front of it can see.
    let (wall, height, radius, half_width) = (-4.0, 9.0, 2.5, 15.0);
    let mut line = vec![Vec2::new(10.0, 0.0), Vec2::new(3.0, 0.0)];
    for step in 0..=16 {
        let angle = PI * 0.5 * step as f32 / 16.0;
        line.push(Vec2::new(
            wall + radius * (1.0 - angle.sin()),
            radius * (1.0 - angle.cos()),
        ));
    }
    line.push(Vec2::new(wall, height));
    // One "loop" per column; an open skin between them.
    let columns = 12;
    let column = |n: usize| -> Vec<Vec3> {
        let x = half_width * (2.0 * n as f32 / columns as f32 - 1.0);
        line.iter().map(|p| Vec3::new(x, p.y, p.x)).collect()
    };
    let mut solid = Solid::default();
    let loops: Vec<_> = (0..=columns).map(column).collect();
    let rows = line.len();
    solid.points = loops.concat();
    for n in 0..columns {
        for row in 0..rows - 1 {
            let near = (n * rows + row) as u32;
            let far = near + rows as u32;
            solid.quad(near, far, far + 1, near + 1);
        }
    }
    vec![part("backdrop", solid.shade(60.0))]
}
