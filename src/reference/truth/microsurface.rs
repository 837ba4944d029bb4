//! What does a Smith microsurface scatter, with every bounce between its facets? Heitz, Hanika, d'Eon and Dachsbacher 2016.
//!
//! A random walk over heights that are uniform in -1..1.

use std::f64::consts::PI;

use fastrand::Rng;
use glam::DVec3;

use super::v_cavities::lambertian;
use super::{Channels, Grid, Truth, simulate};
use crate::reference::{beckmann, beckmann_smith, conductor, ggx};

/// How slopes are distributed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Slopes {
    /// Trowbridge and Reitz's.
    Ggx,
    /// Beckmann's.
    Beckmann,
}

/// What facets are made of.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Facets {
    /// They reflect everything, like mirrors.
    Mirror,
    /// They reflect like a metal, with an index (n, k) for each channel.
    Conductor([(f64, f64); 3]),
    /// They scatter like chalk, with an albedo for each channel.
    Lambert(Channels),
}

/// Bounces after which a path is left; at alpha = 1 a ten-thousandth is still inside then.
const BOUNCES: usize = 64;

/// A surface: its slopes, their width (GGX's alpha, Beckmann's m), and its facets.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Microsurface {
    /// The distribution.
    pub slopes: Slopes,
    /// Its width.
    pub alpha: f64,
    /// What facets are made of.
    pub facets: Facets,
}

/// The truth of a surface, with all its bounces, or with so many.
pub fn truth(
    grid: &Grid,
    surface: Microsurface,
    bounces: Option<usize>,
    (paths, seed): (usize, u64),
    progress: &(dyn Fn() + Sync),
) -> Truth {
    let bounces = bounces.unwrap_or(BOUNCES);
    let follow = |l: DVec3, eyes: &[DVec3], rng: &mut Rng, seen: &mut [Channels]| {
        surface.follow(l, eyes, bounces, rng, seen);
    };
    simulate(grid, paths, seed, follow, progress)
}

impl Microsurface {
    /// A path from above, and what each eye sees of its bounces.
    fn follow(
        &self,
        l: DVec3,
        eyes: &[DVec3],
        bounces: usize,
        rng: &mut Rng,
        seen: &mut [Channels],
    ) {
        let mut direction = -l;
        let mut below = 1.0;
        let mut weight = [1.0; 3];
        for _ in 0..bounces {
            let Some(height) = self.next_below(direction, below, rng) else {
                return;
            };
            below = height;
            let back = -direction;
            let Some(facet) = self.visible_facet(back, rng) else {
                return;
            };
            for (sum, e) in seen.iter_mut().zip(eyes) {
                let phase = self.phase(back, facet, *e);
                // The chance to get out on the way to the eye.
                let out = below.powf(self.lambda(e.z));
                for ((sum, weight), phase) in sum.iter_mut().zip(weight).zip(phase) {
                    *sum += weight * phase * out;
                }
            }
            let reflected = self.scattered(back, facet, rng);
            for (weight, share) in weight.iter_mut().zip(self.kept(back, facet)) {
                *weight *= share;
            }
            direction = reflected;
        }
    }

    /// Smith's function of any direction; of one that points down it is below -1.
    fn lambda(&self, cosine: f64) -> f64 {
        let cosine_up = cosine.abs().clamp(GRAZING, 1.0);
        let up = match self.slopes {
            Slopes::Ggx => ggx::lambda(cosine_up, self.alpha),
            Slopes::Beckmann => beckmann_smith::lambda(cosine_up, self.alpha),
        };
        if cosine > 0.0 { up } else { -1.0 - up }
    }

    /// The share of the heights below the next facet on the way; `None` where the path leaves the surface. `below`: the share
    /// of heights below the place that it starts at, which the paper calls C1(h).
    fn next_below(&self, direction: DVec3, below: f64, rng: &mut Rng) -> Option<f64> {
        let u = rng.f64();
        if direction.z.abs() < GRAZING {
            return Some(below);
        }
        let lambda = self.lambda(direction.z);
        if direction.z > 0.0 && (lambda <= 0.0 || u > 1.0 - below.powf(lambda)) {
            return None;
        }
        // C1(h') = C1(h) / (1 - u)^(1 / lambda), with a negative lambda on the way down.
        Some((below / (1.0 - u).powf(1.0 / lambda)).clamp(0.0, 1.0))
    }

