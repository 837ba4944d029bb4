//! How do facets that are small mirrors reflect? Cook and Torrance 1982, rightly normalised.

use glam::DVec3;

use super::{beckmann, schlick, v_cavity};

/// f cos(theta_l) with f = D F G / (4 cos(theta_l) cos(theta_e)). `m` > 0; f0 per channel, 0..1.
///
/// 0 for a light or an eye at or below the surface.
pub fn lobe(n: DVec3, l: DVec3, e: DVec3, m: f64, f0: DVec3) -> DVec3 {
    if n.dot(l) <= 0.0 || n.dot(e) <= 0.0 {
        return DVec3::ZERO;
    }
    let h = (l + e).normalize();
    let d = beckmann::d(n, h, m);
    let g = v_cavity::g(n, l, e);
    let f = schlick::f(f0, l.dot(h));
    f * (d * g / (4.0 * n.dot(l) * n.dot(e))) * n.dot(l)
}
