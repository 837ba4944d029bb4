//! What do rough surfaces really scatter: simulated, path by path, with every bounce?
//!
//! The models of `reference` are formulas; what they stand for are surfaces. Here those are built and light is followed on them, so
//! that a model's own error can be told, with the statistical error of the truth beside it.

pub mod microsurface;
pub mod v_cavities;

use fastrand::Rng;
use glam::DVec3;
use rayon::prelude::*;

use crate::math::frame::spherical;

/// Directions at which a truth is told: the light at each of six angles to the normal, the eye at each of six, and seven azimuths
/// between them.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Grid {
    /// Degrees from the normal, of light and of eye.
    pub thetas: [f64; 6],
}

/// Degrees from the light's azimuth to the eye's: 0 is the side of the light.
pub const PHIS: [f64; 7] = [0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0];

/// Cells of a grid.
pub const CELLS: usize = 6 * 6 * PHIS.len();

/// Up to near grazing, as V-cavities are told.
pub const MATTE: Grid = Grid {
    thetas: [5.0, 25.0, 45.0, 60.0, 75.0, 85.0],
};

/// As mirror facets are told: the lobe of a smooth surface moves fast beyond.
pub const GLOSSY: Grid = Grid {
    thetas: [5.0, 20.0, 35.0, 50.0, 65.0, 78.0],
};

impl Grid {
    /// Light and eye of each cell, with +Z for the normal: light by light, eye by eye, azimuth by azimuth.
    pub fn cells(&self) -> impl Iterator<Item = (DVec3, DVec3)> {
        let thetas = self.thetas;
        thetas.into_iter().flat_map(move |light| {
            let l = spherical(light.to_radians(), 0.0);
            self.eyes().map(move |e| (l, e))
        })
    }

    /// The eyes of the cells of one light.
    pub fn eyes(&self) -> impl Iterator<Item = DVec3> {
        let thetas = self.thetas;
        thetas.into_iter().flat_map(|eye| {
            let at = move |phi: f64| spherical(eye.to_radians(), phi.to_radians());
            PHIS.into_iter().map(at)
        })
    }

    /// The weight of a cell in a mean: cosine and sine of both angles.
    pub fn weights(&self) -> Vec<f64> {
        let of = |v: DVec3| v.z * (1.0 - v.z * v.z).sqrt();
        self.cells().map(|(l, e)| of(l) * of(e)).collect()
    }
}

/// Three channels: of a colour, or of three albedos that are followed at once.
pub type Channels = [f64; 3];

/// What was simulated: f of each cell, 1/sr, per channel, and its standard error.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct Truth {
    /// f of each cell.
    pub f: Vec<Channels>,
    /// Its standard error, from batches that know nothing of each other.
    pub error: Vec<Channels>,
}

/// Batches of the paths of one light.
const BATCHES: usize = 32;

/// Follows `paths` paths for each light of a grid on all cores. `follow` follows one from the direction to the light and adds what each
/// eye of the grid sees of it, f times the eye's cosine. The same seed gives the same truth on any number of cores.
pub fn simulate(
    grid: &Grid,
    paths: usize,
    seed: u64,
    follow: impl Fn(DVec3, &[DVec3], &mut Rng, &mut [Channels]) + Sync,
    progress: &(dyn Fn() + Sync),
) -> Truth {
    let eyes: Vec<DVec3> = grid.eyes().collect();
    let batch = |job: usize| {
        let l = spherical(grid.thetas[job / BATCHES].to_radians(), 0.0);
        let mut rng = Rng::with_seed(seed.wrapping_add(job as u64).wrapping_mul(SPREAD));
        let mut seen = vec![[0.0; 3]; eyes.len()];
        let count = paths / BATCHES;
        (0..count).for_each(|_| follow(l, &eyes, &mut rng, &mut seen));
        for (sum, e) in seen.iter_mut().zip(&eyes) {
            *sum = sum.map(|x| x / (count as f64 * e.z));
        }
        progress();
        seen
    };
    let jobs = (0..grid.thetas.len() * BATCHES).into_par_iter();
    let done: Vec<Vec<Channels>> = jobs.map(batch).collect();
    summed(&done)
}

/// Neighbouring seeds of a generator are alike at first; 2^64 over the golden ratio spreads them.
const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;

/// Steps that `simulate` tells of.
pub const STEPS: u64 = 6 * BATCHES as u64;

/// Mean and standard error of the batches of each light.
fn summed(batches: &[Vec<Channels>]) -> Truth {
    let mut truth = Truth {
        f: Vec::new(),
        error: Vec::new(),
    };
    for light in batches.chunks(BATCHES) {
        let cells = light.first().map_or(0, Vec::len);
        for cell in 0..cells {
            let channel = |c: usize| {
                let values = light.iter().map(|batch| batch[cell][c]);
                let mean = values.clone().sum::<f64>() / BATCHES as f64;
                let variance = values.map(|x| (x - mean).powi(2)).sum::<f64>();
                let n = BATCHES as f64;
                (mean, (variance / (n * (n - 1.0))).sqrt())
            };
            let channels = [0, 1, 2].map(channel);
            truth.f.push(channels.map(|(mean, _)| mean));
            truth.error.push(channels.map(|(_, error)| error));
        }
    }
    truth
}
