//! What says gold without a word? A pile of ingots, and coins beside it.

use std::f32::consts::TAU;

use glam::{Affine3A, Quat, Vec2, Vec3};

use super::loft::{Ends, at, loft, ring, rounded_rectangle, turned_at};
use super::surface::Surface;
use super::{Part, part};

const INGOT_HALF: Vec2 = Vec2::new(0.33, 0.105);
const INGOT_HEIGHT: f32 = 0.145;

/// A cast bar: draft on its sides, rounded edges, a sunk field on top.
fn ingot() -> Surface {
    let corner = 0.03;
    // (height, inset from the foot's outline): foot, flank, shoulder, field.
    let steps = [
        (0.0, 0.008),
        (0.003, 0.002),
        (0.009, 0.0),
        (INGOT_HEIGHT - 0.014, 0.030),
        (INGOT_HEIGHT - 0.004, 0.035),
        (INGOT_HEIGHT, 0.044),
        (INGOT_HEIGHT, 0.058),
        (INGOT_HEIGHT - 0.003, 0.062),
        (INGOT_HEIGHT - 0.010, 0.064),
        (INGOT_HEIGHT - 0.012, 0.068),
    ];
    let outline = |(height, inset): (f32, f32)| {
        rounded_rectangle(
            INGOT_HALF - inset,
            (corner - inset * 0.3).max(0.008),
            4,
            height,
        )
    };
    let loops: Vec<_> = steps.into_iter().map(outline).collect();
    loft(&loops, Ends::Capped).shade(48.0)
}

const COIN_RADIUS: f32 = 0.105;
const COIN_HEIGHT: f32 = 0.026;

/// A coin with a reeded edge, a raised rim and a boss for a portrait.
fn coin() -> Surface {
    let reeds = 26;
    // Four points per reed: two on the crest, two in the groove.
    let reeded = |angle: f32| {
        let phase = (angle / TAU * reeds as f32 + 0.01).fract();
        if phase < 0.5 {
            COIN_RADIUS
        } else {
            COIN_RADIUS - 0.004
        }
    };
    let loop_at = |height: f32, inset: f32| ring(reeds * 4, height, |angle| reeded(angle) - inset);
    let round_at = |height: f32, radius: f32| ring(reeds * 4, height, |_| radius);
    let low = [round_at(0.0, COIN_RADIUS - 0.012), loop_at(0.004, 0.0)];
    let high = [
        loop_at(COIN_HEIGHT - 0.004, 0.0),
        round_at(COIN_HEIGHT, COIN_RADIUS - 0.010),
        round_at(COIN_HEIGHT, COIN_RADIUS - 0.018),
        round_at(COIN_HEIGHT - 0.005, COIN_RADIUS - 0.022),
        round_at(COIN_HEIGHT - 0.005, 0.048),
        round_at(COIN_HEIGHT, 0.034),
        round_at(COIN_HEIGHT + 0.001, 0.012),
    ];
    loft(&[&low[..], &high[..]].concat(), Ends::Capped).shade(35.0)
}

pub fn bullion() -> Vec<Part> {
    let (bar, coin) = (ingot(), coin());
    let mut gold = Surface::default();
    let width = INGOT_HALF.y * 2.0 + 0.006;
    for n in -1..=1 {
        gold.append(&bar, at(0.0, 0.0, n as f32 * width));
    }
    for n in [-0.5, 0.5] {
        gold.append(
            &bar,
            turned_at(90.0, Vec3::new(n * width * 1.2, INGOT_HEIGHT, 0.0)),
        );
    }
    gold.append(
        &bar,
        turned_at(8.0, Vec3::new(0.0, INGOT_HEIGHT * 2.0, 0.0)),
    );
    // Two stacks in front; each coin is a little off the one below.
    let mut dice = super::noise::Dice::new(11);
    for (x, count) in [(0.17, 7), (-0.16, 4)] {
        for n in 0..count {
            let (dx, dz) = (dice.range(-0.008, 0.008), dice.range(-0.008, 0.008));
            let place = Vec3::new(x + dx, n as f32 * COIN_HEIGHT, 0.45 + dz);
            gold.append(&coin, turned_at(dice.range(0.0, 360.0), place));
        }
    }
    // One leans against the taller stack.
    let lean = Quat::from_rotation_y(0.35) * Quat::from_rotation_x(1.25);
    let foot = Vec3::new(-0.005, COIN_RADIUS * 0.97, 0.50);
    gold.append(&coin, Affine3A::from_rotation_translation(lean, foot));
    vec![part("gold", gold.placed(at(0.0, 0.0, -0.08)))]
}
