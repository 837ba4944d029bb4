//! Are two pictures of a known distance that far apart?

use std::io::Cursor;

use image::{
    DynamicImage, GrayAlphaImage, ImageBuffer, ImageFormat, Rgb, Rgb32FImage, Rgba32FImage,
};
use umber::render::{Picture, ToneMapping, exposure_factor};
use umber::scene::{Still, StillPixels};
use umber::studies::{Display, NoDifference, Seen, difference, key_exposure};

use crate::textures::files::exr_bomb;
use crate::tolerances::{FLIP_CLOSED_FORM, THREE_DECIMALS, TONE_MAPPED};

const AS_IT_IS: Display = Display {
    ev100: 0.0,
    tone_mapping: ToneMapping::None,
};

fn codes(width: u32, pixels: Vec<[f32; 3]>) -> Seen {
    Seen::Codes {
        width,
        height: pixels.len() as u32 / width,
        pixels,
    }
}

fn linear(width: u32, pixels: Vec<[f32; 4]>) -> Seen {
    Seen::Linear(Picture {
        width,
        height: pixels.len() as u32 / width,
        pixels,
    })
}

/// EV100 at which 1 stands for white: 1.2 * 2^EV is 1.
fn unit() -> f32 {
    -(1.2_f32.log2())
}

#[test]
fn a_picture_is_no_distance_from_itself() {
    let pixels: Vec<_> = (0..64).map(|i| [i as f32, 255.0 - i as f32, 7.5]).collect();
    let row = difference(&codes(8, pixels.clone()), &codes(8, pixels), AS_IT_IS);
    let row = row.expect("a comparison").row;
    assert_eq!(
        (row.flip.mean, row.flip.largest, row.psnr_db),
        (0.0, 0.0, None)
    );
    assert_eq!((row.codes.gap.largest, row.codes.gap.mean), (0.0, 0.0));
    assert_eq!((row.codes.over_one, row.linear), (0.0, None));
}

#[test]
fn one_code_off_is_one_code_off() {
    let a = vec![[10.0, 20.0, 30.0]; 100];
    let mut b = a.clone();
    b[37][1] = 21.0;
    let row = difference(&codes(10, a.clone()), &codes(10, b.clone()), AS_IT_IS);
    let row = row.expect("a comparison").row;
    assert_eq!((row.codes.gap.largest, row.codes.gap.at), (1.0, [7, 3]));
    assert_eq!(row.codes.gap.mean, 1.0 / 300.0);
    // Over 1 is not 1.
    assert_eq!(row.codes.over_one, 0.0);
    // A mean square of 1/300: 10 log10(255^2 * 300) = 72.902.
    let db = row.psnr_db.expect("a difference");
    assert!((db - 72.902).abs() <= THREE_DECIMALS, "{db}");
    assert_eq!(row.flip.at, [7, 3]);
    // Two codes in two places of three hundred.
    b[38][0] = 12.5;
    b[99][2] = 0.0;
    let row = difference(&codes(10, a), &codes(10, b), AS_IT_IS);
    let row = row.expect("a comparison").row;
    assert_eq!((row.codes.gap.largest, row.codes.gap.at), (30.0, [9, 9]));
    assert_eq!(row.codes.over_one, 2.0 / 300.0);
}

#[test]
fn black_and_white_are_0_decibels_and_almost_1_apart() {
    let picture = |code| codes(16, vec![[code; 3]; 256]);
    let done = difference(&picture(0.0), &picture(255.0), AS_IT_IS).expect("a comparison");
    assert_eq!(done.row.psnr_db, Some(0.0));
    assert_eq!(done.flip.len(), 256);
    let flip = done.row.flip;
    for value in [flip.mean, flip.p95, flip.largest] {
        // As in the test of FLIP itself.
        assert!((value - 0.967_379_8).abs() <= FLIP_CLOSED_FORM, "{value}");
    }
    assert_eq!(flip.at, [0, 0]);
}

/// The 95th of a hundred pixels counts, not the mean of two.
#[test]
fn a_percentile_is_a_pixels_value() {
    let a = vec![[0.0; 3]; 10_000];
    let with = |count: usize| {
        let mut b = a.clone();
        b[..count].fill([255.0; 3]);
        let row = difference(&codes(100, a.clone()), &codes(100, b), AS_IT_IS);
        row.expect("a comparison").row.flip
    };
    // What is seen of one white pixel is less than 500 pixels wide.
    assert_eq!(with(1).p95, 0.0);
    let flip = with(6_000);
    assert!(flip.p95 > 0.9 && flip.p95 <= flip.largest, "{flip:?}");
}

#[test]
fn linear_pictures_are_compared_as_they_are_and_as_they_are_shown() {
    let a = linear(4, vec![[0.25, 0.5, 1.0, 1.0]; 16]);
    let mut pixels = vec![[0.25, 0.5, 1.0, 1.0]; 16];
    // Brighter than white: the same code.
    pixels[5] = [0.25, 0.5, 3.0, 1.0];
    let display = Display {
        ev100: unit(),
        ..AS_IT_IS
    };
    let row = difference(&a, &linear(4, pixels.clone()), display);
    let row = row.expect("a comparison").row;
    let gap = row.linear.expect("both are linear");
    assert_eq!((gap.largest, gap.at, gap.mean), (2.0, [1, 1], 2.0 / 48.0));
    assert_eq!((row.codes.gap.largest, row.flip.largest), (0.0, 0.0));
    // Tone mapping tells them apart.
    let display = Display {
        tone_mapping: ToneMapping::Neutral,
        ..display
    };
    let row = difference(&a, &linear(4, pixels), display);
    assert!(row.expect("a comparison").row.codes.gap.largest > 5.0);
}

