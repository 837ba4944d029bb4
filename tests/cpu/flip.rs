//! Is FLIP what its paper defines, and what its authors' own program computes?

use umber::math::flip::{PIXELS_PER_DEGREE, Shown, flip};
use umber::report::magma;

use crate::tolerances::{
    FLIP_CLOSED_FORM, FLIP_MAGMA_CODES, FLIP_OF_AUTHORS, FLIP_OF_AUTHORS_MEAN,
};

const WIDTH: usize = 61;
const HEIGHT: usize = 83;

type Codes = Vec<[u8; 3]>;

fn ours(a: &Codes, b: &Codes, width: usize) -> Vec<f32> {
    let codes = [a, b].map(|codes| -> Vec<_> { codes.iter().map(|c| c.map(f32::from)).collect() });
    let [a, b] = [&codes[0], &codes[1]].map(|pixels| Shown { width, pixels });
    flip(a, b, PIXELS_PER_DEGREE)
}

fn theirs(a: &Codes, b: &Codes, width: usize) -> Vec<f32> {
    let [a, b] = [a, b].map(|codes| {
        let height = codes.len() / width;
        nv_flip::FlipImageRgb8::with_data(width as u32, height as u32, codes.as_flattened())
    });
    nv_flip::flip(a, b, PIXELS_PER_DEGREE as f32).to_vec()
}

fn flat(code: [u8; 3]) -> Codes {
    vec![code; WIDTH * HEIGHT]
}

/// Waves, hard edges, single points and noise, in colour: all that the filters look for.
fn busy(seed: u64) -> Codes {
    let mut random = fastrand::Rng::with_seed(seed);
    let pixel = |i: usize| {
        let (x, y) = ((i % WIDTH) as f32, (i / WIDTH) as f32);
        let wave = 100.0 + 90.0 * (0.31 * x + 0.02 * y * y * seed as f32).sin();
        let edge = if (x - 30.0) * (y - 40.0) > 120.0 * seed as f32 {
            55.0
        } else {
            0.0
        };
        let point = if random.u32(0..97) == 0 { 255.0 } else { 0.0 };
        let noise = random.f32() * 20.0;
        [wave + edge, 0.5 * wave + noise, 255.0 - wave + edge]
            .map(|code| f32::max(code, point) as u8)
    };
    (0..WIDTH * HEIGHT).map(pixel).collect()
}

/// Two even pictures differ in colour alone: no edge, no point, nothing to blur. In the paper's section 4 black and white are 100
/// apart in lightness, and green and blue are the most that there is, by definition 1.
#[test]
fn even_pictures_have_the_values_of_the_formula() {
    let [black, white] = [[0; 3], [255; 3]];
    let [red, green, blue] = [[255, 0, 0], [0, 255, 0], [0, 0, 255]];
    // 41.2761 is the distance of green and blue to 0.7: (100^0.7 - 0.4 * 41.2761) / (0.6 * 41.2761) of the last 5 %.
    let cases = [
        (black, white, 0.967_379_8),
        (green, blue, 1.0),
        (red, green, 0.986_662_3),
        ([128; 3], [129; 3], 0.029_855_2),
        (red, red, 0.0),
    ];
    for (a, b, want) in cases {
        for (a, b) in [(a, b), (b, a)] {
            for got in ours(&flat(a), &flat(b), WIDTH) {
                assert!(
                    (f64::from(got) - want).abs() <= FLIP_CLOSED_FORM,
                    "{a:?} {b:?}: {got}"
                );
            }
        }
    }
}

#[test]
fn every_pixel_is_what_the_authors_program_says() {
    let shifted: Codes = busy(1)
        .into_iter()
        .cycle()
        .skip(1)
        .take(WIDTH * HEIGHT)
        .collect();
    let mut one_off = busy(1);
    one_off[WIDTH * 40 + 30][1] ^= 1;
    let mut dot = flat([90, 100, 110]);
    dot[WIDTH * 2 + 1] = [255, 255, 0];
    let pairs = [
        ("another", busy(1), busy(2)),
        ("shifted by a column", busy(1), shifted),
        ("one code off", busy(1), one_off),
        ("a point near the corner", flat([90, 100, 110]), dot),
        ("black and white", flat([0; 3]), flat([255; 3])),
    ];
    for (name, a, b) in &pairs {
        let (own, other) = (ours(a, b, WIDTH), theirs(a, b, WIDTH));
        let gaps = own
            .iter()
            .zip(&other)
            .map(|(a, b)| f64::from((a - b).abs()));
        let worst = gaps.clone().fold(0.0, f64::max);
        let mean = gaps.sum::<f64>() / own.len() as f64;
        println!("{name}: off by {worst:.1e} at most, {mean:.1e} in the mean");
        assert!(worst <= FLIP_OF_AUTHORS, "{name}: {worst:e}");
        assert!(mean <= FLIP_OF_AUTHORS_MEAN, "{name}: {mean:e}");
    }
}

/// Bands and threads must not show: pictures of any height, down to one pixel.
#[test]
fn any_size_will_do() {
    for (width, height) in [(1, 1), (1, 200), (200, 1), (7, 64), (5, 65), (3, 257)] {
        let mut random = fastrand::Rng::with_seed(7);
        let mut picture = || -> Codes { (0..width * height).map(|_| [random.u8(..); 3]).collect() };
        let (a, b) = (picture(), picture());
        let gaps = ours(&a, &b, width).into_iter().zip(theirs(&a, &b, width));
        let worst = gaps
            .map(|(a, b)| f64::from((a - b).abs()))
            .fold(0.0, f64::max);
        assert!(worst <= FLIP_OF_AUTHORS, "{width} x {height}: {worst:e}");
    }
}

#[test]
fn the_map_is_matplotlibs() {
    let theirs = nv_flip::magma_lut().to_vec();
    for (i, want) in theirs.chunks_exact(3).enumerate() {
        let got = magma(i as f32 / 255.0);
        for (got, want) in got.into_iter().zip(want) {
            let gap = f64::from(got.abs_diff(*want));
            assert!(gap <= FLIP_MAGMA_CODES, "{i}: {got} for {want}");
        }
    }
}
