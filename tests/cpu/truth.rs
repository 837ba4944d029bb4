//! Are the simulated surfaces what they should be where the answer is known?

use glam::DVec3;
use umber::reference::truth::microsurface::{self, Facets, Microsurface, Slopes};
use umber::reference::truth::{GLOSSY, Grid, MATTE, PHIS, Truth, v_cavities};
use umber::reference::{beckmann_smith, conductor, ggx};

use crate::tolerances::STANDARD_ERRORS;

const N: DVec3 = DVec3::Z;
const PATHS: usize = 1 << 12;

/// How many of its standard errors a truth is off, in the mean square over the cells of a channel: 1 where it is right.
fn deviations(truth: &Truth, channel: usize, want: impl Iterator<Item = f64>) -> f64 {
    let cells = truth.f.iter().zip(&truth.error).zip(want);
    let squares = cells
        .map(|((f, error), want)| ((f[channel] - want) / (error[channel] + 1e-9 * want)).powi(2));
    let squares: Vec<f64> = squares.collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

fn surface(slopes: Slopes, alpha: f64, facets: Facets) -> Microsurface {
    Microsurface {
        slopes,
        alpha,
        facets,
    }
}

/// One bounce between mirrors is D G2 / (4 cos cos).
#[test]
fn one_bounce_of_the_walk_is_the_formula() {
    for (slopes, lobe) in [
        (Slopes::Ggx, ggx::lobe as fn(_, _, _, _) -> f64),
        (Slopes::Beckmann, beckmann_smith::lobe),
    ] {
        for alpha in [0.25, 0.5, 1.0] {
            let mirrors = surface(slopes, alpha, Facets::Mirror);
            let truth = microsurface::truth(&GLOSSY, mirrors, Some(1), (PATHS, 3), &|| {});
            let formula = GLOSSY.cells().map(|(l, e)| lobe(N, l, e, alpha) / l.z);
            let off = deviations(&truth, 0, formula);
            println!("{slopes:?}, {alpha}: {off:.2} standard errors");
            assert!(off < STANDARD_ERRORS, "{slopes:?}, {alpha}: {off}");
        }
    }
}

#[test]
fn a_metals_one_bounce_has_its_fresnel_term() {
    let gold = [(0.226, 3.192), (0.428, 2.46), (1.322, 1.86)];
    let metal = surface(Slopes::Ggx, 0.5, Facets::Conductor(gold));
    let truth = microsurface::truth(&GLOSSY, metal, Some(1), (PATHS, 3), &|| {});
    for (channel, (n, k)) in gold.into_iter().enumerate() {
        let formula = GLOSSY.cells().map(|(l, e)| {
            let mu = l.dot((l + e).normalize());
            ggx::lobe(N, l, e, 0.5) / l.z * conductor::f(n, k, mu)
        });
        assert!(deviations(&truth, channel, formula) < STANDARD_ERRORS);
    }
}

/// With almost no slope both surfaces are flat, and chalk on a flat one is Lambert's.
#[test]
fn what_is_flat_is_lambert() {
    let flat = v_cavities::truth(&MATTE, 0.005, PATHS, 3, &|| {});
    let chalk = surface(Slopes::Ggx, 0.005, Facets::Lambert([1.0, 0.5, 0.2]));
    let smooth = microsurface::truth(&MATTE, chalk, None, (PATHS, 3), &|| {});
    for truth in [flat, smooth] {
        for (channel, albedo) in [1.0, 0.5, 0.2].into_iter().enumerate() {
            for f in &truth.f {
                let share = f[channel] * std::f64::consts::PI / albedo;
                // Slopes of 0.005 against eyes at 85 degrees, 0.087 above the surface.
                assert!((share - 1.0).abs() < 0.1, "{share}");
            }
        }
    }
}

/// The mean of f(l, e) / f(e, l) over cells that are each other's mirror.
fn symmetry(grid: &Grid, truth: &Truth) -> f64 {
    let at = |light: usize, eye: usize, phi: usize| {
        truth.f[(light * grid.thetas.len() + eye) * PHIS.len() + phi][0]
    };
    let mut ratios = Vec::new();
    for light in 0..6 {
        for eye in 0..light {
            let phis = 0..PHIS.len();
            ratios.extend(phis.map(|phi| at(light, eye, phi) / at(eye, light, phi)));
        }
    }
    ratios.iter().sum::<f64>() / ratios.len() as f64
}

#[test]
fn light_and_eye_may_change_places() {
    let cavities = v_cavities::truth(&MATTE, 0.52, 8 * PATHS, 3, &|| {});
    let mirrors = surface(Slopes::Ggx, 0.5, Facets::Mirror);
    let mirrors = microsurface::truth(&GLOSSY, mirrors, None, (8 * PATHS, 3), &|| {});
    for (grid, truth) in [(MATTE, cavities), (GLOSSY, mirrors)] {
        let ratio = symmetry(&grid, &truth);
        assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
    }
}

#[test]
fn a_truth_is_the_same_whoever_computes_it() {
    let truth = || v_cavities::truth(&MATTE, 0.35, 1 << 10, 3, &|| {});
    assert_eq!(truth(), truth());
}
