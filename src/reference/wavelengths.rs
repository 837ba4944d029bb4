//! Which colour has a spectrum, and which one a metal whose index was measured?

use std::sync::LazyLock;

use glam::{DMat3, DVec3};

use super::conductor;

/// Complex indices as published; see the file's head for their sources.
const MEASURED: &str = include_str!("metals_nk.csv");

/// Wavelengths that are summed, nm: from where the eye sees a ten-thousandth of its best to where it does again.
const FIRST: usize = 390;
const LAST: usize = 780;
const STEP: usize = 2;

/// A measured metal.
#[derive(Clone, PartialEq, Debug)]
pub struct Spectrum {
    /// Wavelength in nm, n, k; in ascending order.
    points: Vec<[f64; 3]>,
}

impl Spectrum {
    /// The metal with that chemical symbol, as the measurements have it; `None` where they have none.
    pub fn of_symbol(symbol: &str) -> Option<Self> {
        let lines = MEASURED.lines().filter(|line| !line.starts_with('#'));
        let rows = lines.filter_map(|line| {
            let cells: Vec<_> = line.split(',').collect();
            let [metal, _, wavelength, n, k] = cells[..] else {
                return None;
            };
            let numbers = [wavelength, n, k].map(str::parse);
            let [Ok(wavelength), Ok(n), Ok(k)] = numbers else {
                return None;
            };
            (metal == symbol).then_some([wavelength, n, k])
        });
        let points: Vec<_> = rows.collect();
        (points.len() > 1).then_some(Self { points })
    }

    /// n and k at a wavelength in nm: straight lines between the measurements, as far as they go.
    pub fn index(&self, wavelength: f64) -> (f64, f64) {
        let after = self.points.iter().position(|point| point[0] >= wavelength);
        let after = after.unwrap_or(self.points.len() - 1).max(1);
        let [[x0, n0, k0], [x1, n1, k1]] = [self.points[after - 1], self.points[after]];
        let along = ((wavelength - x0) / (x1 - x0)).clamp(0.0, 1.0);
        (n0 + (n1 - n0) * along, k0 + (k1 - k0) * along)
    }

    /// Fresnel's reflectance at cosine `mu` (0..1) under a white light, in linear sRGB; a white reflector is 1, 1, 1. A channel may
    /// pass 1 or fall below 0 where the colour lies outside sRGB.
    pub fn reflectance(&self, mu: f64) -> DVec3 {
        let weights = &*WEIGHTS;
        let colours = weights.iter().map(|(wavelength, weight)| {
            let (n, k) = self.index(*wavelength);
            *weight * conductor::f(n, k, mu)
        });
        colours.sum()
    }
}

/// What each wavelength adds to linear sRGB, of a light that is white there.
static WEIGHTS: LazyLock<Vec<(f64, DVec3)>> = LazyLock::new(|| {
    let wavelengths = (FIRST..=LAST).step_by(STEP).map(|x| x as f64);
    let seen: Vec<_> = wavelengths
        .map(|x| (x, matching(x) * black_body(x)))
        .collect();
    let white: DVec3 = seen.iter().map(|(_, xyz)| *xyz).sum();
    // The light's own white becomes sRGB's, each of X, Y, Z by itself.
    let to_rgb = XYZ_TO_SRGB * DMat3::from_diagonal(D65 / white);
    seen.into_iter().map(|(x, xyz)| (x, to_rgb * xyz)).collect()
});

/// The white of sRGB (IEC 61966-2-1).
const D65: DVec3 = DVec3::new(0.95047, 1.0, 1.08883);

/// IEC 61966-2-1, column by column.
const XYZ_TO_SRGB: DMat3 = DMat3::from_cols(
    DVec3::new(3.2404542, -0.9692660, 0.0556434),
    DVec3::new(-1.5371385, 1.8760108, -0.2040259),
    DVec3::new(-0.4985314, 0.0415560, 1.0572252),
);

/// CIE 1931 colour matching functions: the sums of lobes of Wyman, Sloan and Shirley 2013 (section 2.2).
fn matching(wavelength: f64) -> DVec3 {
    let lobe = |at: f64, below: f64, above: f64| {
        let width = if wavelength < at { below } else { above };
        (-0.5 * ((wavelength - at) / width).powi(2)).exp()
    };
    DVec3::new(
        1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7)
            - 0.065 * lobe(501.1, 20.4, 26.2),
        0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
        1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8),
    )
}

/// Planck's law at the correlated colour temperature of D65, 6504 K, up to a factor.
fn black_body(wavelength: f64) -> f64 {
    // h c / k_B, nm K.
    const SECOND_CONSTANT: f64 = 1.438_776_877e7;
    let x = SECOND_CONSTANT / (wavelength * 6504.0);
    1.0e15 / (wavelength.powi(5) * x.exp_m1())
}