#[test]
fn a_linear_picture_beside_codes_is_shown_first() {
    let a = linear(4, vec![[1.0, 0.5, 0.0, 1.0]; 16]);
    let b = codes(4, vec![[255.0, 188.0, 0.0]; 16]);
    let display = Display {
        ev100: unit(),
        ..AS_IT_IS
    };
    for (a, b) in [(&a, &b), (&b, &a)] {
        let row = difference(a, b, display).expect("a comparison").row;
        assert_eq!((row.codes.gap.largest, row.linear), (0.0, None));
    }
}

#[test]
fn what_cannot_be_compared_is_said() {
    let picture = |pixels| codes(2, pixels);
    let small = picture(vec![[0.0; 3]; 4]);
    let large = picture(vec![[0.0; 3]; 6]);
    let sizes = difference(&small, &large, AS_IT_IS).map(|done| done.row);
    assert_eq!(sizes, Err(NoDifference::Sizes([2, 2], [2, 3])));
    let good = vec![[1.0; 4]; 6];
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for channel in 0..4 {
            let mut pixels = good.clone();
            pixels[3][channel] = bad;
            pixels[5][channel] = bad;
            let (good, bad) = (linear(2, good.clone()), linear(2, pixels));
            let error = |which| {
                Err(NoDifference::NotFinite {
                    which,
                    count: 2,
                    at: (1, 1),
                })
            };
            let row = |a, b| difference(a, b, AS_IT_IS).map(|done| done.row);
            assert_eq!(row(&bad, &good), error("first"));
            assert_eq!(row(&good, &bad), error("second"));
        }
    }
}

#[test]
fn the_exposure_shows_the_logarithmic_mean_as_18_percent() {
    let picture = |pixels: Vec<[f32; 4]>| Picture {
        width: pixels.len() as u32,
        height: 1,
        pixels,
    };
    // The geometric mean of 1 and 10,000 is 100; what has no light does not count.
    let pixels = vec![
        [1.0, 1.0, 1.0, 1.0],
        [1e4, 1e4, 1e4, 1.0],
        [0.0; 4],
        [-1.0; 4],
    ];
    let shown = f64::from(exposure_factor(key_exposure(&picture(pixels)))) * 100.0;
    assert!((shown - 0.18).abs() <= TONE_MAPPED, "{shown}");
    assert_eq!(key_exposure(&picture(vec![[0.0; 4]; 3])), 0.0);
    let ev = key_exposure(&picture(vec![[f32::NAN; 4], [1.0; 4]]));
    assert!(ev.is_finite());
    let dim = key_exposure(&picture(vec![[1e-45; 4]]));
    assert_eq!(dim, -100.0);
}

/// What `Still::read` makes of a file of these bytes.
fn read(bytes: &[u8]) -> Result<Still, umber::scene::Error> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("picture");
    std::fs::write(&path, bytes).expect("a written file");
    Still::read(&path)
}

#[test]
fn a_file_is_read_as_what_it_holds() {
    let bytes = |image: DynamicImage, format| {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, format).expect("a picture");
        read(&bytes.into_inner())
            .expect("a readable picture")
            .pixels
    };
    let grey = GrayAlphaImage::from_raw(2, 1, vec![200, 255, 200, 51]).expect("two pixels");
    let over_black = StillPixels::Codes(vec![[200.0; 3], [40.0; 3]]);
    assert_eq!(bytes(grey.into(), ImageFormat::Png), over_black);
    let deep = ImageBuffer::<Rgb<u16>, _>::from_raw(1, 1, vec![65_535, 257, 128]).expect("a pixel");
    let codes = StillPixels::Codes(vec![[255.0, 1.0, 128.0 / 257.0]]);
    assert_eq!(bytes(deep.into(), ImageFormat::Png), codes);
    let clear = Rgba32FImage::from_raw(1, 1, vec![-1.0, 1e30, 0.5, 0.25]).expect("a pixel");
    let linear = StillPixels::Linear(vec![[-1.0, 1e30, 0.5, 0.25]]);
    assert_eq!(bytes(clear.into(), ImageFormat::OpenExr), linear);
    let bright = Rgb32FImage::from_raw(1, 1, vec![2.0, 1.0, 0.5]).expect("a pixel");
    let linear = StillPixels::Linear(vec![[2.0, 1.0, 0.5, 1.0]]);
    assert_eq!(bytes(bright.into(), ImageFormat::Hdr), linear);
    let broken = Rgb32FImage::from_raw(1, 1, vec![f32::INFINITY, f32::NAN, 0.5]).expect("a pixel");
    let StillPixels::Linear(pixels) = bytes(broken.into(), ImageFormat::OpenExr) else {
        panic!("an EXR is linear");
    };
    assert!(pixels[0][0].is_infinite() && pixels[0][1].is_nan());
}

#[test]
fn a_hostile_file_is_refused() {
    for bytes in [&b""[..], b"P6 1 1 255\n", b"\x89PNG\r\n\x1a\n"] {
        assert!(read(bytes).is_err());
    }
    let error = read(&exr_bomb()).expect_err("30000 x 30000 pixels");
    assert!(error.to_string().contains("30000 x 30000"), "{error}");
}
