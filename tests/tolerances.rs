//! How far may a result be from its truth, and why that far?

#![allow(
    dead_code,
    reason = "each of the two test binaries uses its own part of the table"
)]

use std::ops::Neg;

use umber::reference::ladders::{Diffuse, Mix, Specular};
use umber::reference::shade::Lighting;

/// Two f64 forms of one formula, relative: some tens of operations of 1e-16 each, and angles taken through
/// atan2 whose tangents grow near 90 degrees (samples stop at 89.5: a factor of 115).
pub const SAME_FORMULA: f64 = 1.0e-12;

/// As above where 1 - (N.H)^2 or 1 - H.E is formed by subtraction, as the slides' listing does: what is left of
/// 1e-16 after division by the least m^2 of the samples (0.01) and multiplication by slopes up to 115^2.
pub const SAME_FORMULA_CANCELLING: f64 = 1.0e-8;

/// As SAME_FORMULA where a power or an exponential multiplies it: exp(-tan^2 / m^2) with m >= 0.1 by up to
/// twice its exponent, some hundreds where the result is not yet 0; shininess 40; a cone 5 degrees wide.
pub const SAME_FORMULA_PEAKED: f64 = 1.0e-10;

/// A lobe at vectors normalised in 32 bits against the same at their unit vectors: lengths are off by 1.2e-7 at most,
/// and for roughness 0.3 and more, cosines of 0.2 and more, D changes by 40 times as much.
pub const GIVEN_BY_PAPER: f64 = 1.0e-5;

/// A truth in f64 against 200 bits: its worst is the exponential, 100 times 1e-15.
pub const GIVEN_BY_DIGITS: f64 = 1.0e-12;

/// A truth in f64 with light and eye swapped: the same sums in another order, a thousand times 1e-15 near grazing.
pub const GIVEN_SWAPPED: f64 = 1.0e-12;

/// Values at two directions 2e-9 radians apart, relative: a function without a jump, of slope below 5.
pub const CONTINUOUS: f64 = 1.0e-8;

/// How far a share of seeded trials may lie from its probability, in standard deviations of the binomial: beyond
/// four lies one seed in 16,000, and the seeds are fixed.
pub const BINOMIAL_DEVIATIONS: f64 = 4.0;

/// A midpoint sum of 1000 by 1000 points over a kink: of the order of the step squared.
pub const MIDPOINT_SUM: f64 = 1.0e-5;

/// An integral of a smooth function by 16 Gauss nodes an interval, relative.
pub const QUADRATURE_SMOOTH: f64 = 1.0e-9;

/// An integral over half vectors, absolute: the lobe's kinks (where G begins to fall, where the light sets) lie
/// across the intervals, each 1/8 of the range with 16 nodes.
pub const QUADRATURE_KINKED: f64 = 3.0e-4;

/// Figures that are stated to three decimals: a unit of the last, since some are cut and not rounded.
pub const THREE_DECIMALS: f64 = 1.0e-3;

/// Figures that are stated to two decimals.
pub const TWO_DECIMALS: f64 = 5.0e-3;

/// Figures that are stated to four decimals, at the samples' step of 1e-4.
pub const FOUR_DECIMALS: f64 = 1.0e-4;

/// Figures that are stated to five decimals.
pub const FIVE_DECIMALS: f64 = 5.0e-6;

/// A texel against its definition in f64: a handful of f32 roundings and a power of 2.4.
pub const TEXEL: f64 = 1.0e-6;

/// A flat colour that was a JPEG, in codes of 8 bits: a rounding to YCbCr and one back, each of up to a code.
pub const JPEG_CODES: f64 = 2.0;

/// A tangent's length and angle to its normal: some tens of f32 roundings.
pub const TANGENT: f64 = 1.0e-5;

/// The share of sky that the ambient reflection takes, against the integral of its lobe: what the fit reaches.
pub const SKY_SHARE_WORST: f64 = 0.17;
/// The same in the mean square over roughness, view and tilt.
pub const SKY_SHARE_RMS: f64 = 0.06;

/// Schlick's curve against Fresnel's for glass of index 1.5, absolute, at its worst angle (85 degrees).
pub const SCHLICK_GLASS: f64 = 0.037;

