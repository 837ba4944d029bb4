//! Is a number of a scene finite and in its range?

use std::fmt;

use super::error::Error;
use super::layers::Layers;
use super::quote;

/// The farthest coordinate from the origin, m. With scales up to `LARGEST_SCALE`, squared lengths
/// stay at 3e36, below the largest f32 (3.4e38).
pub(super) const FARTHEST: f64 = 1e12;
/// The largest factor by which a model may be scaled; see `FARTHEST`.
pub(super) const LARGEST_SCALE: f64 = 1e6;
/// The largest photometric number, lx, cd or cd/m^2: six hundred times the sun's own luminance
/// (1.6e9 cd/m^2), and its products with any exposure stay finite in f32.
pub(super) const BRIGHTEST: f64 = 1e12;

/// An interval of numbers; the ends belong to it where `closed` says so.
#[derive(Clone, Copy, Debug)]
pub(super) struct Range {
    low: f64,
    high: f64,
    closed: (bool, bool),
}

impl Range {
    /// `low <= x <= high`.
    pub(super) const fn closed(low: f64, high: f64) -> Self {
        Self {
            low,
            high,
            closed: (true, true),
        }
    }

    /// `low < x < high`.
    pub(super) const fn open(low: f64, high: f64) -> Self {
        Self {
            low,
            high,
            closed: (false, false),
        }
    }

    /// `low < x <= high`.
    pub(super) const fn above(low: f64, high: f64) -> Self {
        Self {
            low,
            high,
            closed: (false, true),
        }
    }

    /// `low <= x < high`.
    pub(super) const fn below(low: f64, high: f64) -> Self {
        Self {
            low,
            high,
            closed: (true, false),
        }
    }

    /// The interval with its ends rounded as the numbers in it are.
    fn narrow(self) -> Self {
        let round = |x: f64| f64::from(x as f32);
        Self {
            low: round(self.low),
            high: round(self.high),
            ..self
        }
    }

    /// True where `x` belongs to the interval; a NaN never does.
    pub(super) fn contains(self, x: f64) -> bool {
        let over = if self.closed.0 {
            x >= self.low
        } else {
            x > self.low
        };
        let under = if self.closed.1 {
            x <= self.high
        } else {
            x < self.high
        };
        over && under
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let low = if self.closed.0 {
            "at least"
        } else {
            "more than"
        };
        let high = if self.closed.1 {
            "at most"
        } else {
            "less than"
        };
        write!(
            f,
            "{low} {} and {high} {}",
            short(self.low),
            short(self.high)
        )
    }
}

/// A number without a tail or a head of zeros.
fn short(x: f64) -> String {
    if x.abs() >= 1e6 || (x != 0.0 && x.abs() < 1e-4) {
        format!("{x:e}")
    } else {
        format!("{x}")
    }
}

/// 0 to 1: reflectances, opacity, roughness.
pub(super) const UNIT: Range = Range::closed(0.0, 1.0);
/// Positions, m.
pub(super) const COORDINATE: Range = Range::closed(-FARTHEST, FARTHEST);
/// Illuminance, intensity, radiance and the weights of a light's colour.
pub(super) const LIGHT: Range = Range::closed(0.0, BRIGHTEST);

impl Layers {
    /// The number as f32, or an error that names the key, the value and the range.
    pub(super) fn number(&self, path: &[&str], value: f64, range: Range) -> Result<f32, Error> {
        // A value may round to an end of an open range: checked again as f32, between ends of f32.
        let narrow = value as f32;
        if range.contains(value) && range.narrow().contains(f64::from(narrow)) {
            return Ok(narrow);
        }
        let key = quote::key(path);
        Err(self.error(path, format!("{key} = {}: must be {range}", short(value))))
    }

    /// Three numbers, each in the range.
    pub(super) fn triple(
        &self,
        path: &[&str],
        value: [f64; 3],
        range: Range,
    ) -> Result<[f32; 3], Error> {
        let mut checked = [0.0; 3];
        for (to, from) in checked.iter_mut().zip(value) {
            *to = self.number(path, from, range)?;
        }
        Ok(checked)
    }

    /// The value of a key that must be there.
    pub(super) fn required<T>(&self, path: &[&str], value: Option<T>) -> Result<T, Error> {
        value.ok_or_else(|| self.error(path, format!("{} is missing", quote::key(path))))
    }
}
