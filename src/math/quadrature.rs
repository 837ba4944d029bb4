//! What is the integral of a smooth function over an interval, a hemisphere, or the half vectors?

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::frame::{Frame, angle, spherical};

/// Gauss and Legendre's rule: exact for polynomials up to degree 2n - 1.
#[derive(Clone, Debug)]
pub struct GaussLegendre {
    /// Places in -1..1 and their weights, which sum to 2.
    nodes: Vec<(f64, f64)>,
}

impl GaussLegendre {
    /// The rule with `n` >= 1 nodes, by Newton's method on the Legendre polynomial.
    pub fn new(n: usize) -> GaussLegendre {
        let node = |k: usize| {
            let mut x = (PI * (k as f64 + 0.75) / (n as f64 + 0.5)).cos();
            // The guess (Tricomi) is good to 1e-3; six quadratic steps leave only rounding.
            for _ in 0..6 {
                let (p, slope) = legendre(n, x);
                x -= p / slope;
            }
            let (_, slope) = legendre(n, x);
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        };
        GaussLegendre {
            nodes: (0..n).map(node).collect(),
        }
    }

    /// The integral of `f` over each interval between neighbouring `breaks`, summed. Put the kinks of `f` there.
    pub fn integrate(&self, breaks: &[f64], mut f: impl FnMut(f64) -> f64) -> f64 {
        let places = self.places(breaks);
        places.map(|(x, weight)| weight * f(x)).sum()
    }

    /// Where `integrate` asks, and with which weight.
    pub fn places(&self, breaks: &[f64]) -> impl Iterator<Item = (f64, f64)> {
        breaks.windows(2).flat_map(|pair| {
            let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
            let inside = self.nodes.iter();
            inside.map(move |(x, weight)| (middle + half * x, half * weight))
        })
    }
}

/// The Legendre polynomial of degree n at x, |x| < 1, and its slope (Bonnet's recursion).
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut p) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        (before, p) = (p, ((2.0 * k + 1.0) * x * p - k * before) / (k + 1.0));
    }
    (p, n as f64 * (before - x * p) / (1.0 - x * x))
}

/// `count` equal intervals of start..end, as `count + 1` breaks.
pub fn equal_breaks(start: f64, end: f64, count: usize) -> Vec<f64> {
    (0..=count)
        .map(|k| start + (end - start) * k as f64 / count as f64)
        .collect()
}

/// The integral over solid angle of `f(L)`, L above the plane of `n`; n and e unit vectors.
///
/// For lobes as wide as the hemisphere, with kinks only where L and e have the same angle to n and where their
/// azimuths differ by a multiple of a right angle.
pub fn hemisphere(
    rule: &GaussLegendre,
    n: DVec3,
    e: DVec3,
    mut f: impl FnMut(DVec3) -> f64,
) -> f64 {
    let frame = Frame::facing(n, e);
    let thetas = [0.0, angle(n, e).min(FRAC_PI_2), FRAC_PI_2];
    let phis = equal_breaks(0.0, 2.0 * PI, 4);
    rule.integrate(&thetas, |theta| {
        theta.sin() * rule.integrate(&phis, |phi| f(frame.at(spherical(theta, phi))))
    })
}

/// The integral over solid angle of `f(L)`, by the half vectors of L and e, for a lobe whose half vectors have
/// Beckmann's slopes of roughness `m` > 0; n and e unit vectors, e above the plane of n.
///
/// With tan(theta_h) = m s, dL = 4 (E.H) dH and dH = m^2 cos^3(theta_h) s ds dphi. Slopes beyond s = 6.5 hold
/// exp(-42) of the facets. Symmetric lobes only: half the azimuths stand for all.
pub fn half_vectors(
    rule: &GaussLegendre,
    n: DVec3,
    e: DVec3,
    m: f64,
    mut f: impl FnMut(DVec3) -> f64,
) -> f64 {
    let frame = Frame::facing(n, e);
    let slopes = equal_breaks(0.0, 6.5, 8);
    let phis = equal_breaks(0.0, PI, 8);
    rule.integrate(&slopes, |s| {
        let theta = (m * s).atan();
        let dh = m * m * theta.cos().powi(3) * s;
        let ring = rule.integrate(&phis, |phi| {
            let h = frame.at(spherical(theta, phi));
            let eh = e.dot(h);
            let l = h * (2.0 * eh) - e;
            if eh > 0.0 && n.dot(l) > 0.0 {
                4.0 * eh * f(l)
            } else {
                0.0
            }
        });
        2.0 * dh * ring
    })
}
