//! How does a rough matte surface scatter that loses no light? Portsmouth, Kutz and Hill 2025 (EON).

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::fujii;

/// <E> = (1 + C2 r) / (1 + C1 r) is the mean of Fujii's directional albedo over the cosine.
pub const C2: f64 = 2.0 / 3.0 - 28.0 / (15.0 * PI);

/// 1 - E(mu) of Fujii's lobe, without the cancellation that 1 - `fujii::albedo` has near grazing; mu 0..1.
pub fn missing(roughness: f64, mu: f64) -> f64 {
    let s = ((1.0 - mu) * (1.0 + mu)).sqrt();
    let q = (1.0 + s + s * s) / (1.0 + s);
    let edge = (FRAC_PI_2 - 2.0 / 3.0) * mu * mu / (1.0 + s);
    let k = (edge + s * mu.asin() + s * mu * (s - 2.0 * q / 3.0)) / PI;
    roughness * k / (1.0 + fujii::C1 * roughness)
}

/// pi f cos(theta_l), the albedo included: Fujii's lobe, and (1 - E(l)) (1 - E(e)) / (1 - <E>) of the albedo that several bounces
/// leave, rho^2 <E> / (1 - rho (1 - <E>)). Roughness and albedo 0..1.
pub fn lobe(n: DVec3, l: DVec3, e: DVec3, roughness: f64, albedo: f64) -> f64 {
    let (nl, ne) = (n.dot(l), n.dot(e));
    if nl <= 0.0 {
        return 0.0;
    }
    let mean = (1.0 + C2 * roughness) / (1.0 + fujii::C1 * roughness);
    let once = albedo * fujii::lobe(n, l, e, roughness);
    if roughness == 0.0 {
        return once;
    }
    let again = albedo * albedo * mean / (1.0 - albedo * (1.0 - mean));
    let of = |cosine: f64| missing(roughness, cosine.clamp(0.0, 1.0));
    once + again * of(nl) * of(ne) / (1.0 - mean) * nl
}
