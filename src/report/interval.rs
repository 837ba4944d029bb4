//! Between which bounds does a figure lie?

use crate::math::statistics::Interval;

/// An interval with a confidence of 95 %.
#[derive(Clone, Copy, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct Interval95 {
    /// From here; null where too few samples bound it.
    pub low: Option<f64>,
    /// To here.
    pub high: Option<f64>,
}

impl Interval95 {
    /// What no samples bound.
    pub const UNBOUNDED: Self = Self {
        low: None,
        high: None,
    };

    /// The same with both bounds changed.
    pub fn map(self, of: impl Fn(f64) -> f64) -> Self {
        Self {
            low: self.low.map(&of),
            high: self.high.map(&of),
        }
    }
}

impl From<Interval> for Interval95 {
    fn from(interval: Interval) -> Self {
        let finite = |bound: f64| bound.is_finite().then_some(bound);
        Self {
            low: finite(interval.low),
            high: finite(interval.high),
        }
    }
}
