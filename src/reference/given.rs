//! What is the value at three vectors of 32 bits exactly as they are, to a part in 10^12?
//!
//! A vector that was normalised in 32 bits has a length of 1 to some 1e-7, and near the surface or near a sharp peak a
//! lobe tells such lengths apart. So that a shader's rounding is measured and not its input's, the truth is the lobe's own
//! formula in dot and cross products, which is the paper's for unit vectors (a test holds the two together), at the
//! vectors as given and with compensated products.

pub mod diffuse;
pub mod fresnel;
pub mod specular;

use std::f64::consts::PI;

use glam::{DVec3, Vec3};

use super::{beckmann, oren_nayar};
use crate::math::double::{Double, dot};

/// What the lobes see of three vectors N, L, E.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Given {
    /// N.L
    pub nol: f64,
    /// N.E
    pub noe: f64,
    /// L.E - (N.L)(N.E)
    pub s: f64,
    /// N.(L x E)
    pub triple: f64,
    /// N.(L + E)
    pub noh: f64,
    /// |N x (L + E)|^2
    pub sine2: f64,
    /// |L + E|^2
    pub hh: f64,
    /// |L - E|^2
    pub difference2: f64,
}

impl Given {
    /// Relative to the truth: 1e-15 for each, where it is not below 1e-30.
    pub fn new(n: Vec3, l: Vec3, e: Vec3) -> Self {
        let (n_l, n_e) = (dot(n, l), dot(n, e));
        Self {
            nol: n_l.value(),
            noe: n_e.value(),
            s: (dot(l, e) - n_l * n_e).value(),
            triple: n.as_dvec3().dot(l.as_dvec3().cross(e.as_dvec3())),
            noh: (n_l + n_e).value(),
            sine2: cross_of_sum(n, l, e).length_squared(),
            hh: (l.as_dvec3() + e.as_dvec3()).length_squared(),
            difference2: (l.as_dvec3() - e.as_dvec3()).length_squared(),
        }
    }

    /// The smaller of N.L and N.E: how far both are from grazing.
    pub fn least_cosine(&self) -> f64 {
        self.nol.min(self.noe)
    }

    /// The squared tangent between normal and half vector over m^2: the peak is at 0, and 1e-6 of it at 13.8.
    pub fn beckmann_exponent(&self, m: f64) -> f64 {
        self.sine2 / (self.noh * self.noh) / (m * m)
    }
}

/// n x (l + e), each component to 1e-15 of itself.
fn cross_of_sum(n: Vec3, l: Vec3, e: Vec3) -> DVec3 {
    let part = |a: f32, c: [f32; 2], b: f32, d: [f32; 2]| {
        let of = |factor: f32, sum: [f32; 2]| {
            Double::product(factor, sum[0]) + Double::product(factor, sum[1])
        };
        (of(a, c) - of(b, d)).value()
    };
    let (x, y, z) = ([l.x, e.x], [l.y, e.y], [l.z, e.z]);
    DVec3::new(
        part(n.y, z, n.z, y),
        part(n.z, x, n.x, z),
        part(n.x, y, n.y, x),
    )
}

/// `oren_nayar::lobe` at the vectors as given.
pub fn oren_nayar(at: &Given, sigma: f64) -> f64 {
    if at.nol <= 0.0 {
        return 0.0;
    }
    let (a, b) = oren_nayar::weights(sigma);
    let foreshortening = if at.nol >= at.noe {
        1.0
    } else {
        at.nol / at.noe
    };
    a * at.nol + b * at.s.max(0.0) * foreshortening
}

/// `oren_nayar::conserving_lobe` at the vectors as given.
pub fn conserving_oren_nayar(at: &Given, sigma: f64) -> f64 {
    oren_nayar(at, sigma) / oren_nayar::largest_albedo(sigma).max(1.0)
}

/// `beckmann::d` at the vectors as given; 0 for a light or an eye at or below the surface.
pub fn beckmann_d(at: &Given, m: f64) -> f64 {
    if at.least_cosine() <= 0.0 {
        return 0.0;
    }
    let secant2 = at.hh / (at.noh * at.noh);
    (-at.beckmann_exponent(m)).exp() * secant2 * secant2 / (PI * m * m)
}

/// `v_cavity::g` at the vectors as given.
pub fn v_cavity_g(at: &Given) -> f64 {
    if at.least_cosine() <= 0.0 {
        return 0.0;
    }
    (4.0 * at.noh * at.least_cosine() / at.hh).min(1.0)
}

/// `schlick::f` of one channel, at the half vector of L and E as given.
pub fn schlick_f(at: &Given, f0: f64) -> f64 {
    rise(f0, 0.25 * at.difference2 / (1.0 + 0.5 * at.hh.sqrt()))
}

/// `cook_torrance::lobe` of one channel at the vectors as given. m > 0.
pub fn cook_torrance(at: &Given, m: f64, f0: f64) -> f64 {
    if at.least_cosine() <= 0.0 {
        return 0.0;
    }
    beckmann_d(at, m) * v_cavity_g(at) * schlick_f(at, f0) / (4.0 * at.noe)
}

/// `Coupled`, diffuse and specular, of albedo 1 and one channel, under a light without extent.
pub fn corrected(at: &Given, roughness: f64, f0: f64) -> f64 {
    let f90 = (50.0 * f0).min(1.0);
    // 1 - (1 - c)^5 without the difference.
    let rest = |c: f64| -(5.0 * (-c.clamp(0.0, 1.0)).ln_1p()).exp_m1();
    let through = |cosine: f64| 1.0 - f90 + (f90 - f0) * rest(cosine);
    let base = through(at.nol) * through(at.noe) * conserving_oren_nayar(at, roughness) / PI;
    base + cook_torrance(at, beckmann::under_disc(roughness, 0.0), f0)
}

/// The slides' Cook-Torrance formula where it is defined: its D has no 1/pi, and pi stands for 4.
pub fn slides_cook_torrance(at: &Given, m: f64, fresnel_scale: f64) -> f64 {
    if at.least_cosine() <= 0.0 {
        return 0.0;
    }
    let one_minus_cos = 0.25 * at.difference2 / (1.0 + 0.5 * at.hh.sqrt());
    let f = fresnel_scale + (1.0 - fresnel_scale) * one_minus_cos.powi(5);
    beckmann_d(at, m) * v_cavity_g(at) * f / at.noe
}

fn rise(f0: f64, one_minus_cos: f64) -> f64 {
    let f90 = (50.0 * f0).min(1.0);
    f0 + (f90 - f0) * one_minus_cos.powi(5)
}
