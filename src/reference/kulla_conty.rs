//! Where does the light go that bounces between mirror facets more than once? Kulla and Conty 2017, over GGX.

use std::f64::consts::PI;
use std::sync::LazyLock;

use glam::DVec3;

use super::ggx;
use crate::math::quadrature::{GaussLegendre, equal_breaks};

/// Directional albedo of `ggx::lobe` for F = 1: what one bounce gives back of the light from a direction with that cosine
/// (0 < mu <= 1), to 1e-5; `alpha` > 0.
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
        rule.integrate(&equal_breaks(0.0, last, PANELS), |t| {
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
/// Intervals of each integral: 64 nodes.
const PANELS: usize = 4;

/// Columns of the table, equally spaced in v = sqrt(1 - w), w = sqrt(alpha (1 - mu) / (mu + alpha)): 0 at grazing, 1 at the normal.
/// What is missing is a function of mu / alpha near grazing, rises there almost with its root, and far from it falls with its square.
pub const COLUMNS: usize = 55;
/// Rows of the table, equally spaced in the cube root of alpha.
pub const ROWS: usize = 64;

/// 1 - E for F = 1 over alpha and v, and for each row its mean over the cosine, over alpha^2 (1 - ln alpha). Between its nodes it is linear.
#[derive(Clone, PartialEq, Debug)]
pub struct Table {
    /// Row by row: `COLUMNS` values and the mean.
    values: Vec<f32>,
}

/// Numbers of a row.
const STRIDE: usize = COLUMNS + 1;

/// Numbers of the table.
pub const NUMBERS: usize = ROWS * STRIDE;

/// The least alpha that is looked up, as that of frames.
const LEAST_ALPHA: f64 = 1.0e-3;

impl Table {
    /// By quadrature.
    pub fn new() -> Self {
        let rows = (0..ROWS).flat_map(row);
        Self {
            values: rows.map(|value| value as f32).collect(),
        }
    }

    /// As shaders read it.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// 1 - E(mu).
    pub fn missing(&self, mu: f64, alpha: f64) -> f64 {
        let alpha = alpha.clamp(LEAST_ALPHA, 1.0);
        let mu = mu.clamp(0.0, 1.0);
        let w = (alpha * (1.0 - mu) / (mu + alpha)).sqrt();
        // 1 - w without a difference.
        let rest = mu * (1.0 + alpha) / ((mu + alpha) * (1.0 + w));
        let (column, along) = place(rest.sqrt(), COLUMNS);
        self.between_rows(alpha, |row| {
            let at = |column: usize| f64::from(self.values[row * STRIDE + column]);
            at(column) + (at(column + 1) - at(column)) * along
        })
    }

    /// Its mean over the cosine.
    pub fn mean(&self, alpha: f64) -> f64 {
        let alpha = alpha.clamp(LEAST_ALPHA, 1.0);
        let over = |row: usize| f64::from(self.values[row * STRIDE + COLUMNS]);
        size(alpha) * self.between_rows(alpha, over)
    }

    fn between_rows(&self, alpha: f64, of: impl Fn(usize) -> f64) -> f64 {
        let (row, along) = place(alpha.cbrt(), ROWS);
        of(row) + (of(row + 1) - of(row)) * along
    }
}

impl Default for Table {
    fn default() -> Self {
        Self::new()
    }
}

/// The node below x of so many over 0..1, and how far on it is to the next.
fn place(x: f64, nodes: usize) -> (usize, f64) {
    let at = x * (nodes - 1) as f64;
    let below = (at as usize).min(nodes - 2);
    (below, at - below as f64)
}

fn row(place: usize) -> impl Iterator<Item = f64> {
    let alpha = (place as f64 / (ROWS - 1) as f64).powi(3).max(LEAST_NODE);
    let values: Vec<f64> = (0..COLUMNS)
        .map(|column| {
            let v = column as f64 / (COLUMNS - 1) as f64;
            let mu = cosine(v, alpha).max(LEAST_NODE * alpha);
            (1.0 - albedo(mu, alpha)).max(0.0)
        })
        .collect();
    let mean = mean(&values, alpha) / size(alpha);
    values.into_iter().chain([mean])
}

/// How the mean grows from smooth to rough, so that what is left of it is almost a straight line: far from grazing
/// (alpha / mu)^2 is missing, and the integral of that over the cosine adds a logarithm.
fn size(alpha: f64) -> f64 {
    alpha * alpha * (1.0 - alpha.ln())
}

/// In place of 0, where nothing is defined.
const LEAST_NODE: f64 = 1.0e-4;

/// The cosine at v.
fn cosine(v: f64, alpha: f64) -> f64 {
    let w = 1.0 - v * v;
    alpha * (1.0 - w * w) / (w * w + alpha)
}

/// 2 int m mu dmu of values m that are linear in v between nodes.
fn mean(values: &[f64], alpha: f64) -> f64 {
    let last = (values.len() - 1) as f64;
    let between = values.windows(2).enumerate().map(|(i, pair)| {
        let (a, b) = (i as f64 / last, (i + 1) as f64 / last);
        // The cosine rises fast where w is below the root of alpha, which is at the end.
        let breaks = [1.0, 0.1, 0.01, 0.0].map(|rest| b - rest * (b - a));
        RULE.integrate(&breaks, |v| {
            let value = pair[0] + (pair[1] - pair[0]) * (v - a) / (b - a);
            let w = 1.0 - v * v;
            let slope = 4.0 * v * w * alpha * (1.0 + alpha) / (w * w + alpha).powi(2);
            2.0 * value * cosine(v, alpha) * slope
        })
    });
    between.sum()
}

/// The table that frames use, made once.
pub static TABLE: LazyLock<Table> = LazyLock::new(Table::new);

/// f cos(theta_l) of several bounces, by the table; `mean`: of the Fresnel term over the cosine, per channel. 0 for a light or an eye
/// at or below the surface.
pub fn lobe(n: DVec3, l: DVec3, e: DVec3, alpha: f64, mean: DVec3) -> DVec3 {
    let (nl, ne) = (n.dot(l), n.dot(e));
    if nl <= 0.0 || ne <= 0.0 {
        return DVec3::ZERO;
    }
    between(nl, ne, alpha) * scale(TABLE.mean(alpha), mean)
}

/// For F = 1: (1 - E(l)) (1 - E(e)) / (pi (1 - <E>)) cos(theta_l).
pub fn between(nl: f64, ne: f64, alpha: f64) -> f64 {
    let missing = TABLE.mean(alpha);
    if missing < LEAST_MISSING {
        return 0.0;
    }
    TABLE.missing(nl, alpha) * TABLE.missing(ne, alpha) / (PI * missing) * nl
}

/// Less is lost to the table's rounding as well.
const LEAST_MISSING: f64 = 1.0e-6;

/// F^2 <E> / (1 - F (1 - <E>)) for the mean Fresnel term F: what is left of it where facets do not reflect everything.
pub fn scale(missing: f64, mean: DVec3) -> DVec3 {
    mean * mean * (1.0 - missing) / (DVec3::ONE - mean * missing)
}
