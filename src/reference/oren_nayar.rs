//! How does a rough matte surface scatter? Oren and Nayar 1994, the qualitative model.

use glam::DVec3;

use crate::math::frame::{Frame, angle};

/// A and B of Oren and Nayar 1994, eq. 30. `sigma`: standard deviation of the facets' slope angle, radians, 0..1.
pub fn weights(sigma: f64) -> (f64, f64) {
    let sigma2 = sigma * sigma;
    (
        1.0 - 0.5 * sigma2 / (sigma2 + 0.33),
        0.45 * sigma2 / (sigma2 + 0.09),
    )
}

/// pi f cos(theta_l) for albedo 1: cos(theta_l) (A + B max(0, cos(phi_l - phi_e)) sin(alpha) tan(beta)).
///
/// 0 for a light at or below the surface. An eye below it is allowed (the silhouette of a smooth normal).
pub fn lobe(n: DVec3, l: DVec3, e: DVec3, sigma: f64) -> f64 {
    if n.dot(l) <= 0.0 {
        return 0.0;
    }
    let (a, b) = weights(sigma);
    let (theta_l, theta_e) = (angle(n, l), angle(n, e));
    let cos_phi = Frame::facing(n, l).tangent.dot(Frame::facing(n, e).tangent);
    let (alpha, beta) = (theta_l.max(theta_e), theta_l.min(theta_e));
    theta_l.cos() * (a + b * cos_phi.max(0.0) * alpha.sin() * beta.tan())
}

/// From this sigma on `lobe` gives back no more than it gets: A + B/2 = 1 where 0.275 sigma^2 = 0.02925.
pub const CONSERVES_FROM: f64 = 0.326_134_383_902_765_4;

/// The largest directional albedo of `lobe`, which it has at grazing: A + B/2. 1.01518 at sigma = 0.1985.
pub fn largest_albedo(sigma: f64) -> f64 {
    let (a, b) = weights(sigma);
    a + 0.5 * b
}

/// `lobe`, dimmed where it would give back more light than it gets (sigma below `CONSERVES_FROM`).
pub fn conserving_lobe(n: DVec3, l: DVec3, e: DVec3, sigma: f64) -> f64 {
    lobe(n, l, e, sigma) / largest_albedo(sigma).max(1.0)
}
