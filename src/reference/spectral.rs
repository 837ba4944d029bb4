//! How does a metal's colour change with the angle, as its whole spectrum has it: as a curve that a shader can follow?

use glam::DVec3;

use super::metal::Metal;
use super::wavelengths::Spectrum;
use super::{f82, schlick};

/// A metal that can be named.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Named {
    /// As scenes name it.
    pub name: &'static str,
    /// As the measurements name it.
    pub symbol: &'static str,
}

/// All of them. Au, Cu, Ag: Johnson and Christy 1972; Al: Rakic 1995.
pub const METALS: [Named; 4] = [
    Named {
        name: "gold",
        symbol: "Au",
    },
    Named {
        name: "copper",
        symbol: "Cu",
    },
    Named {
        name: "silver",
        symbol: "Ag",
    },
    Named {
        name: "aluminium",
        symbol: "Al",
    },
];

/// Wavelengths that stand for red, green and blue, nm.
const CHANNELS: [f64; 3] = [610.0, 549.0, 468.0];

impl Named {
    /// Its spectrum.
    ///
    /// # Panics
    /// Never: a test finds each of `METALS` among the measurements.
    pub fn spectrum(&self) -> Spectrum {
        Spectrum::of_symbol(self.symbol).expect("a measured metal")
    }

    /// Its numbers for all Fresnel terms.
    pub fn metal(&self) -> Metal {
        let spectrum = self.spectrum();
        let f0 = spectrum.reflectance(1.0);
        let tint = spectrum.reflectance(f82::COSINE) / schlick::f(f0, f82::COSINE);
        let (n, k): (Vec<_>, Vec<_>) = CHANNELS.iter().map(|x| spectrum.index(*x)).unzip();
        Metal {
            f0,
            tint: tint.clamp(DVec3::ZERO, DVec3::ONE),
            n: DVec3::from_slice(&n),
            k: DVec3::from_slice(&k),
            coefficients: fit(&spectrum),
        }
    }
}

/// Schlick's curve and four terms, c1 mu (1 - mu)^6 + c2 mu (1 - mu)^2 + c3 mu (1 - mu)^14 + c4 mu (1 - mu)^30; at least 0. A channel
/// may pass 1 where f0 does.
pub fn f(f0: DVec3, coefficients: [DVec3; 4], mu: f64) -> DVec3 {
    let terms = coefficients.into_iter().zip(terms(mu));
    let sum: DVec3 = terms.map(|(c, term)| c * term).sum();
    (schlick::f(f0, mu) + sum).max(DVec3::ZERO)
}

fn terms(mu: f64) -> [f64; 4] {
    let rest = 1.0 - mu.clamp(0.0, 1.0);
    [6, 2, 14, 30].map(|power| mu * rest.powi(power))
}

/// Angles that the curve is fitted at: every half degree.
const ANGLES: usize = 180;
/// Rounds of Lawson's weights; the largest error is within a percent of the least possible after thirty.
const ROUNDS: usize = 60;

/// The coefficients whose largest error over all angles is least, channel by channel: least squares, whose weights grow where the
/// error is large (Lawson 1961).
fn fit(spectrum: &Spectrum) -> [DVec3; 4] {
    let f0 = spectrum.reflectance(1.0);
    let cosines = (0..ANGLES).map(|i| (i as f64 * 90.0 / ANGLES as f64).to_radians().cos());
    let points: Vec<_> = cosines
        .map(|mu| (terms(mu), spectrum.reflectance(mu) - schlick::f(f0, mu)))
        .collect();
    let channels = [0, 1, 2].map(|channel| {
        let points: Vec<_> = points.iter().map(|(t, left)| (*t, left[channel])).collect();
        minimax(&points)
    });
    std::array::from_fn(|i| DVec3::from_array(channels.map(|c| c[i])))
}

fn minimax(points: &[([f64; 4], f64)]) -> [f64; 4] {
    let mut weights = vec![1.0 / points.len() as f64; points.len()];
    let mut best = ([0.0; 4], f64::INFINITY);
    for _ in 0..ROUNDS {
        let solution = least_squares(points, &weights);
        let errors = points.iter().map(|(terms, want)| {
            let got: f64 = terms.iter().zip(solution).map(|(t, c)| t * c).sum();
            (got - want).abs()
        });
        let errors: Vec<_> = errors.collect();
        let largest = errors.iter().copied().fold(0.0, f64::max);
        if largest < best.1 {
            best = (solution, largest);
        }
        let grown = weights.iter().zip(&errors).map(|(w, e)| w * e);
        let grown: Vec<_> = grown.collect();
        let sum: f64 = grown.iter().sum();
        weights = grown.into_iter().map(|w| w / sum).collect();
    }
    best.0
}

/// The solution of the normal equations by elimination, the largest pivot first.
fn least_squares(points: &[([f64; 4], f64)], weights: &[f64]) -> [f64; 4] {
    let mut rows = [[0.0; 5]; 4];
    for ((terms, want), weight) in points.iter().zip(weights) {
        for (row, left) in rows.iter_mut().zip(terms) {
            let all = terms.iter().chain([want]);
            for (cell, right) in row.iter_mut().zip(all) {
                *cell += weight * left * right;
            }
        }
    }
    for pivot in 0..4 {
        let largest =
            (pivot..4).max_by(|a, b| rows[*a][pivot].abs().total_cmp(&rows[*b][pivot].abs()));
        rows.swap(pivot, largest.unwrap_or(pivot));
        let lead = rows[pivot];
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = if i == pivot {
                0.0
            } else {
                row[pivot] / lead[pivot]
            };
            for (cell, from) in row.iter_mut().zip(lead) {
                *cell -= factor * from;
            }
        }
    }
    std::array::from_fn(|i| rows[i][4] / rows[i][i])
}
