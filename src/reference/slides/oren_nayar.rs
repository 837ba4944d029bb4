//! What does the slides' Oren-Nayar listing compute?

#![allow(non_snake_case, reason = "the listing's own names, to the letter")]

use glam::DVec3;

use super::{max, min};

/// The listing's `OrenNayar`: holds the cosine to the light, not albedo / pi. NaN where L or E is N.
pub fn oren_nayar(N: DVec3, L: DVec3, E: DVec3, Roughness: f64) -> f64 {
    let NdL = max(0.0, N.dot(L));
    let NdE = max(0.0, N.dot(E));

    let R2 = Roughness * Roughness;

    let A = 1.0 - 0.5 * R2 / (R2 + 0.33);
    let B = 0.45 * R2 / (R2 + 0.09);

    let lightProjected = (L - N * NdL) / (L - N * NdL).length();
    let viewProjected = (E - N * NdE) / (E - N * NdE).length();
    let CX = max(0.0, lightProjected.dot(viewProjected));

    let alpha = max(NdE.acos(), NdL.acos()).sin();
    let beta = min(NdE.acos(), NdL.acos()).tan();
    let DX = alpha * beta;

    NdL * (A + B * CX * DX)
}
