//! What says plaster without a word? A cast of a curly-haired head on a turned foot.

use glam::{Affine3A, Vec2, Vec3};

use super::loft::{curve2, lathe};
use super::noise::cellular;
use super::sdf::{Roll, add, ball, carve, ellipsoid, join, limb, roll};
use super::surface::Surface;
use super::{Part, part, surface_nets};

fn v(x: f32, y: f32, z: f32) -> Vec3 {
    Vec3::new(x, y, z)
}

const JAW: Roll = [
    0.088, 0.700, -0.005, 0.030, 0.610, 0.095, 0.022, 0.026, 0.05,
];
const BROW: Roll = [0.016, 0.778, 0.132, 0.078, 0.776, 0.100, 0.017, 0.014, 0.03];
/// The upper lid in two pieces, and a thinner lower one.
const LIDS: [Roll; 3] = [
    [
        0.022, 0.751, 0.124, 0.046, 0.764, 0.130, 0.0070, 0.0080, 0.006,
    ],
    [
        0.046, 0.764, 0.130, 0.075, 0.749, 0.110, 0.0080, 0.0065, 0.006,
    ],
    [
        0.024, 0.735, 0.122, 0.068, 0.733, 0.112, 0.0058, 0.0055, 0.006,
    ],
];
const NOSE: Roll = [0.0, 0.785, 0.134, 0.0, 0.700, 0.176, 0.0140, 0.0185, 0.024];
const LIPS: [Roll; 2] = [
    [
        0.0, 0.653, 0.140, 0.042, 0.645, 0.116, 0.0130, 0.0060, 0.010,
    ],
    [
        0.0, 0.627, 0.138, 0.036, 0.636, 0.118, 0.0150, 0.0070, 0.010,
    ],
];
/// What is cut away: the line between the lips, and the groove under the nose.
const GROOVES: [Roll; 2] = [
    [
        0.0, 0.6405, 0.156, 0.048, 0.6425, 0.122, 0.0045, 0.0035, 0.006,
    ],
    [0.0, 0.667, 0.166, 0.0, 0.660, 0.167, 0.005, 0.005, 0.008],
];

/// Skull, jaw, cheeks and chin. `q` is the point mirrored to the right half.
fn head(q: Vec3) -> f32 {
    let skull = ellipsoid(q, v(0.0, 0.800, -0.030), v(0.128, 0.150, 0.160));
    let mask = ellipsoid(q, v(0.0, 0.705, 0.045), v(0.094, 0.138, 0.098));
    let mut d = add(q, join(skull, mask, 0.06), &[JAW]);
    d = join(d, ball(q, v(0.0, 0.603, 0.112), 0.030), 0.04);
    join(d, ball(q, v(0.066, 0.712, 0.092), 0.032), 0.05)
}

/// Brow, eye, nose, mouth.
fn face(q: Vec3, head: f32) -> f32 {
    let socket = ellipsoid(q, v(0.047, 0.748, 0.160), v(0.034, 0.021, 0.034));
    let mut d = carve(add(q, head, &[BROW]), socket, 0.022);
    d = join(d, ball(q, v(0.046, 0.746, 0.108), 0.0265), 0.006);
    d = add(q, add(q, d, &LIDS), &[NOSE]);
    // The tip of the nose, its wing, and the nostril.
    d = join(d, ball(q, v(0.0, 0.697, 0.177), 0.0190), 0.012);
    d = join(d, ball(q, v(0.0165, 0.690, 0.157), 0.0125), 0.016);
    d = carve(d, ball(q, v(0.0100, 0.678, 0.165), 0.0060), 0.005);
    let lips = add(q, d, &LIPS);
    let cut = |d: f32, r: &Roll| carve(d, roll(q, r), r[8]);
    GROOVES.iter().fold(lips, cut)
}

fn ear(q: Vec3) -> f32 {
    let shell = ellipsoid(q, v(0.132, 0.728, -0.012), v(0.016, 0.046, 0.030));
    let hollow = ellipsoid(q, v(0.150, 0.732, -0.006), v(0.014, 0.028, 0.016));
    carve(shell, hollow, 0.006)
}

/// Locks: snail-like curls in the cells of a noise, standing off the skull.
fn hair(p: Vec3) -> f32 {
    let skull = ellipsoid(p, v(0.0, 0.806, -0.038), v(0.134, 0.156, 0.164));
    // The locks reach 18 mm; further off the skull's own distance is bound enough.
    if skull.abs() > 0.05 {
        return skull - 0.018;
    }
    let (first, second) = cellular(p * 17.0 + 0.5, 401);
    let curl = 0.5 + 0.5 * (first * 15.0).cos();
    // Rounded where two locks meet: a sharper groove would be finer than the mesh.
    let rise = ((second - first) / 0.40).min(1.0);
    let lock = rise * rise * (3.0 - 2.0 * rise) * 0.014 + curl * 0.004;
    let cap = skull - lock;
    // The hairline: a plane from above the forehead to the nape.
    let line = (p.z - 0.085) - (p.y - 0.835) * 0.95;
    carve(cap, -line * 0.72, 0.02)
}