/// A bound relative to the truth, with a floor for truths near 0.
#[derive(Clone, Copy, Debug)]
pub struct Relative {
    /// Of the truth.
    pub relative: f64,
    /// Added to it, in the values' own unit.
    pub absolute: f64,
}

impl Relative {
    /// How much of the tolerance a result takes: up to 1 it holds. A NaN takes all and more.
    pub fn share(&self, got: f64, want: f64) -> f64 {
        let share = (got - want).abs() / (self.relative * want.abs() + self.absolute);
        if share.is_nan() { f64::INFINITY } else { share }
    }

    /// Whether `got` is near enough to `want`.
    pub fn holds(&self, got: f64, want: f64) -> bool {
        self.share(got, want) <= 1.0
    }
}

/// Below it a radiance is noise: 1e-6 of the lights of the tests, which are around 1 lx.
const FLOOR: f64 = 1.0e-6;

/// A corrected pixel of roughness 0.1 or more. Its f32 terms are good to 1.3e-6 on lavapipe; Vulkan
/// allows exp 3 + 2|x| units in the last place (2^-23), and the exponent reaches -50 where there is
/// anything left to compare: 103 x 1.2e-7.
pub const CORRECTED_PIXEL: Relative = Relative {
    relative: 1.5e-5,
    absolute: FLOOR,
};

/// A Phong pixel: pow(x, n) is exp2(n log2(x)), n reaches 198 here, and 3 units in the last place of
/// x (1.2e-7 each) are 198 times as many of the result.
pub const PHONG_PIXEL: Relative = Relative {
    relative: 1.0e-4,
    absolute: FLOOR,
};

/// A pixel of the slides' listing: Vulkan allows sin and cos 2^-11 (4.9e-4) each, and acos and tan are
/// made of them.
pub const LISTING_PIXEL: Relative = Relative {
    relative: 1.5e-3,
    absolute: FLOOR,
};

/// A corrected pixel near the peak of a lobe of the least width, 1e-3: 8e-7/m of f32 rounding, which is
/// 8e-4, and its slope there.
pub const SMOOTH_PIXEL: Relative = Relative {
    relative: 1.0e-3,
    absolute: FLOOR,
};

/// The tolerance of a lighting model.
pub fn pixel(lighting: Lighting) -> Relative {
    match lighting {
        Lighting::Phong => PHONG_PIXEL,
        Lighting::Slides => LISTING_PIXEL,
        Lighting::Mixed(mix) if has_listing(mix) => LISTING_PIXEL,
        Lighting::Mixed(Mix {
            specular: Specular::BlinnPhong,
            ..
        }) => PHONG_PIXEL,
        Lighting::Mixed(_) => CORRECTED_PIXEL,
    }
}

fn has_listing(mix: Mix) -> bool {
    mix.diffuse == Diffuse::Slides || mix.specular == Specular::Slides
}

/// A pixel of a sphere of `radius` pixels, times the cosine at which it is seen, under about 1 lx: a rasteriser snaps corners to 2^-`bits` pixel
/// (8 on lavapipe, 4 on SwiftShader), which turns the interpolated normal by that over the radius. Lambert
/// changes by as much, whatever its value; where a lobe is steep, by four times as much of its own.
pub fn curved_pixel(lighting: Lighting, bits: u32, radius: f64) -> Relative {
    let flat = pixel(lighting);
    let turn = f64::from(bits).neg().exp2() / radius;
    Relative {
        relative: flat.relative + 4.0 * turn,
        absolute: flat.absolute + turn,
    }
}

/// A blend of constants: a handful of f32 roundings.
pub const BLENDED_PIXEL: Relative = Relative {
    relative: 1.0e-6,
    absolute: 1.0e-7,
};

/// The share of 8-bit codes that may differ by more than one step from a golden picture: a triangle's
/// edge may fall on the other side of a pixel's middle on another driver or version.
pub const GOLDEN_SHARE: f64 = 0.01;

/// Two builds of one source, in the measure of `Picture::max_difference`: DESIGN's 1e-5 relative and 1e-6 absolute.
pub const SAME_PICTURE: f64 = 1.0e-5;

/// A pixel under a map of one value against the same numbers without a map: the value is stored in 8 bits (of 0.02, the
/// darkest here, sRGB's step is 4 %, half of it off at most; of a plain number 0.2 to 0.8 half a step is 0.002 / 0.2 = 1 %),
/// in 9 bits with a shared exponent, or as half floats; the lobe's peak is four times as steep as the roughness.
pub const MAPPED_PIXEL: Relative = Relative {
    relative: 0.02,
    absolute: 1.0e-3,
};

