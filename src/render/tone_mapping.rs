//! How does radiance become the 8-bit codes of a screen?

use super::picture::Picture;

/// How values beyond the screen's range are brought into it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum ToneMapping {
    /// Cut off at 1.
    None,
    /// Khronos PBR Neutral (2024): leaves colours up to 0.8 as they are but for a small toe, and
    /// compresses what is brighter.
    #[default]
    Neutral,
}

/// The factor from luminance to display value: 1 stands for 1.2 * 2^EV100 cd/m^2 (Lagarde and de
/// Rousiers 2014, section 5.1, from ISO 12232's saturation speed).
pub fn exposure_factor(ev100: f32) -> f32 {
    1.0 / (1.2 * ev100.exp2())
}

/// sRGB codes of a picture over black, rows from the top. Encoded here, once: the target is linear.
/// A NaN becomes 0, infinity 255.
pub fn srgb_codes(picture: &Picture, ev100: f32, tone_mapping: ToneMapping) -> Vec<u8> {
    let factor = exposure_factor(ev100);
    picture
        .pixels
        .iter()
        .flat_map(|[r, g, b, _]| {
            let exposed = [r, g, b].map(|value| value * factor);
            let shown = match tone_mapping {
                ToneMapping::None => exposed,
                ToneMapping::Neutral => neutral(exposed),
            };
            shown.map(srgb_code)
        })
        .collect()
}

/// Khronos PBR Neutral tone mapper, as its specification states it (Khronos 2024, "PBR Neutral Tone
/// Mapper"): F90 = 0.04 is subtracted from what a white dielectric adds, values above 0.8 - F90 are
/// compressed, and bright colours lose saturation at rate 0.15.
fn neutral(color: [f32; 3]) -> [f32; 3] {
    const F90: f32 = 0.04;
    const START: f32 = 0.8 - F90;
    const DESATURATION: f32 = 0.15;
    // The specification's curve has no value at infinity; 1e6 is white there to the last bit.
    let color = color.map(|value| value.clamp(0.0, 1e6));
    let least = color.iter().copied().fold(f32::INFINITY, f32::min);
    // The toe meets the offset at 2 * F90, where x - x^2 / (4 * F90) = F90.
    let offset = if least < 2.0 * F90 {
        least - least * least / (4.0 * F90)
    } else {
        F90
    };
    let color = color.map(|value| value - offset);
    let peak = color.iter().copied().fold(0.0, f32::max);
    if peak < START {
        return color;
    }
    let room = 1.0 - START;
    let new_peak = 1.0 - room * room / (peak + room - START);
    let white = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    color.map(|value| {
        let scaled = value * new_peak / peak;
        scaled + (new_peak - scaled) * white
    })
}