/// The muscle from behind the ear to the breastbone.
const NECK_MUSCLE: Roll = [
    0.092, 0.690, -0.035, 0.020, 0.462, 0.040, 0.020, 0.013, 0.022,
];
/// Shoulder and collarbone.
const SHOULDER: [Roll; 2] = [
    [0.05, 0.50, -0.075, 0.20, 0.425, -0.065, 0.055, 0.060, 0.06],
    [
        0.028, 0.448, 0.043, 0.185, 0.455, -0.010, 0.013, 0.011, 0.025,
    ],
];
/// What the foot carries.
const STEM: Roll = [0.0, 0.33, -0.03, 0.0, 0.19, -0.02, 0.080, 0.076, 0.06];

/// Neck, collarbones, shoulders and chest, cut as busts are.
fn torso(q: Vec3) -> f32 {
    let neck = limb(q, v(0.0, 0.68, -0.045), v(0.0, 0.46, -0.05), 0.076, 0.086);
    let mut d = add(q, neck, &[NECK_MUSCLE]);
    d = join(d, ball(q, v(0.0, 0.565, 0.030), 0.018), 0.03);
    let ribs = ellipsoid(q, v(0.0, 0.355, -0.045), v(0.270, 0.125, 0.118));
    let breast = ellipsoid(q, v(0.095, 0.345, 0.030), v(0.105, 0.070, 0.050));
    let chest = join(add(q, ribs, &SHOULDER), breast, 0.04);
    d = join(d, add(q, chest, &[STEM]), 0.045);
    let cut = ellipsoid(q, v(0.0, 0.475, -0.03), v(0.245, 0.250, 0.60));
    let stem = limb(q, v(0.0, 0.40, -0.02), v(0.0, 0.19, -0.02), 0.200, 0.078);
    // A cast's edges are worn: 2.5 cm of rounding, which the mesh also needs.
    carve(carve(d, -join(cut, stem, 0.05), 0.025), q.y - 0.206, 0.01)
}

fn figure(p: Vec3) -> f32 {
    let q = v(p.x.abs(), p.y, p.z);
    // The neck ends inside the skull, below 0.74 m: 5 cm above that a bound is enough.
    let above = p.y - 0.74;
    let body = if above > 0.05 { above } else { torso(q) };
    // Well below the chin there is nothing but the torso.
    if p.y < 0.50 {
        return body;
    }
    // No feature reaches behind z = 0.07 m.
    let skull = head(q);
    let front = if q.z > 0.05 { face(q, skull) } else { skull };
    let mut d = join(front, body, 0.020);
    d = join(d, ear(q), 0.010);
    if p.y > 0.58 {
        join(d, hair(p), 0.008)
    } else {
        d
    }
}

/// The turned foot: (radius, height).
const FOOT: [[f32; 2]; 9] = [
    [0.150, 0.055],
    [0.146, 0.070],
    [0.120, 0.082],
    [0.078, 0.105],
    [0.064, 0.140],
    [0.070, 0.172],
    [0.088, 0.190],
    [0.092, 0.205],
    [0.080, 0.220],
];

fn foot() -> Surface {
    let mut profile = vec![
        Vec2::ZERO,
        Vec2::new(0.166, 0.0),
        Vec2::new(0.170, 0.004),
        Vec2::new(0.170, 0.047),
        Vec2::new(0.166, 0.052),
    ];
    profile.extend(curve2(&FOOT, 4));
    profile.push(Vec2::new(0.0, 0.24));
    lathe(&profile, 56).shade(40.0)
}

/// Above this height the cells are `FINER` times as low: lids and lips run across.
const NECK: f32 = 0.55;
const FINER: f32 = 1.6;

pub fn bust() -> Vec<Part> {
    let top = NECK + (1.02 - NECK) * FINER;
    let bounds = [v(-0.29, 0.18, -0.26), v(0.29, top, 0.24)];
    let head_stretched = |p: Vec3| v(p.x, p.y.min(NECK) + (p.y - NECK).max(0.0) / FINER, p.z);
    let mut plaster = surface_nets::mesh(bounds, 0.0102, head_stretched, figure);
    plaster.append(&foot(), Affine3A::from_translation(v(0.0, 0.0, -0.02)));
    vec![part("plaster", plaster)]
}
