//! Does the polynomial say what GGX facets lose, and is it the best of its kind?

use std::sync::LazyLock;

use glam::DVec3;
use umber::math::frame::spherical;
use umber::math::quadrature::{GaussLegendre, hemisphere};
use umber::reference::ggx;
use umber::reference::ggx_missing::{ALPHA_MIN, GgxMissing, TERMS, albedo, bend, over, z};

use crate::tolerances::{GGX_FURNACE, GGX_REFIT, QUADRATURE_KINKED};

const N: DVec3 = DVec3::Z;
const SHADER: &str = include_str!("../../shaders-glsl/brdf/ggx_missing.glsl");
const TWIN: &str = include_str!("../../src/reference/ggx_missing.rs");

/// The integral by slopes against the lobe's own over directions.
#[test]
fn the_albedo_is_the_lobes() {
    let rule = GaussLegendre::new(96);
    for (alpha, theta) in [(1.0, 0.3_f64), (0.6, 1.2), (0.5, 0.9)] {
        let e = spherical(theta, 0.0);
        let sum = hemisphere(&rule, N, e, |l| ggx::lobe(N, l, e, alpha));
        assert!(
            (sum - albedo(theta.cos(), alpha)).abs() <= QUADRATURE_KINKED,
            "{alpha}, {theta}"
        );
    }
}

/// 2 int (1 - E) mu dmu of the polynomial.
fn mean(missing: &GgxMissing) -> f64 {
    let rule = GaussLegendre::new(24);
    let breaks = [0.0, 1e-4, 1e-3, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0];
    rule.integrate(&breaks, |mu| 2.0 * mu * missing.at(mu))
}

/// With F = 1, one bounce gives E back, and what is missing comes as often as the polynomial says.
#[test]
fn no_light_is_lost() {
    let mut worst = (0.0_f64, 0.0, 0.0);
    for i in 0..120 {
        let alpha = ((f64::from(i) + 0.5) / 120.0).powi(2).max(ALPHA_MIN);
        let missing = GgxMissing::new(alpha);
        let again = mean(&missing) / missing.mean();
        for j in 0..80 {
            // From a ten-thousandth on, evenly in its logarithm.
            let mu = 10.0_f64.powf(-4.0 * f64::from(j) / 80.0);
            let off = (albedo(mu, alpha) + missing.at(mu) * again - 1.0).abs();
            if off > worst.0 {
                worst = (off, alpha, mu);
            }
        }
    }
    println!("the polynomial is off by {worst:?}");
    assert!(worst.0 <= GGX_FURNACE, "{worst:?}");
}

#[test]
fn nothing_is_gained() {
    for i in 0..400 {
        let missing = GgxMissing::new((f64::from(i) / 400.0).powi(3));
        assert!(missing.mean() > 0.0, "{i}");
        for j in 0..400 {
            let mu = (f64::from(j) / 400.0).powi(3);
            let at = missing.at(mu);
            assert!((0.0..1.0).contains(&at), "{i}, {j}: {at}");
        }
    }
}

/// Every decimal number of a text, in its order, of at least five digits.
fn numbers(text: &str) -> Vec<f64> {
    let words = text.split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'));
    let digits = |word: &str| word.chars().filter(char::is_ascii_digit).count();
    let long = words.filter(|word| word.contains('.') && digits(word) >= 5);
    long.filter_map(|word| word.parse().ok()).collect()
}

/// The shader has the highest powers first and terms side by side, the twin term by term with rising powers.
#[test]
fn shader_and_twin_have_the_same_numbers() {
    let mut shader = numbers(SHADER);
    let mut twin = numbers(TWIN);
    assert!(shader.len() >= 58, "{shader:?}");
    shader.iter_mut().for_each(|number| *number = number.abs());
    twin.iter_mut().for_each(|number| *number = number.abs());
    shader.sort_by(f64::total_cmp);
    twin.sort_by(f64::total_cmp);
    assert_eq!(shader, twin);
}

/// What is missing at a node, how far off it may be, and the terms of the polynomial there.
struct Node {
    missing: f64,
    tolerance: f64,
    terms: Vec<f64>,
}

/// Powers of alpha of each term.
const POWERS: usize = 6;

static NODES: LazyLock<Vec<Node>> = LazyLock::new(|| {
    let mut nodes = Vec::new();
    for i in 0..33 {
        let alpha = (0.1 + 0.9 * chebyshev(i, 33)).powi(3);
        let bend = bend(alpha);
        let turned = (0..53).map(|j| chebyshev(j, 53));
        let near = turned.map(|rest| rest * bend / (1.0 + bend - rest));
        let even = (0..25).map(|j| 10.0_f64.powf(-4.0 * f64::from(j) / 24.0));
        for mu in near.chain(even) {
            nodes.push(node(mu.clamp(1e-4 * alpha, 1.0), alpha));
        }
    }
    nodes
});

