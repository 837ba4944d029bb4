//! What are the matte lobes at three vectors of 32 bits exactly as they are?
//!
//! All are pi f cos(theta_l), the albedo included.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Given;
use crate::reference::eon;

/// `lambert::lobe`.
pub fn lambert(at: &Given) -> f64 {
    at.nol.max(0.0)
}

/// `fujii::lobe` of albedo 1. The eye may be below the surface.
pub fn fujii(at: &Given, roughness: f64) -> f64 {
    let (plain, turned) = fujii_parts(at, roughness);
    (plain + turned).max(0.0)
}

/// The same without the sign of the part that turns with s.
pub fn fujii_terms(at: &Given, roughness: f64) -> f64 {
    let (plain, turned) = fujii_parts(at, roughness);
    plain + turned.abs()
}

fn fujii_parts(at: &Given, roughness: f64) -> (f64, f64) {
    if at.nol <= 0.0 {
        return (0.0, 0.0);
    }
    let a = 1.0 / (1.0 + C1 * roughness);
    let t = if at.s > 0.0 { at.nol.max(at.noe) } else { 1.0 };
    // Vectors of 32 bits may be longer than 1, and s below -1: no lobe is meant to be negative there.
    (a * at.nol, a * roughness * at.s.max(-1.0) * (at.nol / t))
}

/// 1/2 - 2/(3 pi).
const C1: f64 = 0.5 - 2.0 / (3.0 * PI);
/// 2/3 - 28/(15 pi).
const C2: f64 = 2.0 / 3.0 - 28.0 / (15.0 * PI);

/// `eon::lobe`.
pub fn eon(at: &Given, roughness: f64, albedo: f64) -> f64 {
    albedo * fujii(at, roughness) + eon_bounced(at, roughness, albedo)
}

/// The same without a sign.
pub fn eon_terms(at: &Given, roughness: f64, albedo: f64) -> f64 {
    albedo * fujii_terms(at, roughness) + eon_bounced(at, roughness, albedo)
}

fn eon_bounced(at: &Given, roughness: f64, albedo: f64) -> f64 {
    if at.nol <= 0.0 {
        return 0.0;
    }
    let a = 1.0 / (1.0 + C1 * roughness);
    let mean = a * (1.0 + C2 * roughness);
    let lost = a * (C1 - C2) * roughness;
    let again = albedo * albedo * mean / (1.0 - albedo * lost);
    let missing = |cosine: f64| eon::missing(roughness, cosine.clamp(0.0, 1.0));
    match lost > 0.0 {
        true => again * missing(at.nol) * missing(at.noe) / lost * at.nol,
        false => 0.0,
    }
}

/// `full_oren_nayar::lobe`; 0 where the model falls below it. An eye below the surface is taken for one on it.
pub fn full_oren_nayar(at: &Given, sigma: f64, albedo: f64) -> f64 {
    let [plain, aside, between, second] = full_parts(at, sigma);
    at.nol.max(0.0) * albedo * (plain + aside + between + albedo * second).max(0.0)
}

/// The same without signs.
pub fn full_oren_nayar_terms(at: &Given, sigma: f64, albedo: f64) -> f64 {
    let [plain, aside, between, second] = full_parts(at, sigma);
    at.nol.max(0.0) * albedo * (plain + aside.abs() + between + albedo * second)
}

/// C1, the terms of C2 and C3, and the interreflection over the albedo.
fn full_parts(at: &Given, sigma: f64) -> [f64; 4] {
    let sigma2 = sigma * sigma;
    let low = at.nol.min(at.noe).clamp(0.0, 1.0);
    let high = at.nol.max(at.noe).clamp(f64::MIN_POSITIVE, 1.0);
    let sine = |c: f64| ((1.0 - c) * (1.0 + c)).sqrt();
    let (sin_a, sin_b) = (sine(low), sine(high));
    // Angles from the surface, over a right angle: what is small is small without a difference.
    let (up_a, up_b) = (low.asin() / FRAC_PI_2, high.asin() / FRAC_PI_2);
    let beta = 1.0 - up_b;
    let sines = (sin_a * sin_b).max(f64::MIN_POSITIVE);
    let cos_phi = (at.s / sines).clamp(-1.0, 1.0);
    let sin_phi = (at.triple / sines).clamp(-1.0, 1.0);
    // 1 - |cos|
    let off_plane = sin_phi * sin_phi / (1.0 + cos_phi.abs());
    // sin(alpha) - beta^3
    let short = up_b * (3.0 - 3.0 * up_b + up_b * up_b) - low * low / (1.0 + sin_a);
    let away = match at.s < 0.0 && sin_a > 0.0 {
        true => short / sin_a,
        false => 1.0,
    };
    let k = 0.45 * sigma2 / (sigma2 + 0.09);
    let c3 = 0.125 * sigma2 / (sigma2 + 0.09) * ((1.0 - up_a) * beta).powi(2);
    [
        1.0 - 0.5 * sigma2 / (sigma2 + 0.33),
        k * at.s / high * away,
        off_plane * c3 * (sin_a + sin_b) / (low + high),
        0.17 * sigma2 / (sigma2 + 0.13) * (1.0 - cos_phi * beta * beta),
    ]
}
