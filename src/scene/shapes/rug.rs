//! What says carpet without a word? A half-rolled rug of tufts, with a pattern and a fringe.

use std::f32::consts::TAU;

use glam::{Affine3A, Mat3A, Vec2, Vec3};

use super::loft::{Ends, curve3, loft, sweep};
use super::noise::Dice;
use super::surface::Surface;
use super::{Part, part};

const HALF_WIDTH: f32 = 0.38;
/// Distance between tufts, and the length of their yarn: a hand-knotted rug at a scale of 4.
const KNOT: f32 = 0.0185;
const PILE: f32 = 0.026;
/// Thickness of the woven ground that holds the knots.
const GROUND: f32 = 0.012;
/// The roll's outer radius and its middle (y, z).
const ROLL: f32 = 0.235;
const MIDDLE: Vec2 = Vec2::new(0.272, -0.20);
/// Where the sheet leaves the roll, as an angle from +z towards +y.
const LEAVE: f32 = 0.80;
const TURNS: f32 = 2.6;

/// The rug's side view: points along it, evenly spaced, and the first one of the outer turn.
struct Course {
    points: Vec<Vec3>,
    spacing: f32,
    outer: usize,
}

/// A point on the spiral: `turn` is 0 where the sheet leaves.
fn spiral(turn: f32) -> Vec3 {
    let angle = LEAVE + turn * TAU;
    // Each turn lies one layer further in: ground, pile and a little air.
    let radius = ROLL - turn * (GROUND + PILE + 0.012);
    Vec3::new(
        0.0,
        MIDDLE.x + radius * angle.sin(),
        MIDDLE.y + radius * angle.cos(),
    )
}

fn course() -> Course {
    let mut dense: Vec<Vec3> = (0..=260)
        .map(|n| spiral(TURNS * (1.0 - n as f32 / 260.0)))
        .collect();
    let outer_at = dense.len() - 1 - (260.0 / TURNS) as usize;
    let outer_point = dense[outer_at];
    // From the roll in a sagging curve to the ground, and a hand's breadth along it.
    let start = spiral(0.0);
    let slope = Vec3::new(0.0, -LEAVE.cos(), LEAVE.sin());
    let foot = Vec3::new(0.0, GROUND, 0.40);
    let (b, c) = (start + slope * 0.26, foot - Vec3::Z * 0.17);
    for n in 1..=120 {
        let t = n as f32 / 120.0;
        let (ab, bc, cd) = (start.lerp(b, t), b.lerp(c, t), c.lerp(foot, t));
        dense.push(ab.lerp(bc, t).lerp(bc.lerp(cd, t), t));
    }
    resample(&dense, outer_point)
}

fn resample(dense: &[Vec3], outer_point: Vec3) -> Course {
    let length: f32 = dense.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let count = (length / KNOT).round();
    let spacing = length / count;
    let mut points = vec![dense[0]];
    let (mut walked, mut outer) = (0.0, 0);
    for pair in dense.windows(2) {
        let step = pair[0].distance(pair[1]);
        while walked + step >= points.len() as f32 * spacing {
            let t = (points.len() as f32 * spacing - walked) / step;
            points.push(pair[0].lerp(pair[1], t));
        }
        walked += step;
        if pair[1] == outer_point {
            outer = points.len();
        }
    }
    Course {
        points,
        spacing,
        outer,
    }
}

impl Course {
    fn along(&self, i: usize) -> Vec3 {
        let last = self.points.len() - 1;
        (self.points[(i + 1).min(last)] - self.points[i.saturating_sub(1)]).normalize()
    }

    /// The side that bears the pile.
    fn up(&self, i: usize) -> Vec3 {
        self.along(i).cross(Vec3::X)
    }
}

fn ground(course: &Course) -> Surface {
    let cross_section = |i: usize| -> Vec<Vec3> {
        let (p, down) = (course.points[i], course.up(i) * -GROUND);
        let side = Vec3::X * (HALF_WIDTH + 0.006);
        vec![p + side + down, p + side, p - side, p - side + down]
    };
    let loops: Vec<_> = (0..course.points.len()).map(cross_section).collect();
    loft(&loops, Ends::Capped).shade(50.0)
}

