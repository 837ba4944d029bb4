//! How different do two pictures look to a person who flips between them?
//!
//! FLIP for pictures of a screen's range: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild 2020, "FLIP: A
//! Difference Evaluator for Alternating Images". Each pixel has a difference of 0 (none) to 1 (the largest that a screen
//! can show). Colours are blurred as the eye blurs them at a given distance, and compared; where an edge or a point
//! is in one picture and not in the other, the difference counts for more.

use std::f64::consts::PI;

use glam::{DMat3, DVec3, Mat3, Vec3};
use rayon::prelude::*;

/// Pixels in a degree of sight, as the paper sits before its screen: 3840 pixels on 0.7 m, seen from 0.7 m.
pub const PIXELS_PER_DEGREE: f64 = 3840.0 * PI / 180.0;

/// A picture: sRGB codes, 0 to 255, whole or not; row by row.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'p> {
    /// Pixels a row, at least 1.
    pub width: usize,
    /// Whole rows of pixels.
    pub pixels: &'p [[f32; 3]],
}

/// The difference of each pixel, 0 to 1, row by row. The same whichever picture comes first.
///
/// # Panics
/// Where the pictures have not the same size, or no whole rows.
pub fn flip(a: Shown<'_>, b: Shown<'_>, pixels_per_degree: f64) -> Vec<f32> {
    assert_eq!((a.width, a.pixels.len()), (b.width, b.pixels.len()));
    assert!(a.width > 0 && a.pixels.len().is_multiple_of(a.width));
    let eye = Eye::new(pixels_per_degree);
    let mut map = vec![0.0; a.pixels.len()];
    // A band at a time: what the eye makes of all rows at once would take twenty times the picture.
    let bands = map.par_chunks_mut(BAND * a.width).enumerate();
    bands.for_each(|(band, out)| {
        eye.compare(
            &eye.see(a, band * BAND, out.len()),
            &eye.see(b, band * BAND, out.len()),
            out,
        );
    });
    map
}

/// Rows that are looked at together.
const BAND: usize = 64;

/// How much contrast the eye sees at a frequency of f cycles a degree, a exp(-b f^2), and for blue against yellow a sum of two
/// (the paper's table 1).
const LUMA: (f64, f64) = (1.0, 0.0047);
const RED_GREEN: (f64, f64) = (1.0, 0.0053);
const BLUE_YELLOW: [(f64, f64); 2] = [(34.1, 0.04), (13.5, 0.025)];

/// A difference of colours to this power is compressed (q_c).
const COLOUR_POWER: f32 = 0.7;
/// Differences up to this share of the largest (p_c) ...
const COLOUR_KNEE: f32 = 0.4;
/// ... take this much of the scale (p_t).
const COLOUR_KNEE_VALUE: f32 = 0.95;
/// The width of an edge that the eye detects, degrees (w).
const EDGE_WIDTH: f64 = 0.082;
/// A difference of edges or points to this power is what is taken from the exponent (q_f).
const FEATURE_POWER: f32 = 0.5;

/// The filters of an eye, each of the same length, and the colours that it knows.
struct Eye {
    luma: Vec<f32>,
    red_green: Vec<f32>,
    /// Two, and the share of each.
    blue_yellow: [(f32, Vec<f32>); 2],
    /// A Gaussian, and its first and second derivative: edges and points.
    blur: Vec<f32>,
    slope: Vec<f32>,
    bend: Vec<f32>,
    /// From linear sRGB to X, Y, Z over those of white, and back.
    from_rgb: Mat3,
    to_rgb: Mat3,
    /// The largest difference of two colours, to `COLOUR_POWER`.
    largest: f32,
}

/// What an eye makes of some rows.
struct Seen {
    /// Blurred, in CIELab, with Hunt's adjustment.
    colours: Vec<Vec3>,
    /// How much of an edge there is.
    edges: Vec<f32>,
    /// How much of a point.
    points: Vec<f32>,
}

