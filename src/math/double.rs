//! How do sums of products of 32-bit numbers keep all their digits?
//!
//! In f64 a dot product of 32-bit vectors near a right angle is off by 3e-11 of itself at a cosine of 1e-6. A truth that
//! claims 1e-12 needs the digits that the additions lose.

use std::ops::{Add, Mul, Sub};

use glam::Vec3;

/// The unevaluated sum of two f64, of which the second is at most half a unit in the last place of the first.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Double {
    high: f64,
    low: f64,
}

impl Double {
    /// a + b, exactly (Knuth, The Art of Computer Programming 2, section 4.2.2, theorem B).
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let b_kept = high - a;
        let a_kept = high - b_kept;
        Self {
            high,
            low: (a - a_kept) + (b - b_kept),
        }
    }

    /// The product of two 32-bit numbers: 48 bits, exact in 53.
    pub fn product(a: f32, b: f32) -> Self {
        Self::from(f64::from(a) * f64::from(b))
    }

    /// The nearest f64.
    pub fn value(self) -> f64 {
        self.high + self.low
    }
}

impl From<f64> for Double {
    fn from(value: f64) -> Self {
        Self {
            high: value,
            low: 0.0,
        }
    }
}

impl Add for Double {
    type Output = Self;

    /// To 2^-104 of |self| + |other|.
    fn add(self, other: Self) -> Self {
        let high = Self::sum(self.high, other.high);
        Self::sum(high.high, high.low + (self.low + other.low))
    }
}

impl Sub for Double {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + Self {
            high: -other.high,
            low: -other.low,
        }
    }
}

impl Mul for Double {
    type Output = Self;

    /// To 2^-102 of itself.
    fn mul(self, other: Self) -> Self {
        let high = self.high * other.high;
        let lost = self.high.mul_add(other.high, -high);
        let low = lost + (self.high * other.low + self.low * other.high);
        Self::sum(high, low)
    }
}

/// The dot product, to 2^-102 of the sum of its terms' sizes.
pub fn dot(a: Vec3, b: Vec3) -> Double {
    Double::product(a.x, b.x) + Double::product(a.y, b.y) + Double::product(a.z, b.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cancels_leaves_its_last_digits() {
        // 1 + 2^-30 - 1 from terms that f32 holds: (1, 2^-15, 1).(1, 2^-15, -1).
        let a = Vec3::new(1.0, 2.0_f32.powi(-15), 1.0);
        let b = Vec3::new(1.0, 2.0_f32.powi(-15), -1.0);
        assert_eq!(dot(a, b).value(), 2.0_f64.powi(-30));
        // 2^100 + 1 - 2^100 leaves 1: more than 53 bits apart.
        let large = Double::from(2.0_f64.powi(100));
        assert_eq!((large + Double::from(1.0) - large).value(), 1.0);
        // (1 + 2^-60)^2 - 1 = 2^-59 + 2^-120, to 2^-102 of 1.
        let near_one = Double::from(1.0) + Double::from(2.0_f64.powi(-60));
        let rest = near_one * near_one - Double::from(1.0);
        assert_eq!(rest.value(), 2.0_f64.powi(-59));
    }
}
