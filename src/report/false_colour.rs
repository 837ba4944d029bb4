//! How do numbers of 0 to 1 become a picture that a person reads?

use std::io::Cursor;

use image::{ExtendedColorType, ImageEncoder, ImageError};

/// matplotlib's map `magma` (Smith and van der Walt 2015, CC0) at every sixteenth: black, violet, red, pale yellow, each step as
/// large to the eye as the next.
const MAGMA: [[u8; 3]; 17] = [
    [0, 0, 4],
    [10, 8, 34],
    [29, 17, 70],
    [54, 16, 106],
    [80, 18, 124],
    [105, 28, 129],
    [130, 38, 129],
    [156, 46, 127],
    [182, 55, 121],
    [207, 65, 112],
    [230, 81, 99],
    [245, 105, 92],
    [251, 135, 97],
    [254, 165, 113],
    [254, 195, 135],
    [253, 224, 162],
    [252, 253, 191],
];

/// The colour of a number, sRGB codes: black at 0 and below, pale yellow at 1 and above.
pub fn magma(level: f32) -> [u8; 3] {
    let steps = (MAGMA.len() - 1) as f32;
    let place = level.clamp(0.0, 1.0) * steps;
    let below = (place as usize).min(MAGMA.len() - 2);
    let share = place - below as f32;
    std::array::from_fn(|channel| {
        let [low, high] = [MAGMA[below], MAGMA[below + 1]].map(|c| f32::from(c[channel]));
        (low + (high - low) * share).round() as u8
    })
}

/// A PNG of a map of numbers, row by row from the top.
///
/// # Errors
/// The encoder refuses the size.
///
/// # Panics
/// The map has not `width` times `height` numbers.
pub fn magma_png(map: &[f32], width: u32, height: u32) -> Result<Vec<u8>, ImageError> {
    let codes: Vec<u8> = map.iter().flat_map(|level| magma(*level)).collect();
    let mut bytes = Cursor::new(Vec::new());
    image::codecs::png::PngEncoder::new(&mut bytes).write_image(
        &codes,
        width,
        height,
        ExtendedColorType::Rgb8,
    )?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_map_goes_through_its_steps_and_gets_brighter() {
        assert_eq!(magma(-1.0), MAGMA[0]);
        assert_eq!(magma(0.5), MAGMA[8]);
        assert_eq!(magma(1.0), MAGMA[16]);
        assert_eq!(magma(7.0), MAGMA[16]);
        // Half way from the first to the second.
        assert_eq!(magma(1.0 / 32.0), [5, 4, 19]);
        let sum = |level: f32| magma(level).map(u32::from).iter().sum::<u32>();
        let steps: Vec<_> = (0..=32).map(|i| sum(i as f32 / 32.0)).collect();
        assert!(steps.is_sorted(), "{steps:?}");
    }

    #[test]
    fn a_map_is_a_picture_of_its_size() {
        let png = magma_png(&[0.0, 1.0], 2, 1).expect("a picture");
        let read = image::load_from_memory(&png).expect("a PNG").into_rgb8();
        assert_eq!(read.dimensions(), (2, 1));
        assert_eq!(read.into_raw(), [MAGMA[0], MAGMA[16]].concat());
    }
}
