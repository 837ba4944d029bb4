//! How many facets face a half vector? Beckmann and Spizzichino 1963.

use std::f64::consts::PI;

use glam::DVec3;

use crate::math::frame::angle;

/// The least roughness that is evaluated: the shader's 32 bits change D by 8e-7 / m of itself.
pub const M_MIN: f64 = 1.0e-3;

/// exp(-tan^2 / m^2) / (pi m^2 cos^4), per steradian: its integral against the cosine is 1. m > 0; h unit.
pub fn d(n: DVec3, h: DVec3, m: f64) -> f64 {
    let theta = angle(n, h);
    if theta.cos() <= 0.0 {
        return 0.0;
    }
    (-(theta.tan() / m).powi(2)).exp() / (PI * m * m * theta.cos().powi(4))
}

/// The roughness that a surface of roughness `m` shows under a uniform disc of `angular_radius` (radians, small).
///
/// Slope variances per axis add: m^2/2 of the facets, and of the disc r^2/4 in angle, so r^2/16 for the half
/// vector, which turns half as far.
pub fn under_disc(m: f64, angular_radius: f64) -> f64 {
    let slope_variance = m * m / 2.0 + angular_radius * angular_radius / 16.0;
    (2.0 * slope_variance).sqrt().max(M_MIN)
}
