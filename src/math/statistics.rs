//! What do repeated measurements say, and how surely?
//!
//! Timings have long tails and drift, so nothing here assumes a distribution: medians, and intervals between
//! order statistics. Two variants are measured back to back, pair by pair, and only the pairs are compared: a
//! clock that changes between pairs cancels.
//!
//! A value that is not finite is no measurement: with one among them, and with none at all, there is no answer.

/// How sure an interval must at least be.
const CONFIDENCE: f64 = 0.95;

/// An estimate, and where the true value lies with a probability of at least `coverage`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    pub estimate: f64,
    /// Minus infinity where there are too few values to bound it.
    pub low: f64,
    /// Infinity likewise.
    pub high: f64,
    /// The coverage reached, 0.95 or more: ranks are whole, so 0.95 itself is not to be had. 1 without bounds.
    pub coverage: f64,
}

impl Interval {
    /// What is known of a ratio whose clock stood still.
    pub const UNKNOWN: Self = Self {
        estimate: f64::NAN,
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
        coverage: 1.0,
    };

    /// Whether the measurements allow `x`; the bounds belong to the interval.
    pub fn contains(&self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }
}

/// The middle value, or the mean of the middle two.
pub fn median(values: &[f64]) -> Option<f64> {
    Some(middle(&sorted(values)?))
}

/// The median distance from the median, as it is: not scaled by 1.4826 to a Gaussian's standard deviation.
pub fn mad(values: &[f64]) -> Option<f64> {
    let centre = median(values)?;
    let distances: Vec<f64> = values.iter().map(|value| (value - centre).abs()).collect();
    median(&distances)
}

/// The median of the distribution that independent `values` come from, by the sign test.
///
/// Each value is below the true median with probability 1/2, so how many are is binomial, whatever the
/// distribution; where values can tie, the coverage is only higher. Fewer than 6 values never reach 0.95:
/// they have an estimate and no bounds.
pub fn median_interval(values: &[f64]) -> Option<Interval> {
    let sorted = sorted(values)?;
    let (low, high, coverage) = match rank(sorted.len()) {
        Some((rank, coverage)) => (sorted[rank - 1], sorted[sorted.len() - rank], coverage),
        None => (f64::NEG_INFINITY, f64::INFINITY, 1.0),
    };
    Some(Interval {
        estimate: middle(&sorted),
        low,
        high,
        coverage,
    })
}

/// The median of a / b over pairs (a, b); a zero b is refused with all the rest.
pub fn paired_ratio(pairs: &[(f64, f64)]) -> Option<Interval> {
    let ratios: Vec<f64> = pairs.iter().map(|(a, b)| a / b).collect();
    median_interval(&ratios)
}

/// The median of a - b over pairs (a, b), in their unit.
pub fn paired_difference(pairs: &[(f64, f64)]) -> Option<Interval> {
    let differences: Vec<f64> = pairs.iter().map(|(a, b)| a - b).collect();
    median_interval(&differences)
}

/// The largest r such that the r-th smallest and the r-th largest of n values enclose the median with 0.95, and
/// the probability with which they do; `None` below n = 6, where even the extremes do not.
///
/// They fail where fewer than r values lie on one side of it: 2 P(B < r) with B binomial (n, 1/2). Terms are taken
/// relative to the largest, for 2^-n leaves f64 at n = 1075; those that underflow are too small to count.
pub fn rank(n: usize) -> Option<(usize, f64)> {
    let mut terms = vec![1.0; n / 2 + 1];
    for k in (0..n / 2).rev() {
        terms[k] = terms[k + 1] * (k + 1) as f64 / (n - k) as f64;
    }
    let half: f64 = terms.iter().sum();
    // An even n has one term in the middle, an odd n two: its mirror is beyond `terms`.
    let all = 2.0 * half - if n.is_multiple_of(2) { 1.0 } else { 0.0 };
    let mut below = 0.0;
    let mut found = None;
    for (k, term) in terms.iter().enumerate() {
        below += term;
        let coverage = 1.0 - 2.0 * below / all;
        if coverage < CONFIDENCE {
            break;
        }
        found = Some((k + 1, coverage));
    }
    found
}

/// In ascending order; `None` where there are none, or one is not finite.
fn sorted(values: &[f64]) -> Option<Vec<f64>> {
    if values.is_empty() || !values.iter().all(|value| value.is_finite()) {
        return None;
    }
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    Some(sorted)
}

/// The median of values that are sorted, and at least one.
fn middle(sorted: &[f64]) -> f64 {
    sorted[(sorted.len() - 1) / 2].midpoint(sorted[sorted.len() / 2])
}