/// A texel of a PNG against its function, in 8-bit codes: a sine of another library may tip a rounding.
pub const PNG_CODES: f64 = 1.0;
/// The same in the mean over all codes: it tips few.
pub const PNG_MEAN: f64 = 0.01;

/// A texel of a JPEG of quality 90 against its function, in 8-bit codes: its tables hold steps of 2 to
/// 24, and at an edge the halves of some of them add up (31 at the tiles' sharpest).
pub const SAMPLE_JPEG_CODES: f64 = 40.0;
/// The same in the mean over all codes (3.03 of the tiles).
pub const JPEG_MEAN: f64 = 3.5;

/// A texel of a Radiance file against its function, relative to the largest of its three numbers:
/// that one's mantissa is 128 to 255 and cut, not rounded.
pub const RGBE_STEP: f64 = 1.0 / 128.0;

/// How far from 1 the length of a unit vector of 8-bit codes may be: each of three numbers is half a
/// code off, 1/255, and they add up to sqrt(3) of it at most.
pub const UNIT_OF_CODES: f64 = 0.007;

/// The step across a texture's seam against the largest inside: all lattices of its noise have a line
/// there, where they change fastest. Without a match the step would be several times as large.
pub const SEAM: f64 = 1.1;

/// The light that the inside of a bowl keeps under a lamp that sees all of it, on maps down to 256 texels a side: at its rim, where
/// the wall stands along the rays, a texel spans more of it than two planes tell (measured: 0.991).
pub const HOLLOW_LIGHT: f64 = 0.99;

/// Pixels of a lit corner that may be dark, of 20,736: where it ends, the texels farther out see past it, and do not tell the
/// wall's plane (measured: 1, in one of 68 cases).
pub const CORNER_PIXELS: usize = 2;

/// A furnace of eon on a device: 2e-7 of rounding, and 1e-5 of the rule over directions; four digits are what is promised.
pub const EON_FURNACE: f64 = 1.0e-4;

/// A furnace of ggx-multi: what the polynomial is off at worst (8.2e-4), and the quadrature behind it.
pub const GGX_FURNACE: f64 = 1.0e-3;

/// The largest error of the polynomial's numbers over that of numbers fitted anew, on half as many nodes: those were fitted on other
/// nodes, to seven digits.
pub const GGX_REFIT: f64 = 1.1;

/// A metal's curve of four terms against the integral over wavelength, absolute, at any angle: what was asked of it.
pub const SPECTRAL_FIT: f64 = 2.0e-3;

/// Walter's rational form of Smith's visible share, relative: 3.1e-3 at its worst.
pub const SMITH_RATIONAL: f64 = 3.2e-3;

/// Blinn's (n + 8) / (8 pi) is exact for none of the exponents: straight on it gives back 12 % too little or too much at worst.
pub const BLINN_NORMALISATION: f64 = 0.12;

/// A simulation against its formula, in standard errors in the mean square over 252 cells: 1 where the formula is true; the batches
/// themselves know their error to an eighth, and few cells are rare events.
pub const STANDARD_ERRORS: f64 = 1.6;

/// FLIP of even pictures against its formula: some tens of f32 roundings, under powers of 0.7 and a distance of up to 200; of two
/// greys a code apart the difference of lightness is 0.4, and 1e-5 of it rounding.
pub const FLIP_CLOSED_FORM: f64 = 2.0e-5;

/// FLIP of a pixel against the program of its authors, both in f32: the exponent holds the square root of a difference of edges, of
/// which 1e-7 is rounding; where nothing differs at an edge that is 3e-4 of an exponent, and x ln x is at most 0.37.
pub const FLIP_OF_AUTHORS: f64 = 3.0e-4;
/// The same in the mean.
pub const FLIP_OF_AUTHORS_MEAN: f64 = 2.0e-5;

/// A colour of the map that shows FLIP, in 8-bit codes: straight lines between every sixteenth of its entries.
pub const FLIP_MAGMA_CODES: f64 = 3.0;

/// A value that was exposed in f32: the power of two and a product.
pub const TONE_MAPPED: f64 = 1.0e-5;