impl Eye {
    fn new(pixels_per_degree: f64) -> Self {
        // Three deviations of the widest Gaussian, exp(-pi^2 x^2 / b).
        let deviation = |b: f64| (b / 2.0).sqrt() / PI * pixels_per_degree;
        let edge = 0.5 * EDGE_WIDTH * pixels_per_degree;
        let of_colours = (3.0 * deviation(BLUE_YELLOW[0].1)).ceil();
        let of_edges = (3.0 * edge).ceil();
        let radius = of_colours.max(of_edges) as i32;
        let gaussian = |deviation: f64, reach: f64| {
            move |x: f64| match x.abs() <= reach {
                true => (-0.5 * (x / deviation).powi(2)).exp(),
                false => 0.0,
            }
        };
        let colour = |b| gaussian(deviation(b), of_colours);
        let feature = gaussian(edge, of_edges);
        let shares = BLUE_YELLOW.map(|(a, b)| {
            let sum: f64 = (-radius..=radius).map(|x| colour(b)(x.into())).sum();
            a * (PI / b).sqrt() * sum * sum
        });
        let both: f64 = shares.iter().sum();
        let share = |i: usize| {
            (
                (shares[i] / both) as f32,
                weights(radius, colour(BLUE_YELLOW[i].1)),
            )
        };
        let from_rgb = normalised_xyz();
        let mut eye = Self {
            luma: weights(radius, colour(LUMA.1)),
            red_green: weights(radius, colour(RED_GREEN.1)),
            blue_yellow: [share(0), share(1)],
            blur: weights(radius, feature),
            slope: weights(radius, |x| x * feature(x)),
            bend: weights(radius, |x| ((x / edge).powi(2) - 1.0) * feature(x)),
            from_rgb: from_rgb.as_mat3(),
            to_rgb: from_rgb.inverse().as_mat3(),
            largest: 1.0,
        };
        let [green, blue] = [Vec3::Y, Vec3::Z].map(|rgb| eye.adapted_lab(rgb));
        eye.largest = distance(green, blue);
        eye
    }

    /// Looks at `count` pixels from the row `first` on.
    fn see(&self, picture: Shown<'_>, first: usize, count: usize) -> Seen {
        let width = picture.width;
        let [luma, red_green, blue_yellow] = self.opponents(picture, first, count / width);
        let through =
            |plane: &[f32], across: &[f32], down: &[f32]| filtered(plane, width, across, down);
        let y = through(&luma, &self.luma, &self.luma);
        let rg = through(&red_green, &self.red_green, &self.red_green);
        let [(share, one), (other_share, other)] = &self.blue_yellow;
        let narrow = through(&blue_yellow, one, one);
        let wide = through(&blue_yellow, other, other);
        let colours = (0..count).map(|i| {
            let by = share * narrow[i] + other_share * wide[i];
            let xyz = Vec3::new(y[i] + rg[i], y[i], y[i] - by);
            self.adapted_lab((self.to_rgb * xyz).clamp(Vec3::ZERO, Vec3::ONE))
        });
        let size = |derivative: &[f32]| {
            let across = through(&luma, derivative, &self.blur);
            let down = through(&luma, &self.blur, derivative);
            let pairs = across.iter().zip(&down);
            pairs.map(|(x, y)| (x * x + y * y).sqrt()).collect()
        };
        Seen {
            colours: colours.collect(),
            edges: size(&self.slope),
            points: size(&self.bend),
        }
    }

    /// Three planes, Y and the opponents X - Y and Y - Z, each over white's; with as many rows around as the filters reach, those
    /// beyond the picture being its last.
    fn opponents(&self, picture: Shown<'_>, first: usize, rows: usize) -> [Vec<f32>; 3] {
        let radius = self.luma.len() / 2;
        let last = picture.pixels.len() / picture.width - 1;
        let mut planes = [0; 3].map(|_| Vec::with_capacity((rows + 2 * radius) * picture.width));
        for row in first..first + rows + 2 * radius {
            let row = row.saturating_sub(radius).min(last);
            for codes in &picture.pixels[row * picture.width..][..picture.width] {
                let [x, y, z] = (self.from_rgb * Vec3::from(codes.map(linear))).to_array();
                for (plane, value) in planes.iter_mut().zip([y, x - y, y - z]) {
                    plane.push(value);
                }
            }
        }
        planes
    }

    /// CIELab of a linear colour, its opponents the smaller the darker it is (Hunt 1952).
    fn adapted_lab(&self, rgb: Vec3) -> Vec3 {
        const STEP: f32 = 6.0 / 29.0;
        let [x, y, z] = (self.from_rgb * rgb)
            .to_array()
            .map(|t| match t > STEP.powi(3) {
                true => t.cbrt(),
                false => t / (3.0 * STEP * STEP) + 4.0 / 29.0,
            });
        let lightness = 116.0 * y - 16.0;
        let hunt = 0.01 * lightness;
        Vec3::new(lightness, hunt * 500.0 * (x - y), hunt * 200.0 * (y - z))
    }

