//! How does a rough matte surface scatter, one bounce between its facets included? Oren and Nayar 1994, eq. 27 and 28.

use std::f64::consts::PI;

use glam::DVec3;

use crate::math::frame::{Frame, angle};

/// pi f cos(theta_l), the albedo included; sigma in radians, 0..1. 0 where the model of a dark rough surface falls below 0 (both near
/// grazing, away from each other). An eye below the surface is taken for one on it.
pub fn lobe(n: DVec3, l: DVec3, e: DVec3, sigma: f64, albedo: f64) -> f64 {
    if n.dot(l) <= 0.0 {
        return 0.0;
    }
    let right = 0.5 * PI;
    let (theta_l, theta_e) = (angle(n, l), angle(n, e).min(right));
    let (alpha, beta) = (theta_l.max(theta_e), theta_l.min(theta_e));
    let cos_phi = Frame::facing(n, l).tangent.dot(Frame::facing(n, e).tangent);
    let sigma2 = sigma * sigma;
    let c1 = 1.0 - 0.5 * sigma2 / (sigma2 + 0.33);
    let c2 = 0.45 * sigma2 / (sigma2 + 0.09)
        * match cos_phi >= 0.0 {
            true => alpha.sin(),
            false => alpha.sin() - (2.0 * beta / PI).powi(3),
        };
    let c3 = 0.125 * sigma2 / (sigma2 + 0.09) * (4.0 * alpha * beta / (PI * PI)).powi(2);
    let once =
        c1 + cos_phi * c2 * beta.tan() + (1.0 - cos_phi.abs()) * c3 * (0.5 * (alpha + beta)).tan();
    let twice = 0.17 * sigma2 / (sigma2 + 0.13) * (1.0 - cos_phi * (2.0 * beta / PI).powi(2));
    theta_l.cos() * albedo * (once + albedo * twice).max(0.0)
}
