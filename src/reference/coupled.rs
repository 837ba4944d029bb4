//! How do the matte base and the interface above it share the light?

use std::f64::consts::PI;

use glam::DVec3;

use super::hemisphere::{self, Surroundings};
use super::{beckmann, cook_torrance, oren_nayar, schlick};

/// What a material is made of, as the corrected model sees it. All in 0..1.
#[derive(Clone, Copy, Debug)]
pub struct Coupled {
    pub albedo: DVec3,
    pub f0: DVec3,
    /// sigma of Oren and Nayar (radians) and m of Beckmann.
    pub roughness: f64,
}

impl Coupled {
    /// f cos(theta_l) of the base: it gets what the interface lets in, and gives what it lets out.
    pub fn diffuse(&self, n: DVec3, l: DVec3, e: DVec3) -> DVec3 {
        let entering = DVec3::ONE - schlick::f(self.f0, n.dot(l));
        let leaving = DVec3::ONE - schlick::f(self.f0, n.dot(e));
        self.albedo
            * entering
            * leaving
            * (oren_nayar::conserving_lobe(n, l, e, self.roughness) / PI)
    }

    /// f cos(theta_l) of the interface under a light of `angular_radius`, radians.
    pub fn specular(&self, n: DVec3, l: DVec3, e: DVec3, angular_radius: f64) -> DVec3 {
        let m = beckmann::under_disc(self.roughness, angular_radius);
        cook_torrance::lobe(n, l, e, m, self.f0)
    }

    /// Radiance of the base under `around`.
    pub fn ambient_diffuse(&self, n: DVec3, e: DVec3, around: &Surroundings) -> DVec3 {
        let leaving = DVec3::ONE - schlick::f(self.f0, n.dot(e));
        self.albedo * leaving * hemisphere::mean_radiance(around, n)
    }

    /// Radiance of the interface under `around`.
    pub fn ambient_specular(&self, n: DVec3, e: DVec3, around: &Surroundings) -> DVec3 {
        let m = self.roughness.max(beckmann::M_MIN);
        let f = schlick::f_rough(self.f0, self.roughness, n.dot(e));
        f * hemisphere::mirrored_radiance(around, n, e, m)
    }

    /// How much of what lies behind is hidden by a base of `opacity` and by what the interface reflects away.
    pub fn alpha(&self, n: DVec3, e: DVec3, opacity: f64) -> f64 {
        1.0 - (1.0 - opacity) * (1.0 - schlick::f(self.f0, n.dot(e)).max_element())
    }
}
