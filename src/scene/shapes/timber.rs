//! What says wood without a word? A sawn log with bark and growth rings, on grained boards.

use std::f32::consts::TAU;

use glam::{Affine3A, Quat, Vec3};

use super::loft::{Ends, loft, turned_at};
use super::noise::{Dice, cellular, fractal, gradient};
use super::surface::{Solid, Surface};
use super::{Part, part};

const LENGTH: f32 = 0.60;
/// Radius of the wood under the bark.
const WOOD: f32 = 0.275;
const RINGS: usize = 14;
/// The share of a year's ring that is pale early wood.
const EARLY: f32 = 0.66;
const AROUND: usize = 104;

/// A point of the log's cross-section: `s` is 0 at the pith and 1 under the bark.
/// The pith lies off the middle, as in a tree that leaned.
fn section(s: f32, angle: f32) -> Vec3 {
    let (x, z) = (angle.cos(), -angle.sin());
    let wave = gradient(Vec3::new(x, z, s) * 1.7, 3) * 0.08
        + gradient(Vec3::new(x, z, s * 6.0) * 3.0, 4) * 0.02;
    let radius = WOOD * s * (1.0 + wave * s.min(0.5) * 2.0);
    let pith = Vec3::new(-0.035, 0.0, -0.02) * (1.0 - s);
    pith + Vec3::new(x, 0.0, z) * radius
}

/// The sawn end, facing up at height 0: early and late wood in turn.
fn end_grain() -> [Surface; 2] {
    let mut dice = Dice::new(21);
    let mut bounds = vec![0.0];
    for ring in 0..RINGS {
        // Rings narrow with age: a square root keeps their areas alike.
        let at = |n: f32| ((n + 0.35) / (RINGS as f32 + 0.35)).powf(0.8);
        bounds.push(at(ring as f32 + EARLY + dice.range(-0.12, 0.12)));
        bounds.push(at(ring as f32 + 1.0));
    }
    let mut sides = [Solid::default(), Solid::default()];
    for (n, pair) in bounds.windows(2).enumerate() {
        let solid = &mut sides[n % 2];
        let first = solid.points.len() as u32;
        for s in pair {
            solid
                .points
                .extend((0..AROUND).map(|j| section(*s, TAU * j as f32 / AROUND as f32)));
        }
        for j in 0..AROUND as u32 {
            let k = (j + 1) % AROUND as u32;
            let outer = first + AROUND as u32;
            solid.quad(first + j, outer + j, outer + k, first + k);
        }
    }
    sides.map(|solid| solid.shade(30.0))
}

/// Drying cracks on the sawn end: dark wedges that run along the rays.
fn checks() -> Surface {
    let mut solid = Solid::default();
    for (angle, from, to, width) in [
        (0.6f32, 0.10, 0.93, 0.011),
        (2.9, 0.30, 0.99, 0.008),
        (4.5, 0.52, 0.98, 0.006),
    ] {
        let mut previous: Option<[u32; 2]> = None;
        for step in 0..=8 {
            let t = step as f32 / 8.0;
            let s = from + (to - from) * t;
            let bend = gradient(Vec3::new(s * 9.0, angle, 0.0), 7) * 0.05;
            let centre = section(s, angle + bend);
            let across = Vec3::new(-angle.sin(), 0.0, -angle.cos()) * (width * 0.5 * t + 0.0008);
            // 0.6 mm above the wood: enough to win the depth test from any sensible distance.
            let lift = Vec3::Y * 0.0006;
            let pair = [
                solid.point(centre - across + lift),
                solid.point(centre + across + lift),
            ];
            if let Some([a, b]) = previous {
                solid.quad(a, pair[0], pair[1], b);
            }
            previous = Some(pair);
        }
    }
    solid.shade(30.0)
}

/// How far the bark stands above its furrows, 0..1: plates, longer than wide.
fn plates(p: Vec3) -> f32 {
    let warped = p * Vec3::new(17.0, 6.5, 17.0) + fractal(p * 7.0, 2, 30) * 0.5;
    let (first, second) = cellular(warped, 31);
    ((second - first) / 0.35).clamp(0.0, 1.0)
}