    /// A facet as likely as it is seen from a direction; `None` where none is found.
    fn visible_facet(&self, from: DVec3, rng: &mut Rng) -> Option<DVec3> {
        match self.slopes {
            Slopes::Ggx => Some(self.visible_ggx_facet(from, rng)),
            Slopes::Beckmann => self.visible_beckmann_facet(from, rng),
        }
    }

    /// By spherical caps (Dupuy and Benyoub 2023).
    fn visible_ggx_facet(&self, from: DVec3, rng: &mut Rng) -> DVec3 {
        let scale = DVec3::new(self.alpha, self.alpha, 1.0);
        let stretched = (from * scale).normalize();
        let z = (1.0 - rng.f64()) * (1.0 + stretched.z) - stretched.z;
        let across = (1.0 - z * z).max(0.0).sqrt();
        let phi = 2.0 * PI * rng.f64();
        let cap = DVec3::new(across * phi.cos(), across * phi.sin(), z);
        ((cap + stretched) * scale)
            .try_normalize()
            .unwrap_or(DVec3::Z)
    }

    /// By rejection: slopes are drawn, and kept as often as their facets are turned to the eye.
    fn visible_beckmann_facet(&self, from: DVec3, rng: &mut Rng) -> Option<DVec3> {
        let across = (1.0 - from.z * from.z).max(0.0).sqrt();
        let most = from.z + across * STEEPEST * self.alpha;
        for _ in 0..TRIES {
            let slope = self.alpha * (-(1.0 - rng.f64()).ln()).sqrt().min(STEEPEST);
            let phi = 2.0 * PI * rng.f64();
            let facet = DVec3::new(slope * phi.cos(), slope * phi.sin(), 1.0);
            if from.dot(facet) > most * rng.f64() {
                return Some(facet.normalize());
            }
        }
        None
    }

    /// The share that goes on from a facet.
    fn kept(&self, from: DVec3, facet: DVec3) -> Channels {
        match self.facets {
            Facets::Mirror => [1.0; 3],
            Facets::Conductor(indices) => fresnel(indices, from.dot(facet)),
            Facets::Lambert(albedos) => albedos,
        }
    }

    fn scattered(&self, from: DVec3, facet: DVec3, rng: &mut Rng) -> DVec3 {
        match self.facets {
            Facets::Mirror | Facets::Conductor(_) => facet * (2.0 * from.dot(facet)) - from,
            Facets::Lambert(_) => lambertian(facet, rng),
        }
    }

    /// What is scattered into a direction, 1/sr: of mirrors from all facets, of chalk from the one that was drawn.
    fn phase(&self, from: DVec3, facet: DVec3, to: DVec3) -> Channels {
        match self.facets {
            Facets::Mirror => [self.mirrored(from, to); 3],
            Facets::Conductor(indices) => {
                let h = (from + to).normalize_or_zero();
                let mirrored = self.mirrored(from, to);
                fresnel(indices, from.dot(h)).map(|share| share * mirrored)
            }
            Facets::Lambert(albedos) => {
                let cosine = facet.dot(to).max(0.0) / PI;
                albedos.map(|albedo| albedo * cosine)
            }
        }
    }

    /// D(h) / (4 area), area: of the facets that are seen from a direction, projected to it.
    fn mirrored(&self, from: DVec3, to: DVec3) -> f64 {
        let h = (from + to).normalize_or_zero();
        let area = (1.0 + self.lambda(from.z)) * from.z;
        if h.z <= 0.0 || from.dot(h) <= 0.0 || area <= 0.0 {
            return 0.0;
        }
        let d = match self.slopes {
            Slopes::Ggx => ggx::d(DVec3::Z, h, self.alpha),
            Slopes::Beckmann => beckmann::d(DVec3::Z, h, self.alpha),
        };
        d / (4.0 * area)
    }
}

/// In widths: exp(-36) of Beckmann's facets are steeper.
const STEEPEST: f64 = 6.0;
/// A facet that is seen from below at a steep angle is one of thousands; the path ends where there is none.
const TRIES: usize = 100_000;

/// Nearer to the surface's plane a path stays at its height.
const GRAZING: f64 = 1.0e-6;

fn fresnel(indices: [(f64, f64); 3], cosine: f64) -> Channels {
    indices.map(|(n, k)| conductor::f(n, k, cosine.clamp(0.0, 1.0)))
}
