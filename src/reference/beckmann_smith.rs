//! How do Beckmann's facets hide one another? Smith 1967, light and eye correlated by height (Heitz 2014, eq. 99).

use std::f64::consts::PI;

use glam::DVec3;

use super::beckmann;

/// Smith's function of a direction with that cosine, 0 < cosine <= 1: (erf(u) - 1) / 2 + exp(-u^2) / (2 u sqrt(pi)),
/// u = 1 / (m tan(theta)).
pub fn lambda(cosine: f64, m: f64) -> f64 {
    let u = over_slope(cosine, m);
    if u > FARTHEST {
        return 0.0;
    }
    0.5 * ((-u * u).exp() / (u * PI.sqrt()) - libm::erfc(u))
}

/// exp(-26^2) is the least normal f64: beyond, facets of that slope do not exist.
const FARTHEST: f64 = 26.0;

/// The rational form of Walter et al. 2007, section 5.2: 1 / G1 - 1, held at 0 where it falls below (by 6e-5, before it ends with a step).
pub fn lambda_rational(cosine: f64, m: f64) -> f64 {
    let u = over_slope(cosine, m);
    if u >= 1.6 {
        return 0.0;
    }
    ((1.0 - 1.259 * u + 0.396 * u * u) / (3.535 * u + 2.181 * u * u)).max(0.0)
}

fn over_slope(cosine: f64, m: f64) -> f64 {
    let sine2 = ((1.0 - cosine) * (1.0 + cosine)).max(0.0);
    cosine / (m * sine2.sqrt())
}

/// f cos(theta_l) / F = D G2 / (4 cos(theta_e)). `m` > 0. 0 for a light or an eye at or below the surface.
pub fn lobe(n: DVec3, l: DVec3, e: DVec3, m: f64) -> f64 {
    smith(n, l, e, m, lambda)
}

/// The same by the rational form.
pub fn rational_lobe(n: DVec3, l: DVec3, e: DVec3, m: f64) -> f64 {
    smith(n, l, e, m, lambda_rational)
}

fn smith(n: DVec3, l: DVec3, e: DVec3, m: f64, lambda: fn(f64, f64) -> f64) -> f64 {
    let (nl, ne) = (n.dot(l), n.dot(e));
    if nl <= 0.0 || ne <= 0.0 {
        return 0.0;
    }
    let h = (l + e).normalize();
    let g2 = 1.0 / (1.0 + lambda(nl, m) + lambda(ne, m));
    beckmann::d(n, h, m) * g2 / (4.0 * ne)
}