    fn compare(&self, a: &Seen, b: &Seen, out: &mut [f32]) {
        for (i, out) in out.iter_mut().enumerate() {
            let colour = self.scaled(distance(a.colours[i], b.colours[i]));
            let edge = (a.edges[i] - b.edges[i]).abs();
            let point = (a.points[i] - b.points[i]).abs();
            let feature = (edge.max(point) * std::f32::consts::FRAC_1_SQRT_2).powf(FEATURE_POWER);
            *out = colour.powf(1.0 - feature.min(1.0)).min(1.0);
        }
    }

    /// A difference of colours as 0 to 1: up to the knee, which most are below, on almost all of the scale.
    fn scaled(&self, difference: f32) -> f32 {
        let knee = COLOUR_KNEE * self.largest;
        if difference < knee {
            return COLOUR_KNEE_VALUE / knee * difference;
        }
        let beyond = (difference - knee) / (self.largest - knee);
        COLOUR_KNEE_VALUE + (1.0 - COLOUR_KNEE_VALUE) * beyond
    }
}

/// HyAB, the distance of large differences: of lightness, plus that in the plane of the opponents (Abasi, Tehran and Fairchild
/// 2020), compressed.
fn distance(a: Vec3, b: Vec3) -> f32 {
    let d = a - b;
    (d.x.abs() + (d.y * d.y + d.z * d.z).sqrt()).powf(COLOUR_POWER)
}

/// A filter of 2 `radius` + 1 weights: what is above 0 adds up to 1, what is below to -1.
fn weights(radius: i32, shape: impl Fn(f64) -> f64) -> Vec<f32> {
    let shape: Vec<f64> = (-radius..=radius).map(|x| shape(x.into())).collect();
    let above: f64 = shape.iter().filter(|w| **w > 0.0).sum();
    let below: f64 = shape.iter().filter(|w| **w < 0.0).sum();
    let scaled = |w: f64| {
        if w > 0.0 {
            w / above
        } else {
            w / below.abs().max(f64::MIN_POSITIVE)
        }
    };
    shape.into_iter().map(|w| scaled(w) as f32).collect()
}

/// A plane under one filter along its rows and another along its columns; it loses the rows around.
fn filtered(plane: &[f32], width: usize, across: &[f32], down: &[f32]) -> Vec<f32> {
    let radius = across.len() / 2;
    let mut between = vec![0.0; plane.len()];
    let mut longer = vec![0.0; width + 2 * radius];
    for (row, out) in plane
        .chunks_exact(width)
        .zip(between.chunks_exact_mut(width))
    {
        longer[..radius].fill(row[0]);
        longer[radius..radius + width].copy_from_slice(row);
        longer[radius + width..].fill(row[width - 1]);
        for (weight, shifted) in across.iter().zip(longer.windows(width)) {
            add(out, *weight, shifted);
        }
    }
    let mut result = vec![0.0; plane.len() - 2 * radius * width];
    for (row, out) in result.chunks_exact_mut(width).enumerate() {
        for (weight, shifted) in down.iter().zip(between[row * width..].chunks_exact(width)) {
            add(out, *weight, shifted);
        }
    }
    result
}

fn add(out: &mut [f32], weight: f32, row: &[f32]) {
    for (out, value) in out.iter_mut().zip(row) {
        *out += weight * value;
    }
}

/// The linear value of an sRGB code (IEC 61966-2-1).
fn linear(code: f32) -> f32 {
    let x = code.clamp(0.0, 255.0) / 255.0;
    match x <= 0.04045 {
        true => x / 12.92,
        false => ((x + 0.055) / 1.055).powf(2.4),
    }
}

/// From linear sRGB to X, Y, Z, each over that of white: each row adds up to 1. From the primaries and the white of IEC
/// 61966-2-1; D65 to five digits, as the paper's own code has it.
fn normalised_xyz() -> DMat3 {
    let xyz = |x: f64, y: f64| DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
    let primaries = DMat3::from_cols(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06));
    let white = xyz(0.31271, 0.32902);
    let luminances = primaries.inverse() * white;
    DMat3::from_diagonal(white.recip()) * primaries * DMat3::from_diagonal(luminances)
}
