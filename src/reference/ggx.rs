//! How do facets with a long tail of slopes reflect? Walter et al. 2007 (GGX), light and eye correlated by height (Heitz 2014).

use std::f64::consts::PI;

use glam::DVec3;

use crate::math::frame::angle;

/// Distribution per steradian: its integral against the cosine is 1. `alpha` > 0; h unit.
pub fn d(n: DVec3, h: DVec3, alpha: f64) -> f64 {
    let theta = angle(n, h);
    if theta.cos() <= 0.0 {
        return 0.0;
    }
    let slope2 = (theta.tan() / alpha).powi(2);
    1.0 / (PI * alpha * alpha * theta.cos().powi(4) * (1.0 + slope2).powi(2))
}

/// Smith's function of a direction with that cosine, 0 < cosine <= 1: the share of facets that are visible is 1 / (1 + lambda).
pub fn lambda(cosine: f64, alpha: f64) -> f64 {
    let tan2 = (1.0 - cosine) * (1.0 + cosine) / (cosine * cosine);
    0.5 * ((1.0 + alpha * alpha * tan2.max(0.0)).sqrt() - 1.0)
}

/// f cos(theta_l) / F = D G2 / (4 cos(theta_e)). 0 for a light or an eye at or below the surface.
pub fn lobe(n: DVec3, l: DVec3, e: DVec3, alpha: f64) -> f64 {
    let (nl, ne) = (n.dot(l), n.dot(e));
    if nl <= 0.0 || ne <= 0.0 {
        return 0.0;
    }
    let h = (l + e).normalize();
    let g2 = 1.0 / (1.0 + lambda(nl, alpha) + lambda(ne, alpha));
    d(n, h, alpha) * g2 / (4.0 * ne)
}
