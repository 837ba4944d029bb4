//! How far are two pictures apart, in numbers and to a person who sees them?
//!
//! A picture is linear radiance, or the sRGB codes of a screen. Two are compared as they are shown: linear ones are exposed and
//! tone-mapped as `umber render` writes a PNG; and where both are linear, their own numbers are compared too.

use crate::math::flip::{PIXELS_PER_DEGREE, Shown, flip};
use crate::render::{Picture, ToneMapping, exposure_factor, srgb_codes};
use crate::report::{CodesRow, DifferenceRow, FlipRow, GapRow};
use crate::scene::{Still, StillPixels};

/// A picture to compare.
#[derive(Clone, PartialEq, Debug)]
pub enum Seen {
    /// What a frame leaves.
    Linear(Picture),
    /// What a screen shows.
    Codes {
        /// Pixels a row.
        width: u32,
        /// Rows.
        height: u32,
        /// sRGB codes, 0 to 255, whole or not; row by row from the top.
        pixels: Vec<[f32; 3]>,
    },
}

impl From<Still> for Seen {
    fn from(still: Still) -> Self {
        let Still {
            width,
            height,
            pixels,
        } = still;
        match pixels {
            StillPixels::Linear(pixels) => Self::Linear(Picture {
                width,
                height,
                pixels,
            }),
            StillPixels::Codes(pixels) => Self::Codes {
                width,
                height,
                pixels,
            },
        }
    }
}

impl Seen {
    /// Width and height, pixels.
    pub fn size(&self) -> [u32; 2] {
        match self {
            Self::Linear(picture) => [picture.width, picture.height],
            Self::Codes { width, height, .. } => [*width, *height],
        }
    }

    fn codes(&self, display: Display) -> Vec<[f32; 3]> {
        match self {
            Self::Linear(picture) => {
                let codes = srgb_codes(picture, display.ev100, display.tone_mapping);
                let (pixels, _) = codes.as_chunks();
                pixels.iter().map(|rgb| rgb.map(f32::from)).collect()
            }
            Self::Codes { pixels, .. } => pixels.clone(),
        }
    }
}

/// How linear numbers become codes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Display {
    /// EV at ISO 100, -100 to 100.
    pub ev100: f32,
    /// How bright values are brought into range.
    pub tone_mapping: ToneMapping,
}

/// Why two pictures cannot be compared.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum NoDifference {
    /// One is larger.
    #[error("the first has {} x {} pixels, the second {} x {}", .0[0], .0[1], .1[0], .1[1])]
    Sizes([u32; 2], [u32; 2]),
    /// One holds what is no number.
    #[error("the {which} holds {count} pixels with a NaN or an infinity; the first at column {}, row {}", .at.0, .at.1)]
    NotFinite {
        /// `first` or `second`.
        which: &'static str,
        /// How many pixels.
        count: usize,
        /// Column and row of the first.
        at: (u32, u32),
    },
}

/// Two pictures, compared.
#[derive(Clone, PartialEq, Debug)]
pub struct Compared {
    /// The figures.
    pub row: DifferenceRow,
    /// FLIP of each pixel, 0 to 1, row by row from the top.
    pub flip: Vec<f32>,
}

/// Compares two pictures of one size.
///
/// # Errors
/// The sizes differ, or a picture holds a NaN or an infinity.
pub fn difference(a: &Seen, b: &Seen, display: Display) -> Result<Compared, NoDifference> {
    let size @ [width, _] = a.size();
    if size != b.size() {
        return Err(NoDifference::Sizes(size, b.size()));
    }
    finite(a, "first")?;
    finite(b, "second")?;
    let shown = [a, b].map(|picture| picture.codes(display));
    let [of_a, of_b] = [&shown[0], &shown[1]].map(|pixels| Shown {
        width: width as usize,
        pixels,
    });
    let map = flip(of_a, of_b, PIXELS_PER_DEGREE);
    let [codes_a, codes_b] = &shown;
    let row = DifferenceRow {
        flip: flip_row(&map, width),
        psnr_db: psnr_db(codes_a.as_flattened(), codes_b.as_flattened()),
        codes: codes_row(codes_a, codes_b, width),
        linear: match (a, b) {
            (Seen::Linear(a), Seen::Linear(b)) => {
                let rgb = |picture: &Picture| -> Vec<[f32; 3]> {
                    picture
                        .pixels
                        .iter()
                        .map(|[r, g, b, _]| [*r, *g, *b])
                        .collect()
                };
                Some(gap_row(&rgb(a), &rgb(b), width))
            }
            _ => None,
        },
    };
    Ok(Compared { row, flip: map })
}

