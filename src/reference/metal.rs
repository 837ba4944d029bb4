//! What does a metal's interface have that a clear one has not?

use glam::DVec3;

/// Numbers of a metal per channel of linear sRGB, as the tiers of the Fresnel term take them.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Metal {
    /// Reflectance at normal incidence, integrated over wavelength. A channel may pass 1: gold's red lies outside sRGB.
    pub f0: DVec3,
    /// Reflectance at 82 degrees over Schlick's, 0..1.
    pub tint: DVec3,
    /// Index of refraction at 610, 549 and 468 nm, which stand for the channels.
    pub n: DVec3,
    /// Extinction there.
    pub k: DVec3,
    /// Of the spectral fit (`spectral`).
    pub coefficients: [DVec3; 4],
}

impl Metal {
    /// What a clear interface is taken for: Schlick's curve, and the index that has this f0, at most 100.
    pub fn clear(f0: DVec3) -> Self {
        let root = f0.map(f64::sqrt);
        Self {
            f0,
            tint: DVec3::ONE,
            n: ((DVec3::ONE + root) / (DVec3::ONE - root)).min(DVec3::splat(LARGEST_INDEX)),
            k: DVec3::ZERO,
            coefficients: [DVec3::ZERO; 4],
        }
    }
}

/// F = 0.96 at the normal; no clear stuff is near it.
const LARGEST_INDEX: f64 = 100.0;
