//! What does Oren and Nayar's own surface scatter: long symmetric V-cavities of Lambertian facets, with every bounce between them?
//!
//! A cavity's opening is x = -1..1 at z = 0, its bottom x = 0 at z = -h, h = tan(theta) of its facets' slope; it runs along y. Slopes
//! have Oren and Nayar's Gaussian, exp(-theta^2 / (2 sigma^2)) sin(theta) by the area that is seen from above; cavities run in every
//! direction.

use std::f64::consts::{FRAC_PI_2, PI};

use fastrand::Rng;
use glam::DVec3;

use super::{Channels, Grid, Truth, simulate};

/// Albedos that are followed at once.
pub const ALBEDOS: Channels = [1.0, 0.5, 0.2];

/// Bounces after which a path is left: of the roughest surface (sigma 0.8) some thousandths of the light are still inside then.
const BOUNCES: usize = 160;

/// Places in a table of slopes.
const SLOPES: usize = 4096;

/// The truth of a sigma (radians), for `ALBEDOS`.
pub fn truth(
    grid: &Grid,
    sigma: f64,
    paths: usize,
    seed: u64,
    progress: &(dyn Fn() + Sync),
) -> Truth {
    let slopes = slopes(sigma);
    let follow = |l: DVec3, eyes: &[DVec3], rng: &mut Rng, seen: &mut [Channels]| {
        let slope = slopes[rng.usize(0..SLOPES)];
        let turn = 2.0 * PI * rng.f64();
        Cavity::new(slope).follow(l, eyes, turn, rng, seen);
    };
    simulate(grid, paths, seed, follow, progress)
}

/// Slopes that are equally likely, from the middles of equal shares of their distribution.
fn slopes(sigma: f64) -> Vec<f64> {
    const STEPS: usize = 1 << 16;
    let width = FRAC_PI_2 / STEPS as f64;
    let density = |i: usize| {
        let theta = (i as f64 + 0.5) * width;
        (-theta * theta / (2.0 * sigma * sigma)).exp() * theta.sin()
    };
    let total: f64 = (0..STEPS).map(density).sum();
    let (mut i, mut below) = (0, 0.0);
    let share = |place: usize| (place as f64 + 0.5) / SLOPES as f64 * total;
    let slope = |place: usize| {
        while i + 1 < STEPS && below + density(i) < share(place) {
            below += density(i);
            i += 1;
        }
        let along = ((share(place) - below) / density(i)).clamp(0.0, 1.0);
        (i as f64 + along) * width
    };
    (0..SLOPES).map(slope).collect()
}

/// One cavity.
struct Cavity {
    h: f64,
    sine: f64,
    cosine: f64,
}

/// A point on a facet. `side` is 1 on the left one (x < 0), whose normal leans to the right, else -1.
#[derive(Clone, Copy)]
struct Point {
    x: f64,
    z: f64,
    side: f64,
}

impl Cavity {
    fn new(slope: f64) -> Self {
        Self {
            h: slope.tan(),
            sine: slope.sin(),
            cosine: slope.cos(),
        }
    }

    /// A path that enters anywhere, and what each eye sees of its bounces. `turn`: azimuth of x.
    fn follow(&self, l: DVec3, eyes: &[DVec3], turn: f64, rng: &mut Rng, seen: &mut [Channels]) {
        let turned = |v: DVec3| {
            let (sine, cosine) = turn.sin_cos();
            DVec3::new(v.x * cosine + v.y * sine, v.y * cosine - v.x * sine, v.z)
        };
        let eyes: Vec<DVec3> = eyes.iter().map(|e| turned(*e)).collect();
        let entry = Point {
            x: 2.0 * rng.f64() - 1.0,
            z: 0.0,
            side: 0.0,
        };
        let mut point = self.first_hit(entry, -turned(l));
        let mut weight = ALBEDOS;
        for _ in 0..BOUNCES {
            let n = DVec3::new(point.side * self.sine, 0.0, self.cosine);
            for (sum, e) in seen.iter_mut().zip(&eyes) {
                let cosine = n.dot(*e);
                if cosine > 0.0 && self.sees_out(point, *e) {
                    for (sum, weight) in sum.iter_mut().zip(weight) {
                        *sum += weight * cosine / PI;
                    }
                }
            }
            let direction = lambertian(n, rng);
            if self.sees_out(point, direction) {
                return;
            }
            point = self.across(point, direction);
            for (weight, albedo) in weight.iter_mut().zip(ALBEDOS) {
                *weight *= albedo;
            }
        }
    }

    /// Where light from the opening first meets a facet.
    fn first_hit(&self, from: Point, d: DVec3) -> Point {
        // A facet is z = -h (1 + x) on the left, z = -h (1 - x) on the right.
        let left = time_to(self.h * (1.0 + from.x), d.z + self.h * d.x);
        let right = time_to(self.h * (1.0 - from.x), d.z - self.h * d.x);
        let (t, side) = if left < right {
            (left, 1.0)
        } else {
            (right, -1.0)
        };
        Point {
            x: from.x + t * d.x,
            z: t * d.z,
            side,
        }
    }

    /// Height over the other facet's plane, and how it changes along a direction.
    fn over_other(&self, point: Point, d: DVec3) -> (f64, f64) {
        let height = point.z + self.h * (1.0 - point.side * point.x);
        (height, d.z - point.side * self.h * d.x)
    }

    /// Whether a direction off a facet leaves the cavity before it meets the other facet.
    fn sees_out(&self, point: Point, d: DVec3) -> bool {
        let (height, change) = self.over_other(point, d);
        if d.z <= 0.0 {
            return false;
        }
        // At the opening: z = 0.
        change >= 0.0 || height + change * (-point.z / d.z) >= 0.0
    }

    /// The point on the other facet.
    fn across(&self, point: Point, d: DVec3) -> Point {
        let (height, change) = self.over_other(point, d);
        let t = time_to(height, change);
        Point {
            x: point.x + t * d.x,
            z: (point.z + t * d.z).min(0.0),
            side: -point.side,
        }
    }
}

/// When a height that changes at that rate is 0; never, if it does not fall.
fn time_to(height: f64, change: f64) -> f64 {
    if change < 0.0 {
        -height / change
    } else {
        f64::MAX
    }
}

/// A direction about n, as likely as its cosine is large.
pub(super) fn lambertian(n: DVec3, rng: &mut Rng) -> DVec3 {
    let (u, phi) = (rng.f64(), 2.0 * PI * rng.f64());
    let across = u.sqrt();
    let (tangent, bitangent) = n.any_orthonormal_pair();
    tangent * (across * phi.cos()) + bitangent * (across * phi.sin()) + n * (1.0 - u).sqrt()
}
