//! Where does the light go that bounces between mirror facets more than once? Kulla and Conty 2017, over GGX.

use std::f64::consts::PI;

use glam::DVec3;

use super::ggx_missing::GgxMissing;

/// f cos(theta_l) of several bounces; `mean`: of the Fresnel term over the cosine, per channel. 0 for a light or an eye at or below the
/// surface.
pub fn lobe(n: DVec3, l: DVec3, e: DVec3, alpha: f64, mean: DVec3) -> DVec3 {
    let (nl, ne) = (n.dot(l), n.dot(e));
    if nl <= 0.0 || ne <= 0.0 {
        return DVec3::ZERO;
    }
    let missing = GgxMissing::new(alpha);
    between(&missing, nl, ne) * scale(missing.mean(), mean)
}

/// For F = 1: (1 - E(l)) (1 - E(e)) / (pi (1 - <E>)) cos(theta_l).
pub fn between(missing: &GgxMissing, nl: f64, ne: f64) -> f64 {
    if missing.mean() < LEAST_MISSING {
        return 0.0;
    }
    missing.at(nl) * missing.at(ne) / (PI * missing.mean()) * nl
}

/// Less is lost to rounding as well.
const LEAST_MISSING: f64 = 1.0e-6;

/// F^2 <E> / (1 - F (1 - <E>)) for the mean Fresnel term F: what is left of it where facets do not reflect everything.
pub fn scale(missing: f64, mean: DVec3) -> DVec3 {
    mean * mean * (1.0 - missing) / (DVec3::ONE - mean * missing)
}
