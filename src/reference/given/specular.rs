//! What are the lobes of facets at three vectors of 32 bits exactly as they are?
//!
//! All are f cos(theta_l) of one channel under Schlick's Fresnel term, 0 for a light or an eye at or below the surface; the width
//! (Beckmann's m, GGX's alpha) is above 0.

use std::f64::consts::PI;

use super::{Given, beckmann_d, schlick_f};
use crate::reference::ggx_missing::GgxMissing;
use crate::reference::{beckmann_smith, kulla_conty};

/// `blinn_phong::lobe`.
pub fn blinn_phong(at: &Given, m: f64, f0: f64) -> f64 {
    if at.least_cosine() <= 0.0 {
        return 0.0;
    }
    let n = (2.0 / (m * m) - 2.0).max(0.0);
    let tan2 = at.sine2 / (at.noh * at.noh);
    (n + 8.0) / (8.0 * PI) * (-0.5 * n * tan2.ln_1p()).exp() * at.nol * schlick_f(at, f0)
}

/// `beckmann_smith::lobe`, with Smith's function as it is.
pub fn beckmann_smith(at: &Given, m: f64, f0: f64) -> f64 {
    smith(at, m, f0, beckmann_smith::lambda)
}

/// The same with its rational form.
pub fn beckmann_smith_rational(at: &Given, m: f64, f0: f64) -> f64 {
    smith(at, m, f0, beckmann_smith::lambda_rational)
}

fn smith(at: &Given, m: f64, f0: f64, lambda: fn(f64, f64) -> f64) -> f64 {
    if at.least_cosine() <= 0.0 {
        return 0.0;
    }
    let g2 = 1.0 / (1.0 + lambda(at.nol, m) + lambda(at.noe, m));
    beckmann_d(at, m) * g2 * schlick_f(at, f0) / (4.0 * at.noe)
}

/// `ggx::lobe`.
pub fn ggx(at: &Given, alpha: f64, f0: f64) -> f64 {
    if at.least_cosine() <= 0.0 {
        return 0.0;
    }
    let alpha2 = alpha * alpha;
    let width = at.sine2 + alpha2 * at.noh * at.noh;
    let d = alpha2 * at.hh * at.hh / (PI * width * width);
    let seen = |c: f64| (alpha2 + (1.0 - alpha2) * c * c).sqrt();
    let v = 0.5 / (at.nol * seen(at.noe) + at.noe * seen(at.nol));
    d * v * at.nol * schlick_f(at, f0)
}

/// `ggx::lobe` and `kulla_conty::lobe` under Schlick's Fresnel term, f90 = min(1, 50 f0).
pub fn ggx_multi(at: &Given, alpha: f64, f0: f64) -> f64 {
    if at.least_cosine() <= 0.0 {
        return 0.0;
    }
    let f90 = (50.0 * f0).min(1.0);
    let mean = glam::DVec3::splat(f0 + (f90 - f0) / 21.0);
    let missing = GgxMissing::new(alpha);
    let scale = kulla_conty::scale(missing.mean(), mean).x;
    ggx(at, alpha, f0) + kulla_conty::between(&missing, at.nol, at.noe) * scale
}
