//! How does a linear value become the four bytes of a texel?

use glam::Vec4;
use half::f16;

use crate::gpu::TextureFormat;

/// The bytes of a row of texels.
pub fn encode(texels: &[Vec4], format: TextureFormat) -> Vec<u8> {
    let texel = match format {
        TextureFormat::Rgba8Srgb => srgb,
        TextureFormat::Rgba8 => unorm,
        TextureFormat::Rg16Float => half_floats,
        TextureFormat::Rgb9E5 => shared_exponent,
    };
    texels.iter().flat_map(|value| texel(*value)).collect()
}

/// IEC 61966-2-1, alpha linear.
fn srgb(value: Vec4) -> [u8; 4] {
    let code = |linear: f32| {
        let linear = linear.clamp(0.0, 1.0);
        let encoded = if linear <= 0.003_130_8 {
            12.92 * linear
        } else {
            1.055 * linear.powf(1.0 / 2.4) - 0.055
        };
        to_byte(encoded)
    };
    [
        code(value.x),
        code(value.y),
        code(value.z),
        to_byte(value.w),
    ]
}

fn unorm(value: Vec4) -> [u8; 4] {
    value.to_array().map(to_byte)
}

/// To the nearest code.
fn to_byte(value: f32) -> u8 {
    // A cast from float saturates, and takes NaN to 0.
    (value * 255.0 + 0.5) as u8
}

fn half_floats(value: Vec4) -> [u8; 4] {
    let [x, y] = [value.x, value.y].map(|v| f16::from_f32(v).to_le_bytes());
    [x[0], x[1], y[0], y[1]]
}

/// Bits of each mantissa, the exponent's bias, and its largest value: Vulkan specification, "Conversion of RGB to
/// shared exponent floating-point".
const MANTISSA_BITS: i32 = 9;
const BIAS: i32 = 15;
const LARGEST_EXPONENT: i32 = 31;
/// The largest value: (2^9 - 1) / 2^9 * 2^(31 - 15).
const LARGEST: f32 = 65_408.0;

fn shared_exponent(value: Vec4) -> [u8; 4] {
    // A NaN stays one until the cast takes it to 0.
    let rgb = [value.x, value.y, value.z].map(|v| v.clamp(0.0, LARGEST));
    let largest = rgb.into_iter().fold(0.0, f32::max);
    let exponent = (exponent_of(largest) + 1 + BIAS).max(0);
    let step = |exponent: i32| (f64::from(exponent - BIAS - MANTISSA_BITS)).exp2();
    let mantissa = |value: f32, exponent| (f64::from(value) / step(exponent) + 0.5).floor();
    // Rounding may carry into the next power of two.
    let carries = mantissa(largest, exponent) >= f64::from(1 << MANTISSA_BITS);
    let exponent = (exponent + i32::from(carries)).min(LARGEST_EXPONENT);
    let [r, g, b] = rgb.map(|value| mantissa(value, exponent) as u32);
    (exponent.cast_unsigned() << 27 | b << 18 | g << 9 | r).to_le_bytes()
}

/// floor(log2 x), and -16 for what is smaller than 2^-16, which the format does not tell from 0 any more.
fn exponent_of(x: f32) -> i32 {
    const EXPONENT_BITS: u32 = 23;
    let exponent = (x.to_bits() >> EXPONENT_BITS & 0xff).cast_signed() - 127;
    exponent.max(-BIAS - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(bytes: [u8; 4]) -> [f64; 3] {
        let word = u32::from_le_bytes(bytes);
        let step = f64::from((word >> 27).cast_signed() - BIAS - MANTISSA_BITS).exp2();
        [0, 9, 18].map(|shift| f64::from(word >> shift & 0x1ff) * step)
    }

    #[test]
    fn srgb_codes_are_those_of_the_standard() {
        // IEC 61966-2-1: 0.5 is 187.5 and rounds up, 0.2140 is mid-grey 127.5.
        let code = |linear: f32| srgb(Vec4::splat(linear))[0];
        assert_eq!(
            [0.0, 0.0001, 0.214_04, 0.5, 1.0, 7.0].map(code),
            [0, 0, 127, 188, 255, 255]
        );
        assert_eq!(srgb(Vec4::splat(0.5))[3], 128, "alpha is linear");
        for byte in 0..=255_u8 {
            let encoded = f32::from(byte) / 255.0;
            let linear = if encoded <= 0.040_45 {
                encoded / 12.92
            } else {
                ((encoded + 0.055) / 1.055).powf(2.4)
            };
            assert_eq!(code(linear), byte);
        }
    }

    #[test]
    fn bytes_round_to_the_nearest_and_stop_at_the_ends() {
        assert_eq!(unorm(Vec4::new(-1.0, 0.5, 1.5, f32::NAN)), [0, 128, 255, 0]);
        assert_eq!(to_byte(0.6 / 255.0), 1);
        assert_eq!(to_byte(0.4 / 255.0), 0);
    }

    #[test]
    fn half_floats_come_back() {
        let bytes = half_floats(Vec4::new(-0.5, 0.25, 9.0, 9.0));
        let value = |i: usize| f16::from_le_bytes([bytes[i], bytes[i + 1]]).to_f32();
        assert_eq!((value(0), value(2)), (-0.5, 0.25));
    }

    #[test]
    fn a_shared_exponent_keeps_the_largest_to_9_bits() {
        for exponent in -14..16 {
            for share in [0.5, 0.500_1, 0.7, 0.998, 0.999_9] {
                let largest = (share * f64::from(exponent).exp2()) as f32;
                let value = Vec4::new(largest, largest * 0.3, 0.0, 1.0);
                let got = decoded(shared_exponent(value));
                for (got, want) in got.into_iter().zip([value.x, value.y, value.z]) {
                    // Half a step of the largest's: its mantissa is at least 2^8.
                    let error = (got - f64::from(want)).abs();
                    assert!(error <= f64::from(largest) / 512.0, "{got} for {want}");
                }
            }
        }
    }

    #[test]
    fn a_shared_exponent_holds_what_is_out_of_range_to_its_ends() {
        let decode = |value: [f32; 3]| {
            let [r, g, b] = value;
            decoded(shared_exponent(Vec4::new(r, g, b, 1.0)))
        };
        assert_eq!(decode([0.0, -1.0, f32::NAN]), [0.0; 3]);
        assert_eq!(decode([1e9, 65_408.0, 0.0]), [65_408.0, 65_408.0, 0.0]);
        assert_eq!(decode([1e-30, 0.0, 0.0]), [0.0; 3]);
        // The largest mantissa that would round up to 2^9 carries.
        assert_eq!(decode([1.0 - 1e-7, 0.0, 0.0])[0], 1.0);
    }
}
