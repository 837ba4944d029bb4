//! What says copper without a word? A hammered kettle with a swan-neck spout.

use glam::{Affine3A, Vec2, Vec3};

use super::loft::{at, curve2, curve3, lathe, sweep};
use super::noise::cellular;
use super::surface::Surface;
use super::{Part, part};

/// Belly and shoulder, from the base's edge to the lid's seat: (radius, height).
const BODY: [[f32; 2]; 9] = [
    [0.300, 0.012],
    [0.345, 0.06],
    [0.385, 0.16],
    [0.390, 0.26],
    [0.355, 0.37],
    [0.275, 0.455],
    [0.195, 0.50],
    [0.175, 0.515],
    [0.178, 0.535],
];

/// The lid, from its rim to the knob's top.
const LID: [[f32; 2]; 11] = [
    [0.188, 0.541],
    [0.170, 0.560],
    [0.110, 0.590],
    [0.050, 0.606],
    [0.026, 0.616],
    [0.022, 0.632],
    [0.040, 0.652],
    [0.050, 0.675],
    [0.040, 0.700],
    [0.018, 0.710],
    [0.0, 0.711],
];

/// Hammer blows: shallow bowls, 55 mm wide, that meet in ridges. They fade towards the base
/// and the shoulder, where a smith planishes the sheet.
fn hammered(p: Vec3) -> Vec3 {
    let outward = Vec3::new(p.x, 0.0, p.z).normalize_or_zero();
    let band = ((p.y - 0.05) / 0.05).clamp(0.0, 1.0) * ((0.47 - p.y) / 0.05).clamp(0.0, 1.0);
    let (nearest, _) = cellular(p / 0.055, 5);
    p + outward * (band * 0.0055 * (nearest * nearest - 0.4).clamp(-0.4, 0.4))
}

fn body() -> Surface {
    let mut profile = vec![Vec2::ZERO, Vec2::new(0.285, 0.0), Vec2::new(0.297, 0.004)];
    profile.extend(curve2(&BODY, 7));
    profile.push(Vec2::new(0.0, 0.535));
    lathe(&profile, 120).map(hammered).shade(60.0)
}

fn lid() -> Surface {
    let mut profile = vec![Vec2::new(0.0, 0.534), Vec2::new(0.186, 0.534)];
    profile.extend(curve2(&LID, 3));
    lathe(&profile, 64).shade(60.0)
}

/// A swan neck from low on the belly to above the shoulder; the mouth is a thin rolled lip.
fn spout() -> Surface {
    let points = [
        Vec3::new(0.30, 0.17, 0.0),
        Vec3::new(0.42, 0.20, 0.0),
        Vec3::new(0.50, 0.30, 0.0),
        Vec3::new(0.535, 0.42, 0.0),
        Vec3::new(0.60, 0.52, 0.0),
        Vec3::new(0.665, 0.555, 0.0),
    ];
    let width = |t: f32| {
        let taper = 0.088 - 0.058 * t.sqrt();
        let lip = ((t - 0.93) / 0.07).clamp(0.0, 1.0);
        Vec2::splat(taper + 0.008 * lip * (2.0 - lip))
    };
    sweep(&curve3(&points, 7), 28, width).shade(60.0)
}

/// The bail over the lid, with its two lugs on the shoulder.
fn bail() -> Surface {
    let points = [
        Vec3::new(0.268, 0.43, 0.0),
        Vec3::new(0.300, 0.55, 0.0),
        Vec3::new(0.285, 0.72, 0.0),
        Vec3::new(0.165, 0.86, 0.0),
    ];
    let path = curve3(&points, 7);
    let strap = sweep(&path, 16, |_| Vec2::new(0.026, 0.012)).shade(60.0);
    let mut surface = strap.placed(Affine3A::IDENTITY);
    surface.append(&strap, Affine3A::from_rotation_y(std::f32::consts::PI));
    let lug = lathe(
        &[
            [0.0, -0.012],
            [0.038, -0.012],
            [0.044, 0.0],
            [0.030, 0.012],
            [0.0, 0.018],
        ]
        .map(Vec2::from),
        24,
    )
    .shade(50.0);
    for turn in [0.0, std::f32::consts::PI] {
        let seat = at(0.288, 0.452, 0.0) * Affine3A::from_rotation_z(-0.85);
        surface.append(&lug, Affine3A::from_rotation_y(turn) * seat);
    }
    surface
}

fn grip() -> Surface {
    let points = [
        Vec3::new(-0.19, 0.845, 0.0),
        Vec3::new(-0.10, 0.878, 0.0),
        Vec3::new(0.0, 0.888, 0.0),
        Vec3::new(0.10, 0.878, 0.0),
        Vec3::new(0.19, 0.845, 0.0),
    ];
    let width = |t: f32| Vec2::splat(0.024 + 0.016 * (4.0 * t * (1.0 - t)).sqrt());
    sweep(&curve3(&points, 5), 20, width).shade(60.0)
}

pub fn kettle() -> Vec<Part> {
    let mut copper = body();
    for piece in [lid(), spout(), bail()] {
        copper.append(&piece, Affine3A::IDENTITY);
    }
    vec![part("copper", copper), part("grip", grip())]
}