/// One tuft around +y: a three-sided bud of yarn, 9 triangles, with the normals of a round one.
fn tuft() -> Surface {
    let mut surface = Surface::default();
    for (height, radius, rise) in [(-0.1, 0.45, 0.0), (0.62, 0.80, 0.3)] {
        for side in 0..3 {
            let angle = TAU * side as f32 / 3.0;
            let out = Vec3::new(angle.cos(), 0.0, -angle.sin());
            let normal = (out + Vec3::Y * rise).normalize();
            surface.vertex(out * (radius * KNOT) + Vec3::Y * (height * PILE), normal);
        }
    }
    let tip = surface.vertex(Vec3::Y * PILE, Vec3::Y);
    for a in 0..3 {
        let b = (a + 1) % 3;
        let faces = [a, b, b + 3, a, b + 3, a + 3, a + 3, b + 3, tip];
        surface.indices.extend(faces);
    }
    surface
}

/// Which yarn is knotted at `x` across and `v` along from the front edge: 0 field, 1 motif, 2 border.
fn yarn(x: f32, v: f32) -> usize {
    let edge = (HALF_WIDTH - x.abs()).min(v);
    if edge < 0.085 {
        return if (0.030..0.052).contains(&edge) { 1 } else { 2 };
    }
    let period = 0.36;
    let from_centre = (((v - 0.085) / period).fract() - 0.5).abs() * period;
    let diamond = x.abs() / 0.29 + from_centre / 0.18;
    match diamond {
        d if d < 0.22 => 1,
        d if d < 0.42 => 2,
        d if (0.62..0.82).contains(&d) => 1,
        // Small lozenges fill the corners between the large ones.
        _ if (x.abs() - 0.29).abs() / 0.05 + (from_centre - 0.18).abs() / 0.05 < 1.3 => 1,
        _ => 0,
    }
}

fn pile(course: &Course) -> [Surface; 3] {
    let tuft = tuft();
    let mut dice = Dice::new(61);
    let mut yarns: [Surface; 3] = Default::default();
    let last = course.points.len() - 1;
    let columns = (HALF_WIDTH / KNOT) as i32;
    for i in 0..=last {
        let v = (last - i) as f32 * course.spacing;
        for column in -columns..=columns {
            // Of the inner turns only the selvage can be seen.
            if i < course.outer && column.abs() < columns - 1 {
                continue;
            }
            let x = column as f32 * KNOT;
            let jitter = Vec3::new(dice.range(-0.3, 0.3), 0.0, dice.range(-0.3, 0.3)) * KNOT;
            let lean = Vec3::new(dice.range(-0.35, 0.35), 1.0, dice.range(-0.1, 0.5));
            let (turn, size) = (dice.range(0.0, TAU), dice.range(0.88, 1.12));
            let frame =
                Mat3A::from_cols(Vec3::X.into(), course.up(i).into(), course.along(i).into());
            let tilt =
                Affine3A::from_quat(glam::Quat::from_rotation_arc(Vec3::Y, lean.normalize()));
            let seat =
                course.points[i] + Vec3::X * x + Vec3::from(frame * glam::Vec3A::from(jitter));
            let place = Affine3A {
                matrix3: frame,
                translation: seat.into(),
            } * tilt
                * Affine3A::from_rotation_y(turn)
                * Affine3A::from_scale(Vec3::splat(size));
            yarns[yarn(x, v)].append(&tuft, place);
        }
    }
    yarns
}

/// Knotted tassels along the front edge.
fn fringe() -> Surface {
    let mut dice = Dice::new(71);
    let mut surface = Surface::default();
    let count = 30;
    for n in 0..count {
        let x = HALF_WIDTH * (2.0 * (n as f32 + 0.5) / count as f32 - 1.0);
        let (sway, reach) = (dice.range(-0.02, 0.02), dice.range(0.085, 0.11));
        let path = curve3(
            &[
                Vec3::new(x, 0.016, 0.395),
                Vec3::new(x + sway * 0.2, 0.022, 0.415),
                Vec3::new(x + sway * 0.6, 0.012, 0.40 + reach * 0.6),
                Vec3::new(x + sway, 0.009, 0.40 + reach),
            ],
            3,
        );
        // A knot near the rug, then threads that spread.
        let width = |t: f32| {
            Vec2::new(1.0, 0.8)
                * (0.0045 + 0.0045 * (1.0 - ((t - 0.3) * 6.0).abs()).max(0.0) + 0.003 * t)
        };
        surface.append(&sweep(&path, 6, width).shade(70.0), Affine3A::IDENTITY);
    }
    surface
}

pub fn rug() -> Vec<Part> {
    let course = course();
    let [field, motif, border] = pile(&course);
    vec![
        part("pile", field),
        part("pattern", motif),
        part("border", border),
        part("backing", ground(&course)),
        part("fringe", fringe()),
    ]
}