/// IEC 61966-2-1, rounded to the nearest of 256 codes.
fn srgb_code(linear: f32) -> u8 {
    let encoded = if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    };
    // `as` saturates, and turns NaN into 0.
    (encoded * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_codes_are_the_standards() {
        // Middle grey 0.2140 is code 127.5 or so by the standard's curve; the ends are exact.
        for (linear, code) in [
            (0.0, 0),
            (1.0, 255),
            (0.5, 188),
            (0.214, 127),
            (0.002, 7),
            (0.02, 39),
        ] {
            assert_eq!(srgb_code(linear), code, "{linear}");
        }
        assert_eq!(srgb_code(-1.0), 0);
        assert_eq!(srgb_code(7.0), 255);
        assert_eq!(srgb_code(f32::NAN), 0);
        assert_eq!(srgb_code(f32::INFINITY), 255);
    }

    #[test]
    fn neutral_keeps_mid_colours_and_stays_in_range() {
        // Above the toe and below the start, the offset alone.
        let kept = neutral([0.5, 0.3, 0.2]);
        for (got, want) in kept.into_iter().zip([0.46, 0.26, 0.16]) {
            assert!((got - want).abs() < 1e-6);
        }
        let mut last = 0.0;
        for step in 0..200 {
            let value = 1.05_f32.powi(step) * 1e-3;
            let [r, g, b] = neutral([value, 0.5 * value, 0.25 * value]);
            assert!(r >= last && r <= 1.0 && r >= g && g >= b, "{value}");
            last = r;
        }
        assert!(last > 0.95);
        assert!(
            neutral([f32::INFINITY; 3])
                .iter()
                .all(|v| (0.99..=1.0).contains(v))
        );
    }

    /// By hand, from the specification's formula; above 0.8 - F90 = 0.76, d = 1 - 0.76 = 0.24.
    #[test]
    fn neutral_compresses_and_desaturates_as_the_specification_says() {
        let cases = [
            // White: min 1 >= 0.08, so less 0.04: 0.96. Its peak becomes
            // 1 - 0.24^2 / (0.96 + 0.24 - 0.76) = 1 - 0.0576 / 0.44 = 0.869091; grey stays grey.
            ([1.0, 1.0, 1.0], [0.869_091, 0.869_091, 0.869_091]),
            // In the toe: min 0.04, less 0.04 - 6.25 * 0.04^2 = 0.03: (0.97, 0.47, 0.01). The peak
            // becomes 1 - 0.0576 / 0.45 = 0.872, all are scaled by 0.872 / 0.97 = 0.898969: (0.872,
            // 0.422515, 0.008990). White share 1 - 1 / (0.15 (0.97 - 0.872) + 1) = 1 - 1 / 1.0147 =
            // 0.014487: 0.422515 + 0.449485 * 0.014487 = 0.429027, 0.008990 + 0.863010 * 0.014487.
            ([1.0, 0.5, 0.04], [0.872, 0.429_027, 0.021_492]),
            // Bright orange, visibly paler: (4, 2, 0.5). The peak becomes 1 - 0.0576 / 3.48 =
            // 0.983448, the scale 0.245862: (0.983448, 0.491724, 0.122931). White share 1 - 1 /
            // (0.15 * 3.016552 + 1) = 1 - 1 / 1.452483 = 0.311524: 0.491724 + 0.491724 * 0.311524 =
            // 0.644908, 0.122931 + 0.860517 * 0.311524 = 0.391003. Blue to red was 1:8, is 2:5.
            ([4.04, 2.04, 0.54], [0.983_448, 0.644_908, 0.391_003]),
        ];
        for (color, want) in cases {
            for (got, want) in neutral(color).into_iter().zip(want) {
                // A unit of the last digit written above.
                assert!((got - want).abs() < 2e-6, "{color:?}: {got} for {want}");
            }
        }
    }

    #[test]
    fn what_is_no_number_is_black_or_white_and_touches_no_other_channel() {
        let codes = |pixel, tone_mapping| {
            let picture = Picture {
                width: 1,
                height: 1,
                pixels: vec![pixel],
            };
            srgb_codes(&picture, -0.263_034_4, tone_mapping)
        };
        // 1.2 * 2^EV100 is 1.
        for tone_mapping in [ToneMapping::None, ToneMapping::Neutral] {
            let good = codes([0.5, 0.3, 0.2, 1.0], tone_mapping);
            let nan = codes([f32::NAN, 0.3, 0.2, 1.0], tone_mapping);
            assert_eq!(nan, [0, good[1], good[2]]);
            let infinite = codes([f32::INFINITY; 4], tone_mapping);
            assert_eq!(infinite, [255; 3]);
            assert_eq!(
                codes([-1.0, f32::NEG_INFINITY, 0.0, 1.0], tone_mapping),
                [0; 3]
            );
        }
    }

    #[test]
    fn exposure_puts_its_luminance_at_one() {
        assert!((exposure_factor(10.0) * 1.2 * 1024.0 - 1.0).abs() < 1e-6);
        let picture = Picture {
            width: 1,
            height: 1,
            pixels: vec![[1228.8, 614.4, 0.0, 1.0]],
        };
        assert_eq!(srgb_codes(&picture, 10.0, ToneMapping::None), [255, 188, 0]);
    }
}
