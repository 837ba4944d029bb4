//! What says dirt without a word? A heap of clods and pebbles with a seedling on top.

use std::f32::consts::{PI, TAU};

use glam::{Affine3A, EulerRot, Quat, Vec2, Vec3};

use super::loft::{Ends, curve3, loft, ring, sweep};
use super::noise::{Dice, cellular, fractal, gradient};
use super::surface::{Solid, Surface};
use super::{Part, part};

const RADIUS: f32 = 0.46;
const HEIGHT: f32 = 0.33;

/// The foot's distance from the middle in the direction of `p`.
fn reach(p: Vec3) -> f32 {
    RADIUS * (1.0 + 0.14 * gradient(p.normalize_or_zero() * 1.8, 81))
}

/// Lumps of several sizes: what (x, z) rises above the plain heap, m.
fn lumps(p: Vec3) -> f32 {
    let (lump, _) = cellular(p * 12.0, 82);
    0.040 * (0.5 - lump) + 0.032 * fractal(p * 10.0, 4, 83)
}

/// The height of the heap without lumps, and how far (x, z) is from its foot, 0..1.
fn plain(x: f32, z: f32) -> (f32, f32) {
    let p = Vec3::new(x, 0.0, z);
    let t = (1.0 - p.length() / reach(p)).max(0.0);
    // Soil rests at about 35 degrees: a cone, rounded at the top and steep at the foot.
    let bell = t * t * (3.0 - 2.0 * t) * 0.45 + t * 0.55 + 0.10 * (t * 12.0).min(1.0);
    (HEIGHT * bell * 0.92, t)
}

/// The heap's height above (x, z).
fn height(x: f32, z: f32) -> f32 {
    let (base, t) = plain(x, z);
    (base + lumps(Vec3::new(x, 0.0, z)) * (t * 9.0).min(1.0)).max(0.0)
}

/// The heap's skin, cut into the dry surface and the damp hollows.
fn heap() -> [Surface; 2] {
    let (around, rows) = (120, 44);
    let loop_at = |row: usize| {
        let share = (1.0 - row as f32 / rows as f32).max(0.004);
        let flat = ring(around, 0.0, |_| 1.0)
            .into_iter()
            .map(|p| p * reach(p) * share);
        flat.map(|p| Vec3::new(p.x, height(p.x, p.z), p.z))
            .collect()
    };
    let loops: Vec<Vec<Vec3>> = (0..=rows).map(loop_at).collect();
    let hollow = |p: Vec3| plain(p.x, p.z).0 - p.y - 0.010;
    let [deep, dry] = loft(&loops, Ends::Capped).shade(60.0).split(hollow);
    [dry, deep]
}

/// A lump of unit size: a ball pushed about by noise, broken into facets.
fn lump(seed: u32, roughness: f32, crease: f32) -> Surface {
    let (around, rows) = (9, 6);
    let latitude = |row: usize| PI * ((row as f32 + 0.5) / rows as f32 - 0.5);
    let loops: Vec<_> = (0..rows)
        .map(|row| ring(around, latitude(row).sin(), |_| latitude(row).cos()))
        .collect();
    let push = |p: Vec3| p * (1.0 + roughness * fractal(p * 1.3, 3, seed));
    loft(&loops, Ends::Capped).map(push).shade(crease)
}

/// Strews `count` lumps, larger ones lower, as they roll.
fn strew(dice: &mut Dice, lumps: &[Surface], count: usize, size: Vec2, flatness: f32) -> Surface {
    let mut surface = Surface::default();
    for n in 0..count {
        let angle = dice.range(0.0, TAU);
        let distance = RADIUS * dice.range(0.02, 1.0).sqrt() * 1.06;
        let large = dice.range(0.0, 1.0) * dice.range(0.3, 1.0);
        let radius = size.x + (size.y - size.x) * large;
        let (x, z) = (distance * angle.cos(), distance * angle.sin());
        let turn = Quat::from_euler(
            EulerRot::XYZ,
            dice.range(-0.5, 0.5),
            dice.range(0.0, TAU),
            dice.range(-0.5, 0.5),
        );
        let seat = Vec3::new(x, height(x, z) + radius * flatness, z);
        let place = Affine3A::from_scale_rotation_translation(Vec3::splat(radius), turn, seat);
        surface.append(&lumps[n % lumps.len()], place);
    }
    surface
}

/// A leaf along +z from its stalk, 1 long: pointed, folded along its rib, bent downward.
fn leaf() -> Surface {
    let mut solid = Solid::default();
    let (rows, columns) = (12, 6);
    // Both faces, one just below the other, so that the leaf is seen from either side.
    for side in [0, 1] {
        let first = solid.points.len() as u32;
        for row in 0..=rows {
            for column in 0..=columns {
                let t = row as f32 / rows as f32;
                let across = 2.0 * column as f32 / columns as f32 - 1.0;
                let width = 0.30 * (PI * t.powf(0.75)).sin().max(0.0) + 0.012 * (1.0 - t);
                let y = 0.30 * t - 0.22 * t * t + 0.35 * width * across.abs() - 0.012 * side as f32;
                solid.point(Vec3::new(across * width, y, t));
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let a = first + row * (columns + 1) + column;
                let [b, c, d] = [a + 1, a + columns + 2, a + columns + 1];
                if side == 0 {
                    solid.quad(a, d, c, b)
                } else {
                    solid.quad(a, b, c, d)
                }
            }
        }
    }
    solid.shade(70.0)
}

fn sprout() -> Surface {
    let root = Vec3::new(0.02, HEIGHT - 0.03, 0.0);
    let path = curve3(
        &[
            root,
            root + Vec3::new(0.012, 0.10, 0.01),
            root + Vec3::new(-0.012, 0.20, 0.012),
            root + Vec3::new(0.0, 0.29, 0.02),
        ],
        5,
    );
    let mut surface = sweep(&path, 10, |t| Vec2::splat(0.0125 - 0.004 * t)).shade(70.0);
    let leaf = leaf();
    let crown = root + Vec3::new(0.0, 0.285, 0.02);
    let node = root + Vec3::new(-0.010, 0.17, 0.012);
    let leaves = [
        (1.25, 0.22, 0.35, crown),
        (-1.55, 0.21, 0.30, crown),
        (2.8, 0.12, 0.75, crown),
        (0.25, 0.14, 0.30, node),
    ];
    for (turn, length, rise, at) in leaves {
        let pose = Quat::from_rotation_y(turn) * Quat::from_rotation_x(-rise);
        surface.append(
            &leaf,
            Affine3A::from_scale_rotation_translation(Vec3::splat(length), pose, at),
        );
    }
    surface
}

pub fn soil() -> Vec<Part> {
    let mut dice = Dice::new(91);
    let clods: Vec<Surface> = (0..6).map(|n| lump(100 + n, 0.34, 28.0)).collect();
    let stones: Vec<Surface> = (0..4).map(|n| lump(200 + n, 0.16, 80.0)).collect();
    let [mut dry, deep] = heap();
    dry.append(
        &strew(&mut dice, &clods, 120, Vec2::new(0.010, 0.058), 0.35),
        Affine3A::IDENTITY,
    );
    let pebbles = strew(&mut dice, &stones, 16, Vec2::new(0.014, 0.036), 0.3);
    vec![
        part("soil", dry),
        part("deep", deep),
        part("pebbles", pebbles),
        part("sprout", sprout()),
    ]
}
