//! How does a rough matte surface scatter without a dark ring? Fujii's improvement of the qualitative model of Oren and Nayar.
//!
//! mimosa-pudica.net/improved-oren-nayar.html.

use std::f64::consts::PI;

use glam::DVec3;

/// What roughness takes from the albedo at the normal.
pub const C1: f64 = 0.5 - 2.0 / (3.0 * PI);

/// pi f cos(theta_l) for albedo 1: cos(theta_l) (1 + r s / t) / (1 + C1 r), t the larger cosine where s > 0, else 1; roughness r 0..1.
///
/// 0 for a light at or below the surface. An eye below it is allowed (the silhouette of a smooth normal).
pub fn lobe(n: DVec3, l: DVec3, e: DVec3, roughness: f64) -> f64 {
    let (nl, ne) = (n.dot(l), n.dot(e));
    if nl <= 0.0 {
        return 0.0;
    }
    let s = l.dot(e) - nl * ne;
    let t = if s > 0.0 { nl.max(ne) } else { 1.0 };
    nl * (1.0 + roughness * s / t) / (1.0 + C1 * roughness)
}

/// The directional albedo of `lobe` for an eye (or a light) at `theta`, radians: Portsmouth, Kutz and Hill 2025, section 3.
pub fn albedo(roughness: f64, theta: f64) -> f64 {
    let (sine, mu) = theta.sin_cos();
    // tan(theta) (1 - sin^3) tends to 0 at grazing, where mu is 0.
    let rise = if mu > 0.0 {
        sine / mu * (1.0 - sine.powi(3))
    } else {
        0.0
    };
    let g = sine * (theta - sine * mu) + 2.0 / 3.0 * (rise - sine);
    (1.0 + roughness * g / PI) / (1.0 + C1 * roughness)
}
