//! What did a frame leave: which values, and are they numbers?

use crate::math::fnv::fnv1a;

/// Scene-linear radiance, cd/m^2, linear sRGB, premultiplied by alpha; rows from the top.
#[derive(Clone, PartialEq, Debug)]
pub struct Picture {
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height` pixels of red, green, blue, alpha.
    pub pixels: Vec<[f32; 4]>,
}

/// What is wrong with a pixel's values.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Defects {
    /// Pixels with a NaN.
    pub nan: usize,
    /// Pixels with an infinity and no NaN.
    pub infinite: usize,
    /// Pixels with a negative value and neither.
    pub negative: usize,
    /// The first NaN or infinite pixel, column and row.
    pub first: Option<(u32, u32)>,
}

impl Defects {
    /// Pixels with a NaN or an infinity.
    pub fn not_finite(&self) -> usize {
        self.nan + self.infinite
    }
}

impl Picture {
    /// The pixel in column `x` of row `y`.
    pub fn at(&self, x: u32, y: u32) -> [f32; 4] {
        self.pixels[(y * self.width + x) as usize]
    }

    /// The largest |a - b| / (|b| + 0.1 cd/m^2) over all values, b being the other picture's: at most 1e-5 where
    /// they agree within 1e-5 relative and 1e-6 absolute. Infinite where sizes differ, or one holds a NaN
    /// or an infinity and the other does not.
    pub fn max_difference(&self, other: &Self) -> f64 {
        if (self.width, self.height) != (other.width, other.height) {
            return f64::INFINITY;
        }
        let own = self.pixels.as_flattened().iter();
        let pairs = own.zip(other.pixels.as_flattened());
        let difference = |(&a, &b): (&f32, &f32)| {
            if a == b || a.is_nan() && b.is_nan() {
                return 0.0;
            }
            let (a, b) = (f64::from(a), f64::from(b));
            let difference = (a - b).abs() / (b.abs() + 0.1);
            if difference.is_nan() {
                f64::INFINITY
            } else {
                difference
            }
        };
        pairs.map(difference).fold(0.0, f64::max)
    }

    /// 64 bits that tell it from another: two pictures of one hash are equal bit by bit, as far as anybody will see.
    pub fn hash(&self) -> u64 {
        let size = [self.width, self.height].map(u32::to_le_bytes);
        let pixels = self.pixels.as_flattened().iter();
        let bits = pixels.flat_map(|value| value.to_bits().to_le_bytes());
        fnv1a(size.into_iter().flatten().chain(bits))
    }

    /// Counts the pixels that are not non-negative numbers. Tested on the CPU: a driver may fold
    /// `isnan` away.
    pub fn defects(&self) -> Defects {
        let mut defects = Defects::default();
        for (pixel, place) in self.pixels.iter().zip(0_u32..) {
            if pixel.iter().all(|value| value.is_finite()) {
                defects.negative += usize::from(pixel.iter().any(|value| *value < 0.0));
                continue;
            }
            defects
                .first
                .get_or_insert((place % self.width, place / self.width));
            if pixel.iter().any(|value| value.is_nan()) {
                defects.nan += 1;
            } else {
                defects.infinite += 1;
            }
        }
        defects
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_defect_is_counted_once_and_the_first_is_placed() {
        let good = [0.5, 0.0, 2.0, 1.0];
        let mut pixels = vec![good; 6];
        pixels[1][0] = -0.1;
        pixels[3] = [f32::NAN, f32::INFINITY, -1.0, 1.0];
        pixels[5][2] = f32::INFINITY;
        let picture = Picture {
            width: 2,
            height: 3,
            pixels,
        };
        let expected = Defects {
            nan: 1,
            infinite: 1,
            negative: 1,
            first: Some((1, 1)),
        };
        assert_eq!(picture.defects(), expected);
        assert_eq!(picture.at(1, 2)[2], f32::INFINITY);
    }
}
