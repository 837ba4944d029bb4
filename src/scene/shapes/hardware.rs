//! What says steel without a word? A gear wheel, a threaded bolt and hexagon nuts.

use std::f32::consts::TAU;

use glam::{Affine3A, EulerRot, Quat, Vec3};

use super::loft::{Ends, at, loft, ring};
use super::surface::Surface;
use super::{Part, part};

const TEETH: usize = 16;

/// A tooth's outline over one pitch: 0 in the gap, 1 on the crest. The flanks take a fifth
/// each, the crest a quarter, which is close to an involute's at 20 degrees.
fn tooth(angle: f32) -> f32 {
    let phase = (angle / TAU * TEETH as f32).fract();
    let distance = (phase - 0.5).abs();
    ((0.33 - distance) / 0.20).clamp(0.0, 1.0)
}

/// The wheel around y: toothed rim, sunk web, hub with a bore.
fn gear() -> Surface {
    // 12 points per tooth: each corner of the outline is met within 1/24 of a pitch.
    let count = TEETH * 12;
    let toothed =
        |height: f32, inset: f32| ring(count, height, |angle| 0.325 + 0.075 * tooth(angle) - inset);
    let round = |height: f32, radius: f32| ring(count, height, |_| radius);
    // One side from the rim to the bore: (radius, height).
    let side = [
        (0.285, 0.070),
        (0.280, 0.065),
        (0.268, 0.040),
        // The web is dished, so that it mirrors a range of directions and not one.
        (0.255, 0.031),
        (0.238, 0.024),
        (0.218, 0.020),
        (0.198, 0.020),
        (0.180, 0.024),
        (0.166, 0.031),
        (0.156, 0.040),
        (0.148, 0.084),
        (0.143, 0.090),
        (0.096, 0.090),
        (0.088, 0.082),
    ];
    let mut loops = vec![toothed(-0.070, 0.010), toothed(-0.060, 0.0)];
    loops.extend([toothed(0.060, 0.0), toothed(0.070, 0.010)]);
    loops.extend(side.iter().map(|(radius, height)| round(*height, *radius)));
    loops.extend(
        side.iter()
            .rev()
            .map(|(radius, height)| round(-height, *radius)),
    );
    loft(&loops, Ends::Joined).shade(35.0)
}

/// Distance from the axis to a hexagon's side, 1 at the middle of a side.
fn hexagon(angle: f32) -> f32 {
    let sector = TAU / 6.0;
    let within = (angle / sector).fract() * sector - sector * 0.5;
    1.0 / within.cos()
}

/// A hexagon's loop, cut round where a turned chamfer of radius `limit` is narrower.
fn hexagon_loop(height: f32, apothem: f32, limit: f32) -> Vec<Vec3> {
    ring(AROUND, height, |angle| {
        (apothem * hexagon(angle)).min(limit)
    })
}

/// Corners around a bolt: a multiple of 6, so that hexagons are exact.
const AROUND: usize = 60;

const SHANK: f32 = 0.085;
const THREAD_PITCH: f32 = 0.042;

/// Radius of a 60 degree thread with a flat crest and root, `phase` in turns.
fn thread(phase: f32) -> f32 {
    let distance = (phase.rem_euclid(1.0) - 0.5).abs();
    let depth = 0.54 * THREAD_PITCH;
    SHANK - depth * ((distance - 0.07) / 0.33).clamp(0.0, 1.0)
}

/// A bolt that stands on its head: head, plain shank, thread, chamfered end at height 0.78.
fn bolt() -> Surface {
    let (apothem, length) = (0.15, 0.78);
    let mut loops = vec![
        hexagon_loop(0.0, 0.138, 0.138),
        hexagon_loop(0.014, apothem, 0.160),
    ];
    loops.extend([
        hexagon_loop(0.022, apothem, 0.172),
        hexagon_loop(0.118, apothem, 0.172),
    ]);
    loops.extend([
        hexagon_loop(0.126, apothem, 0.160),
        hexagon_loop(0.13, 0.138, 0.138),
    ]);
    let shank = [
        (0.13, SHANK + 0.012),
        (0.14, SHANK + 0.002),
        (0.26, SHANK),
        (0.27, SHANK * 0.9),
    ];
    loops.extend(
        shank
            .iter()
            .map(|(height, radius)| ring(AROUND, *height, |_| *radius)),
    );
    let rows = 84;
    for row in 0..=rows {
        let height = 0.275 + (length - 0.275) * row as f32 / rows as f32;
        // The chamfer takes the last 3 cm to below the root.
        let limit = SHANK - (height - (length - 0.03)).max(0.0) * 0.9;
        let turn = |angle: f32| thread(height / THREAD_PITCH - angle / TAU).min(limit);
        loops.push(ring(AROUND, height, turn));
    }
    loft(&loops, Ends::Capped).shade(40.0)
}

fn nut() -> Surface {
    let (apothem, bore, high) = (0.15, 0.078, 0.13);
    let round = |height: f32, radius: f32| ring(AROUND, height, |_| radius);
    let loops = [
        hexagon_loop(0.0, 0.140, 0.140),
        hexagon_loop(0.016, apothem, 0.162),
        hexagon_loop(0.022, apothem, 0.174),
        hexagon_loop(high - 0.022, apothem, 0.174),
        hexagon_loop(high - 0.016, apothem, 0.162),
        hexagon_loop(high, 0.140, 0.140),
        round(high, bore + 0.016),
        round(high - 0.016, bore),
        round(0.016, bore),
        round(0.0, bore + 0.016),
    ];
    loft(&loops, Ends::Joined).shade(40.0)
}

pub fn hardware() -> Vec<Part> {
    let mut steel = Surface::default();
    // The wheel stands on its teeth, its face a little up and to the left.
    let turn = Quat::from_euler(EulerRot::YXZ, -0.30, 1.36, 0.0);
    steel.append(
        &gear(),
        Affine3A::from_rotation_translation(turn, Vec3::new(-0.13, 0.395, -0.16)),
    );
    steel.append(
        &bolt(),
        at(0.30, 0.0, 0.10) * Affine3A::from_rotation_y(0.3),
    );
    steel.append(
        &nut(),
        at(0.30, 0.42, 0.10) * Affine3A::from_rotation_y(0.65),
    );
    steel.append(
        &nut(),
        at(-0.12, 0.0, 0.27) * Affine3A::from_rotation_y(0.2),
    );
    vec![part("steel", steel)]
}
