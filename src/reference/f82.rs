//! How does a metal's colour dip before grazing? Schlick, and a dip of given depth at 82 degrees (Kutz, Hasan and Edmondson 2021).

use glam::DVec3;

use super::schlick;

/// The cosine of 81.8 degrees, at which the dip is deepest.
pub const COSINE: f64 = 1.0 / 7.0;

/// F - a mu (1 - mu)^6 with F Schlick's, and a such that at `COSINE` it is `tint` (0..1) times Schlick's; at least 0.
pub fn f(f0: DVec3, tint: DVec3, mu: f64) -> DVec3 {
    let term = |mu: f64| mu * (1.0 - mu).powi(6);
    let depth = schlick::f(f0, COSINE) * (DVec3::ONE - tint) / term(COSINE);
    (schlick::f(f0, mu) - depth * term(mu.clamp(0.0, 1.0))).max(DVec3::ZERO)
}
