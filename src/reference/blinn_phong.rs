//! How does a glossy surface reflect by a power of a cosine? Blinn 1977, normalised.

use std::f64::consts::PI;

use glam::DVec3;

/// The exponent whose highlight is as wide as Beckmann's of roughness m: 2 / m^2 - 2, at least 0.
pub fn exponent(m: f64) -> f64 {
    (2.0 / (m * m) - 2.0).max(0.0)
}

/// f cos(theta_l) / F = (n + 8) / (8 pi) (N.H)^n cos(theta_l). `m` > 0. 0 for a light or an eye at or below the surface.
pub fn lobe(n: DVec3, l: DVec3, e: DVec3, m: f64) -> f64 {
    if n.dot(l) <= 0.0 || n.dot(e) <= 0.0 {
        return 0.0;
    }
    let h = (l + e).normalize();
    let power = exponent(m);
    (power + 8.0) / (8.0 * PI) * n.dot(h).powf(power) * n.dot(l)
}
