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

/// Why a pixel is none that a screen can show.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Defect {
    /// A value is NaN.
    Nan,
    /// One is infinite, and none NaN.
    Infinite,
    /// One is below 0, and all are finite.
    Negative,
}

impl Defect {
    /// What is wrong with a pixel, if anything is.
    pub fn of(pixel: &[f32; 4]) -> Option<Self> {
        let any = |is: fn(f32) -> bool| pixel.iter().any(|value| is(*value));
        match () {
            () if any(f32::is_nan) => Some(Self::Nan),
            () if any(f32::is_infinite) => Some(Self::Infinite),
            () if any(|value| value < 0.0) => Some(Self::Negative),
            () => None,
        }
    }

    /// Its false colour: magenta, yellow, cyan.
    pub fn colour(self) -> [f32; 3] {
        match self {
            Self::Nan => [1.0, 0.0, 1.0],
            Self::Infinite => [1.0, 1.0, 0.0],
            Self::Negative => [0.0, 1.0, 1.0],
        }
    }
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
        for ((x, y), defect) in self.defective() {
            match defect {
                Defect::Nan => defects.nan += 1,
                Defect::Infinite => defects.infinite += 1,
                Defect::Negative => defects.negative += 1,
            }
            if defect != Defect::Negative {
                defects.first.get_or_insert((x, y));
            }
        }
        defects
    }

    /// The pixels that are not non-negative numbers: column and row, and why.
    pub fn defective(&self) -> impl Iterator<Item = ((u32, u32), Defect)> {
        let places = (0_u32..).map(|place| (place % self.width, place / self.width));
        let pixels = places.zip(&self.pixels);
        pixels.filter_map(|(place, pixel)| Some((place, Defect::of(pixel)?)))
    }

    /// The picture with those in their false colours, as bright as `white`, and the others in dim grey.
    pub fn false_colours(&self, white: f32) -> Self {
        let shown = |pixel: &[f32; 4]| {
            let [r, g, b] = match Defect::of(pixel) {
                Some(defect) => defect.colour().map(|channel| channel * white),
                None => {
                    let [r, g, b, _] = *pixel;
                    // Luminance of linear sRGB (IEC 61966-2-1), a quarter of it.
                    [0.25 * (0.2126 * r + 0.7152 * g + 0.0722 * b).min(white); 3]
                }
            };
            [r, g, b, 1.0]
        };
        Self {
            pixels: self.pixels.iter().map(shown).collect(),
            ..*self
        }
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
        let shown = picture.false_colours(10.0);
        assert_eq!(shown.defects(), Defects::default());
        assert_eq!(shown.at(1, 0), [0.0, 10.0, 10.0, 1.0]);
        assert_eq!(shown.at(1, 1), [10.0, 0.0, 10.0, 1.0]);
        assert_eq!(shown.at(1, 2), [10.0, 10.0, 0.0, 1.0]);
        let [r, g, b, _] = shown.at(0, 0);
        assert!(r == g && g == b && r > 0.0 && r < 0.25 * 2.0);
        assert_eq!(picture.at(1, 2)[2], f32::INFINITY);
    }
}
