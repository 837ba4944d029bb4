//! How far is a point from a soft form, and how do such forms melt together?
//!
//! Distances are negative inside. Blends and ellipsoids are bounds rather than exact
//! distances, off by little near the surface, which is all that meshing asks.

use glam::Vec3;

/// A sphere.
pub fn ball(p: Vec3, centre: Vec3, radius: f32) -> f32 {
    p.distance(centre) - radius
}

/// An ellipsoid along the axes: first-order distance, value over gradient (I. Quilez).
pub fn ellipsoid(p: Vec3, centre: Vec3, radii: Vec3) -> f32 {
    let q = (p - centre) / radii;
    let slope = (q / radii).length();
    // At the very centre the gradient vanishes; the smallest radius is the distance there.
    if slope < 1e-6 {
        -radii.min_element()
    } else {
        q.length() * (q.length() - 1.0) / slope
    }
}

/// A segment from `a` to `b` whose radius goes from `ra` to `rb`.
pub fn limb(p: Vec3, a: Vec3, b: Vec3, ra: f32, rb: f32) -> f32 {
    let along = b - a;
    let t = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    p.distance(a + along * t) - (ra + (rb - ra) * t)
}

/// Union with a fillet: `soft` is the distance below which the two forms melt (polynomial).
pub fn join(a: f32, b: f32, soft: f32) -> f32 {
    let overlap = (soft - (a - b).abs()).max(0.0) / soft;
    a.min(b) - overlap * overlap * soft * 0.25
}

/// `a` without `b`, the edge rounded over `soft`.
pub fn carve(a: f32, b: f32, soft: f32) -> f32 {
    -join(-a, b, soft)
}

/// A roll of clay: from (x, y, z) to (x, y, z), the radii at both ends, the width of its blend.
pub type Roll = [f32; 9];

/// The distance from a roll.
pub fn roll(p: Vec3, r: &Roll) -> f32 {
    let (a, b) = (Vec3::new(r[0], r[1], r[2]), Vec3::new(r[3], r[4], r[5]));
    limb(p, a, b, r[6], r[7])
}

/// Presses `rolls` onto a form, one after the other.
pub fn add(p: Vec3, form: f32, rolls: &[Roll]) -> f32 {
    rolls.iter().fold(form, |d, r| join(d, roll(p, r), r[8]))
}
