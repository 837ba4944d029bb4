//! What says plastic without a word? Studded toy bricks in plain bright colours.

use glam::{Affine3A, Quat, Vec2, Vec3};

use super::loft::{at, lathe, rounded_box};
use super::surface::Surface;
use super::{Part, part};

/// Distance between studs, m: the toy's 8 mm at a scale of 19 to 1.
const PITCH: f32 = 0.152;
/// A brick's height without studs: 1.2 pitches.
const HEIGHT: f32 = PITCH * 1.2;
/// Edges are rounded by 1/20 of a pitch, so that each carries a highlight.
const BEVEL: f32 = PITCH * 0.05;
/// Bricks stand this far apart, as moulded ones do: the seam shows.
const SEAM: f32 = PITCH * 0.012;

fn stud() -> Surface {
    let (radius, height) = (PITCH * 0.3, PITCH * 0.21);
    let mut profile = vec![Vec2::new(0.0, -BEVEL), Vec2::new(radius, -BEVEL)];
    for step in 0..=3 {
        let angle = (30.0 * step as f32).to_radians();
        let (inset, drop) = (BEVEL * (1.0 - angle.cos()), BEVEL * (1.0 - angle.sin()));
        profile.push(Vec2::new(radius - inset, height - drop));
    }
    profile.push(Vec2::new(0.0, height));
    lathe(&profile, 28).shade(50.0)
}

/// A brick of `columns` x `rows` studs, its low corner at the origin.
fn brick(columns: usize, rows: usize) -> Surface {
    let (width, depth) = (columns as f32 * PITCH, rows as f32 * PITCH);
    let half = Vec3::new(
        width * 0.5 - SEAM,
        HEIGHT * 0.5 - SEAM * 0.5,
        depth * 0.5 - SEAM,
    );
    let mut surface = rounded_box(half, BEVEL, 3).shade(50.0);
    surface = surface.placed(at(width * 0.5, HEIGHT * 0.5, depth * 0.5));
    let stud = stud();
    for column in 0..columns {
        for row in 0..rows {
            let (x, z) = ((column as f32 + 0.5) * PITCH, (row as f32 + 0.5) * PITCH);
            surface.append(&stud, at(x, HEIGHT, z));
        }
    }
    surface
}

/// Puts a brick with its low corner at stud (`x`, `z`) of `layer`, the pile centred.
fn stack(surface: &mut Surface, x: f32, z: f32, layer: f32, columns: usize, rows: usize) {
    let place = at((x - 2.0) * PITCH, layer * HEIGHT, (z - 2.0) * PITCH);
    surface.append(&brick(columns, rows), place);
}

pub fn bricks() -> Vec<Part> {
    let colours: [Surface; 4] = Default::default();
    let [mut red, mut blue, mut yellow, mut green] = colours;
    stack(&mut red, 0.0, 2.0, 0.0, 4, 2);
    stack(&mut blue, 0.0, 0.0, 0.0, 4, 2);
    stack(&mut yellow, 0.0, 0.0, 1.0, 2, 4);
    stack(&mut green, 2.0, 0.0, 1.0, 2, 2);
    stack(&mut blue, 0.0, 1.0, 2.0, 2, 2);
    stack(&mut red, 1.0, 1.0, 3.0, 2, 2);
    // A loose one leans against the pile: 35 degrees, its lower edge on the ground.
    let lean = Quat::from_rotation_y(-0.35) * Quat::from_rotation_z(0.61);
    let place =
        Affine3A::from_rotation_translation(lean, Vec3::new(1.9 * PITCH, 0.03, 1.55 * PITCH));
    green.append(&brick(2, 2), place);
    vec![
        part("red", red),
        part("blue", blue),
        part("yellow", yellow),
        part("green", green),
    ]
}
