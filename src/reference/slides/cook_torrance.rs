//! What does the slides' Cook-Torrance listing compute?

#![allow(non_snake_case, reason = "the listing's own names, to the letter")]

use std::f64::consts::{E as e, PI as pi};

use glam::DVec3;

use super::{max, min, mix};

/// The listing's `CookTorrance`: holds the cosine to the light. NaN or infinite where a divisor is 0.
pub fn cook_torrance(N: DVec3, L: DVec3, E: DVec3, Roughness: f64, FresnelScale: f64) -> f64 {
    let NdL = max(0.0, N.dot(L));
    let NdE = max(0.0, N.dot(E));
    let R2 = Roughness * Roughness;
    let H = (L + E) / (L + E).length();
    let HdE = H.dot(E);

    let NdH = max(0.0, N.dot(H));
    let NdH2 = NdH * NdH;

    let exponent = -(1.0 - NdH2) / (NdH2 * R2);
    let D = e.powf(exponent) / (R2 * NdH2 * NdH2);

    let F = mix((1.0 - HdE).powf(5.0), 1.0, FresnelScale);

    let X = 2.0 * NdH / E.dot(H);
    let G = min(1.0, min(X * NdL, X * NdE));

    max((D * G * F) / (NdE * pi), 0.0)
}