/// Refuses a picture that holds what is no number.
fn finite(picture: &Seen, which: &'static str) -> Result<(), NoDifference> {
    let Seen::Linear(picture) = picture else {
        return Ok(());
    };
    let defects = picture.defects();
    match defects.first {
        None => Ok(()),
        Some(at) => Err(NoDifference::NotFinite {
            which,
            count: defects.not_finite(),
            at,
        }),
    }
}

/// The exposure at which the logarithmic mean of a picture's luminance is shown as 18 % (Reinhard, Stark, Shirley and Ferwerda
/// 2002, section 3), over the pixels that have light and are finite; EV100, 0 where none has.
pub fn key_exposure(picture: &Picture) -> f32 {
    const KEY: f64 = 0.18;
    let mut sum = 0.0;
    let mut count = 0_u32;
    for [r, g, b, _] in &picture.pixels {
        let [r, g, b] = [r, g, b].map(|value| f64::from(*value));
        // Luminance of linear sRGB (IEC 61966-2-1).
        let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        if luminance > 0.0 && luminance.is_finite() {
            sum += luminance.log2();
            count += 1;
        }
    }
    if count == 0 {
        return 0.0;
    }
    let factor = f64::from(exposure_factor(0.0));
    (sum / f64::from(count) + (factor / KEY).log2()).clamp(-100.0, 100.0) as f32
}

fn flip_row(map: &[f32], width: u32) -> FlipRow {
    let sum: f64 = map.iter().map(|x| f64::from(*x)).sum();
    let mut sorted = map.to_vec();
    let rank = (map.len() * 95).div_ceil(100).max(1) - 1;
    let (_, p95, _) = sorted.select_nth_unstable_by(rank, f32::total_cmp);
    let p95 = f64::from(*p95);
    let (place, largest) = first_largest(map.iter().map(|x| f64::from(*x)));
    FlipRow {
        mean: sum / map.len() as f64,
        p95,
        largest,
        at: at(place, width),
        pixels_per_degree: PIXELS_PER_DEGREE,
    }
}

fn gap_row(a: &[[f32; 3]], b: &[[f32; 3]], width: u32) -> GapRow {
    let gaps = || gaps(a.as_flattened(), b.as_flattened());
    let (place, largest) = first_largest(gaps());
    GapRow {
        largest,
        at: at(place / 3, width),
        mean: gaps().sum::<f64>() / (3 * a.len()) as f64,
    }
}

fn codes_row(a: &[[f32; 3]], b: &[[f32; 3]], width: u32) -> CodesRow {
    let over = gaps(a.as_flattened(), b.as_flattened()).filter(|gap| *gap > 1.0);
    CodesRow {
        gap: gap_row(a, b, width),
        over_one: over.count() as f64 / (3 * a.len()) as f64,
    }
}

fn psnr_db(a: &[f32], b: &[f32]) -> Option<f64> {
    let squares: f64 = gaps(a, b).map(|gap| gap * gap).sum();
    let mean = squares / a.len() as f64;
    (mean > 0.0).then(|| 10.0 * (255.0 * 255.0 / mean).log10())
}

fn gaps(a: &[f32], b: &[f32]) -> impl Iterator<Item = f64> {
    a.iter()
        .zip(b)
        .map(|(a, b)| (f64::from(*a) - f64::from(*b)).abs())
}

/// The first of the largest, and where it is.
fn first_largest(values: impl Iterator<Item = f64>) -> (usize, f64) {
    let larger = |best: (usize, f64), new: (usize, f64)| if new.1 > best.1 { new } else { best };
    values.enumerate().fold((0, 0.0), larger)
}

/// Column and row of a pixel.
fn at(place: usize, width: u32) -> [u32; 2] {
    let place = place as u32;
    [place % width, place / width]
}
