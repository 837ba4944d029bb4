//! What do GGX facets lose that reflect once: by quadrature, and as a polynomial?

use std::f64::consts::PI;
use std::sync::LazyLock;

use super::ggx;
use crate::math::quadrature::{GaussLegendre, equal_breaks};

/// Directional albedo of `ggx::lobe` for F = 1: what one bounce gives back of the light from a direction with that cosine
/// (0 < mu <= 1), to 1e-6; `alpha` > 0.
///
/// By the facets' slopes r = alpha tan(t), of which sin(t)^2 is uniform over 0..1: E = 1/pi int G2 (e.h) / (e.n h.n) sin(2 t) dt dphi
/// over 0 <= phi <= pi, where for each phi the facets up to r = (s cos(phi) + sqrt((s cos(phi))^2 + mu^2)) / mu send light above the
/// surface.
pub fn albedo(mu: f64, alpha: f64) -> f64 {
    let sine = ((1.0 - mu) * (1.0 + mu)).max(0.0).sqrt();
    let of_eye = ggx::lambda(mu, alpha);
    let rule = &*RULE;
    let over_phi = rule.integrate(&equal_breaks(0.0, PI, PANELS), |phi| {
        let across = sine * phi.cos();
        let steepest = (across + across.hypot(mu)) / mu;
        let last = (steepest / alpha).atan();
        // Where the light sinks to the surface its shadowing has a root.
        let breaks = [0.0, 0.5, 0.9, 0.99, 0.999, 1.0].map(|share| share * last);
        rule.integrate(&breaks, |t| {
            let r = alpha * t.tan();
            // e.h / n.h, and n.l of the mirrored direction.
            let seen = mu + across * r;
            let light = 2.0 * seen / (1.0 + r * r) - mu;
            if light <= 0.0 {
                return 0.0;
            }
            let g2 = 1.0 / (1.0 + of_eye + ggx::lambda(light.min(1.0), alpha));
            g2 * seen / mu * (2.0 * t).sin()
        })
    });
    over_phi / PI
}

static RULE: LazyLock<GaussLegendre> = LazyLock::new(|| GaussLegendre::new(16));
/// Intervals around: 64 nodes.
const PANELS: usize = 4;

/// The least alpha that the polynomial holds for.
pub const ALPHA_MIN: f64 = 1.0e-3;

/// Terms in z.
pub const TERMS: usize = 8;

/// Of c_0 to c_7, rising powers of alpha - 1/2 each. How they were found stands in shaders-glsl/brdf/ggx_missing.glsl.
const TERM: [[f64; 6]; TERMS] = [
    [
        3.742353, 6.786085, -2.126815, -5.476212, 6.211835, -2.416939,
    ],
    [3.326287, -8.410924, -43.59609, 10.98941, 80.4234, -11.81922],
    [
        -6.826363, -29.19835, 69.9913, 267.3126, -145.1218, -557.9875,
    ],
    [18.96958, 117.9715, 72.22349, -427.9619, -170.8742, 669.5613],
    [
        -42.21682, -224.4113, -683.2833, -1003.707, 1517.156, 3474.775,
    ],
    [68.71148, 261.5037, 1360.949, 3876.951, -2702.211, -11191.96],
    [
        -63.52144, -188.4515, -1180.344, -4235.573, 1998.358, 11849.05,
    ],
    [24.18554, 65.2021, 389.3223, 1561.324, -538.5527, -4324.743],
];

/// Of the mean: rising powers of alpha - 1/2, and of alpha beside its logarithm.
const MEAN: [f64; 7] = [
    15.75679, 19.17741, -60.67771, -48.39753, 26.72551, -21.52054, 12.62672,
];
const MEAN_LOG: [f64; 3] = [-1.154015, 2.00304, 70.77567];

/// 1 - E of one alpha, within 1e-3.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct GgxMissing {
    bend: f64,
    terms: [f64; TERMS],
    mean: f64,
}

impl GgxMissing {
    /// For an alpha of at most 1; below `ALPHA_MIN` as that.
    pub fn new(alpha: f64) -> Self {
        let alpha = alpha.clamp(ALPHA_MIN, 1.0);
        let s = alpha - 0.5;
        let over = over(alpha);
        let mut terms = TERM.map(|powers| polynomial(&powers, s) * over);
        terms[0] *= alpha * alpha;
        terms[1] *= alpha;
        let mean = polynomial(&MEAN, s) + alpha.ln() * polynomial(&MEAN_LOG, alpha);
        Self {
            bend: bend(alpha),
            terms,
            mean: mean * alpha * alpha * over,
        }
    }

    /// 1 - E towards a direction with that cosine, 0 to 1.
    pub fn at(&self, mu: f64) -> f64 {
        let mu = mu.clamp(0.0, 1.0);
        let rest = mu * (1.0 + self.bend) / (mu + self.bend);
        rest * polynomial(&self.terms, z(mu, self.bend))
    }

    /// Its mean over the cosine, 2 int (1 - E) mu dmu.
    pub fn mean(&self) -> f64 {
        self.mean
    }
}

/// Where what is missing turns, from a line at grazing to a square.
pub fn bend(alpha: f64) -> f64 {
    1.6 * alpha / (1.0 + 9.0 * alpha * alpha)
}

/// 0 at the normal, 1 at grazing.
pub fn z(mu: f64, bend: f64) -> f64 {
    bend * (1.0 - mu) / (mu + bend)
}

/// What all terms are divided by, inverted.
pub fn over(alpha: f64) -> f64 {
    1.0 / (1.0 + 8.0 * alpha * alpha)
}

fn polynomial(powers: &[f64], x: f64) -> f64 {
    powers.iter().rev().fold(0.0, |sum, power| sum * x + power)
}