/// A tube of bark, open to the wood at both ends.
fn bark() -> [Surface; 2] {
    let rows = 32;
    let outer = |row: usize| -> Vec<Vec3> {
        let t = row as f32 / rows as f32;
        let height = LENGTH * (t - 0.5);
        let point = |j: usize| {
            let base = section(1.0, TAU * j as f32 / AROUND as f32) + Vec3::Y * height;
            let out = Vec3::new(base.x, 0.0, base.z).normalize();
            let rise = 0.014 + 0.026 * plates(base) + 0.006 * gradient(base * 40.0, 33);
            base + out * rise
        };
        (0..AROUND).map(point).collect()
    };
    let inner = |height: f32| -> Vec<Vec3> {
        let point = |j: usize| section(0.985, TAU * j as f32 / AROUND as f32) + Vec3::Y * height;
        (0..AROUND).map(point).collect()
    };
    let mut loops: Vec<_> = (0..=rows).map(outer).collect();
    // The bark ends 2 mm behind the cut, so that the wood's edge stays clean.
    loops.push(inner(LENGTH * 0.5 - 0.002));
    loops.push(inner(-LENGTH * 0.5 + 0.002));
    let level = |p: Vec3| {
        let out = Vec3::new(p.x, 0.0, p.z);
        let cut = p.y.abs() > LENGTH * 0.5 - 0.004;
        if cut {
            0.3
        } else {
            plates(out.normalize() * WOOD + Vec3::Y * p.y) - 0.35
        }
    };
    loft(&loops, Ends::Joined).shade(70.0).split(level)
}

/// Late wood where positive: rings around a trunk axis that lies `below` the board.
fn grain(p: Vec3, below: f32, seed: u32) -> f32 {
    let drift = gradient(Vec3::new(p.x * 1.6, p.z * 2.0, 0.0), seed) * 0.035 + p.x * 0.05;
    let fine = gradient(Vec3::new(p.x * 5.0, p.y * 9.0, p.z * 9.0), seed + 1) * 0.006;
    let distance = Vec3::new(0.0, p.y + below + drift, p.z).length() + fine;
    let phase = (distance / 0.026).fract();
    (phase - 0.5).abs() - 0.32
}

/// A rectangle spanned by `u` and `v`, centred at `centre`, facing `u` x `v`.
fn face(solid: &mut Solid, centre: Vec3, u: Vec3, v: Vec3, cells: [u32; 2]) {
    let first = solid.points.len() as u32;
    for row in 0..=cells[1] {
        for column in 0..=cells[0] {
            let place = |n: u32, of: u32| 2.0 * n as f32 / of as f32 - 1.0;
            solid.point(centre + u * place(column, cells[0]) + v * place(row, cells[1]));
        }
    }
    let stride = cells[0] + 1;
    for row in 0..cells[1] {
        for column in 0..cells[0] {
            let a = first + row * stride + column;
            solid.quad(a, a + 1, a + 1 + stride, a + stride);
        }
    }
}

/// A sawn board: early and late wood.
fn board(half: Vec3, below: f32, seed: u32) -> [Surface; 2] {
    let mut solid = Solid::default();
    let (x, y, z) = (Vec3::X * half.x, Vec3::Y * half.y, Vec3::Z * half.z);
    face(&mut solid, y, z, x, [26, 20]);
    face(&mut solid, z, x, y, [24, 8]);
    face(&mut solid, x, y, z, [8, 26]);
    face(&mut solid, -x, z, y, [26, 8]);
    face(&mut solid, -z, y, x, [8, 12]);
    face(&mut solid, -y, x, z, [4, 4]);
    let [late, early] = solid.shade(30.0).split(|p| grain(p, below, seed));
    [early, late]
}

pub fn timber() -> Vec<Part> {
    let add = |sides: &mut [Surface; 2], pair: &[Surface; 2], place: Affine3A| {
        for (side, surface) in sides.iter_mut().zip(pair) {
            side.append(surface, place);
        }
    };
    let thickness = 0.04;
    let lower = board(Vec3::new(0.44, thickness, 0.17), 0.02, 41);
    let upper = board(Vec3::new(0.42, thickness, 0.15), 0.06, 51);
    let mut boards: [Surface; 2] = Default::default();
    for (board, turn, seat) in [
        (&lower, 4.0, Vec3::new(0.0, thickness, 0.16)),
        (&lower, 184.0, Vec3::new(0.0, thickness, -0.19)),
        (&upper, -5.0, Vec3::new(0.02, thickness * 3.0 + 0.001, 0.0)),
    ] {
        add(&mut boards, board, turned_at(turn, seat));
    }
    // The log lies on the boards, its sawn end to the viewer and a little to the left.
    let lie = Quat::from_rotation_y(-0.42) * Quat::from_rotation_x(TAU / 4.0);
    let log =
        Affine3A::from_rotation_translation(lie, Vec3::new(0.0, thickness * 4.0 + 0.295, 0.0));
    let end = end_grain();
    let far_end = Affine3A::from_rotation_x(TAU / 2.0);
    let sawn = Affine3A::from_translation(Vec3::Y * (LENGTH * 0.5));
    let mut ends: [Surface; 2] = Default::default();
    add(&mut ends, &end, log * sawn);
    add(&mut ends, &end, log * far_end * sawn);
    let [ridge, mut furrow] = bark();
    furrow.append(&checks(), sawn);
    let [early, late] = boards;
    let [end_early, end_late] = ends;
    vec![
        part("early", early),
        part("late", late),
        part("end_early", end_early),
        part("end_late", end_late),
        part("bark", ridge.placed(log)),
        part("furrow", furrow.placed(log)),
    ]
}