/// 0 to 1, closer at the ends.
fn chebyshev(i: u32, count: u32) -> f64 {
    let turned = std::f64::consts::PI * f64::from(i) / f64::from(count - 1);
    0.5 * (1.0 - turned.cos())
}

fn node(mu: f64, alpha: f64) -> Node {
    let missing = (1.0 - albedo(mu, alpha)).max(0.0);
    let tolerance = match mu < alpha {
        true => 1e-3,
        false => 1e-3 * missing / (missing + 0.01) + 1e-9,
    };
    let z = z(mu, bend(alpha));
    let factors = [alpha * alpha, alpha];
    let terms = (0..TERMS).flat_map(|term| {
        let factor = factors.get(term).copied().unwrap_or(1.0);
        let shape = (1.0 - z) * z.powi(term as i32) * factor * over(alpha);
        (0..POWERS).map(move |power| shape * (alpha - 0.5).powi(power as i32))
    });
    Node {
        missing,
        tolerance,
        terms: terms.collect(),
    }
}

/// The coefficients that make the sum of squares least, by Gram and Schmidt, twice over.
fn least_squares(rows: &[Node], weights: &[f64]) -> Vec<f64> {
    let unknowns = TERMS * POWERS;
    let weigh = |value: f64, i: usize| value * weights[i] / rows[i].tolerance;
    let column = |k: usize| -> Vec<f64> {
        let values = rows.iter().enumerate();
        values.map(|(i, node)| weigh(node.terms[k], i)).collect()
    };
    let mut basis: Vec<Vec<f64>> = Vec::new();
    // Of each column, how long it is along those before it, and beside them.
    let mut upper: Vec<Vec<f64>> = Vec::new();
    for k in 0..unknowns {
        let mut rest = column(k);
        let mut lengths = vec![0.0; k];
        for _ in 0..2 {
            for (known, length) in basis.iter().zip(&mut lengths) {
                let along = dot(known, &rest);
                *length += along;
                rest.iter_mut()
                    .zip(known)
                    .for_each(|(r, q)| *r -= along * q);
            }
        }
        let length = dot(&rest, &rest).sqrt();
        lengths.push(length);
        upper.push(lengths);
        rest.iter_mut().for_each(|r| *r /= length);
        basis.push(rest);
    }
    let wanted: Vec<f64> = (0..rows.len()).map(|i| weigh(rows[i].missing, i)).collect();
    let mut found = vec![0.0; unknowns];
    for k in (0..unknowns).rev() {
        let known: f64 = (k + 1..unknowns).map(|j| upper[j][k] * found[j]).sum();
        found[k] = (dot(&basis[k], &wanted) - known) / upper[k][k];
    }
    found
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Errors over what is tolerated: those of coefficients.
fn errors(rows: &[Node], found: &[f64]) -> Vec<f64> {
    let error = |node: &Node| (dot(&node.terms, found) - node.missing).abs() / node.tolerance;
    rows.iter().map(error).collect()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// Least squares, with more weight where the error is large, again and again: towards the least largest error.
fn refit(rows: &[Node]) -> f64 {
    let mut weights = vec![1.0; rows.len()];
    let mut best = f64::INFINITY;
    for _ in 0..40 {
        let errors = errors(rows, &least_squares(rows, &weights));
        let worst = largest(&errors);
        best = best.min(worst);
        for (weight, error) in weights.iter_mut().zip(&errors) {
            *weight *= (error / worst + 0.05).sqrt();
        }
        let most = largest(&weights);
        weights.iter_mut().for_each(|weight| *weight /= most);
    }
    best
}

#[test]
fn no_other_numbers_do_much_better() {
    let nodes = &*NODES;
    let mut shipped = 0.0_f64;
    for i in 0..33 {
        let alpha = (0.1 + 0.9 * chebyshev(i, 33)).powi(3);
        let missing = GgxMissing::new(alpha);
        for j in 0..60 {
            let mu = 10.0_f64.powf(-4.0 * f64::from(j) / 60.0);
            let node = node(mu, alpha);
            shipped = shipped.max((missing.at(mu) - node.missing).abs() / node.tolerance);
        }
    }
    let refit = refit(nodes);
    println!("shipped: {shipped} of what is tolerated; fitted again: {refit}");
    assert!(shipped <= 1.0 && shipped <= GGX_REFIT * refit);
}
