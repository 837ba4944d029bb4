//! How much does an interface reflect, by the tier of its Fresnel term?

use std::sync::LazyLock;

use glam::DVec3;

use super::ladders::Fresnel;
use super::metal::Metal;
use super::{conductor, dielectric, f82, schlick, spectral};
use crate::math::quadrature::GaussLegendre;

/// The curves are smooth but for a square root at grazing, where mu weighs them with 0: good to 1e-6.
const NODES: usize = 64;

static RULE: LazyLock<GaussLegendre> = LazyLock::new(|| GaussLegendre::new(NODES));

/// An interface and the term that it is seen by.
#[derive(Clone, Copy, Debug)]
pub struct Reflectance {
    /// The term.
    pub tier: Fresnel,
    /// At normal incidence, 0..1.
    pub f0: DVec3,
    /// Its other numbers.
    pub metal: Metal,
}

impl Reflectance {
    /// F where the light's cosine on a facet is `mu`, 0..1, per channel.
    pub fn f(&self, mu: f64) -> DVec3 {
        let Metal {
            tint,
            n,
            k,
            coefficients,
            ..
        } = self.metal;
        match self.tier {
            Fresnel::Scale => {
                let scale = self.f0.max_element();
                let colour = if scale > 0.0 {
                    self.f0 / scale
                } else {
                    DVec3::ONE
                };
                colour * schlick::f(DVec3::splat(scale), mu)
            }
            Fresnel::Schlick => schlick::f(self.f0, mu),
            Fresnel::F82 => f82::f(self.f0, tint, mu),
            Fresnel::Dielectric => self.f0.map(|f0| dielectric::f(f0, mu)),
            Fresnel::Conductor => per_channel(|i| conductor::f(n[i], k[i], mu)),
            Fresnel::Spectral => spectral::f(self.metal.f0, coefficients, mu),
        }
    }

    /// What is let through, 1 - F; 0 where a channel reflects more than 1. A metal's own terms are none of it: there is no base below them.
    pub fn through(&self, mu: f64) -> DVec3 {
        let reflected = match self.tier {
            Fresnel::Spectral => schlick::f(self.metal.f0, mu),
            _ => self.f(mu),
        };
        (DVec3::ONE - reflected).max(DVec3::ZERO)
    }

    /// The mean of F over the cosine, 2 int F mu dmu.
    pub fn mean(&self) -> DVec3 {
        let places = RULE.places(&[0.0, 1.0]);
        places
            .map(|(mu, weight)| 2.0 * mu * weight * self.f(mu))
            .sum()
    }
}

fn per_channel(of: impl Fn(usize) -> f64) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(of))
}
