//! What are the Fresnel terms at the half vector of two vectors of 32 bits exactly as they are?

use super::{Given, schlick_f};

/// Cosine between light and facet, and 1 less it.
fn cosine(at: &Given) -> (f64, f64) {
    let mu = 0.5 * at.hh.sqrt();
    (mu, 0.25 * at.difference2 / (1.0 + mu))
}

/// `f82::f` of one channel, f90 = min(1, 50 f0); 0 where it falls below.
pub fn f82(at: &Given, f0: f64, tint: f64) -> f64 {
    (schlick_f(at, f0) - f82_dip(at, f0, tint)).max(0.0)
}

/// The same without signs.
pub fn f82_terms(at: &Given, f0: f64, tint: f64) -> f64 {
    schlick_f(at, f0) + f82_dip(at, f0, tint)
}

fn f82_dip(at: &Given, f0: f64, tint: f64) -> f64 {
    let (mu, rest) = cosine(at);
    let f90 = (50.0 * f0).min(1.0);
    let (c, d) = (1.0_f64 / 7.0, 6.0_f64 / 7.0);
    let largest = (f0 + (f90 - f0) * d.powi(5)) * (1.0 - tint) / (c * d.powi(6));
    largest * mu * rest.powi(6)
}

/// `dielectric::f` of an index with that f0.
pub fn dielectric(at: &Given, f0: f64) -> f64 {
    let (mu, _) = cosine(at);
    if f0 == 0.0 {
        return 0.0;
    }
    // At grazing every interface is a mirror.
    if mu == 0.0 {
        return 1.0;
    }
    let r = f0.sqrt();
    let (p, q) = (1.0 + r, 1.0 - r);
    let g = (4.0 * r + (q * mu).powi(2)).sqrt();
    let s = 4.0 * r / (q * mu + g).powi(2);
    let parallel = 4.0 * r * ((p * p + q * q) * mu * mu - q * q) / (p * p * mu + q * g).powi(2);
    0.5 * (s * s + parallel * parallel)
}

/// `conductor::f` at one wavelength.
pub fn conductor(at: &Given, n: f64, k: f64) -> f64 {
    let (mu, rest) = cosine(at);
    let sine2 = rest * (1.0 + mu);
    let t = n * n - k * k - sine2;
    let root = t.hypot(2.0 * n * k);
    let larger = 0.5 * (root + t.abs());
    // Both are 0 at the angle of total reflection of an index without absorption.
    let smaller = (n * k).powi(2) / larger.max(f64::MIN_POSITIVE);
    let (a2, b2) = if t >= 0.0 {
        (larger, smaller)
    } else {
        (smaller, larger)
    };
    let a = a2.sqrt();
    let s = ((a - mu).powi(2) + b2) / ((a + mu).powi(2) + b2);
    let far = b2 * mu * mu;
    let p = s * ((a * mu - sine2).powi(2) + far) / ((a * mu + sine2).powi(2) + far);
    0.5 * (s + p)
}

/// `spectral::f` of one channel, f90 = min(1, 50 f0).
pub fn spectral(at: &Given, f0: f64, c: [f64; 4]) -> f64 {
    let terms: f64 = spectral_parts(at, c).iter().sum();
    (schlick_f(at, f0) + terms).max(0.0)
}

/// The same without signs.
pub fn spectral_terms(at: &Given, f0: f64, c: [f64; 4]) -> f64 {
    let terms: f64 = spectral_parts(at, c).iter().map(|term| term.abs()).sum();
    schlick_f(at, f0) + terms
}

fn spectral_parts(at: &Given, c: [f64; 4]) -> [f64; 4] {
    let (mu, x) = cosine(at);
    [
        mu * c[0] * x.powi(6),
        mu * c[1] * x * x,
        mu * c[2] * x.powi(14),
        mu * c[3] * x.powi(30),
    ]
}
