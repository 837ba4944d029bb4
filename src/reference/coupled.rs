//! How do the matte base and the interface above it share the light?

use std::f64::consts::PI;

use glam::DVec3;

use super::hemisphere::{self, Surroundings};
use super::ladders::{Diffuse, Fresnel, Mix, Specular};
use super::metal::Metal;
use super::reflectance::Reflectance;
use super::{
    beckmann, beckmann_smith, blinn_phong, cook_torrance, eon, fujii, full_oren_nayar, ggx,
    kulla_conty, lambert, oren_nayar, schlick, slides,
};

/// What a material is made of, as a mix of tiers sees it. Numbers are in 0..1.
#[derive(Clone, Copy, Debug)]
pub struct Coupled {
    pub mix: Mix,
    pub albedo: DVec3,
    pub f0: DVec3,
    /// What Fresnel terms take beside f0.
    pub metal: Metal,
    /// sigma of Oren and Nayar (radians), m of Beckmann, alpha of GGX.
    pub roughness: f64,
}

impl Coupled {
    /// The slides' models, rightly normalised, with a clear interface.
    pub fn corrected(albedo: DVec3, f0: DVec3, roughness: f64) -> Self {
        Self {
            mix: Mix::CORRECTED,
            albedo,
            f0,
            metal: Metal::clear(f0),
            roughness,
        }
    }

    /// f cos(theta_l) of the base: it gets what the interface lets in, and gives what it lets out.
    pub fn diffuse(&self, n: DVec3, l: DVec3, e: DVec3) -> DVec3 {
        let entering = self.reflectance().through(n.dot(l).clamp(0.0, 1.0));
        let leaving = self.reflectance().through(n.dot(e).clamp(0.0, 1.0));
        entering * leaving * self.base(n, l, e) / PI
    }

    /// pi f cos(theta_l) of the base alone.
    fn base(&self, n: DVec3, l: DVec3, e: DVec3) -> DVec3 {
        let Self {
            albedo, roughness, ..
        } = *self;
        match self.mix.diffuse {
            Diffuse::Lambert => albedo * lambert::lobe(n, l),
            Diffuse::Qon => albedo * oren_nayar::conserving_lobe(n, l, e, roughness),
            Diffuse::Fon => albedo * fujii::lobe(n, l, e, roughness),
            Diffuse::Eon => albedo.map(|albedo| eon::lobe(n, l, e, roughness, albedo)),
            Diffuse::FullOrenNayar => {
                albedo.map(|albedo| full_oren_nayar::lobe(n, l, e, roughness, albedo))
            }
            Diffuse::Slides => albedo * slides::oren_nayar::oren_nayar(n, l, e, roughness),
        }
    }

    /// f cos(theta_l) of the interface under a light of `angular_radius`, radians.
    pub fn specular(&self, n: DVec3, l: DVec3, e: DVec3, angular_radius: f64) -> DVec3 {
        let m = beckmann::under_disc(self.roughness, angular_radius);
        // Of facets that reflect everything, once.
        let facets = match self.mix.specular {
            Specular::Slides => return self.listing(n, l, e),
            Specular::BlinnPhong => blinn_phong::lobe(n, l, e, m),
            Specular::CookTorrance => cook_torrance::lobe(n, l, e, m, DVec3::ONE).x,
            Specular::BeckmannSmith => beckmann_smith::rational_lobe(n, l, e, m),
            Specular::BeckmannSmithExact => beckmann_smith::lobe(n, l, e, m),
            Specular::Ggx | Specular::GgxMulti => ggx::lobe(n, l, e, m),
        };
        let h = (l + e).try_normalize().unwrap_or(n);
        let once = self.reflectance().f(l.dot(h)) * facets;
        match self.mix.specular {
            Specular::GgxMulti => once + self.between_facets(n, l, e),
            _ => once,
        }
    }

    /// f cos(theta_l) of what bounces between facets more than once.
    fn between_facets(&self, n: DVec3, l: DVec3, e: DVec3) -> DVec3 {
        let mean = self.reflectance().mean();
        kulla_conty::lobe(n, l, e, self.roughness, mean)
    }

    /// The slides' listing, its own Fresnel term included, before light of (illuminance / pi).
    fn listing(&self, n: DVec3, l: DVec3, e: DVec3) -> DVec3 {
        let scale = self.f0.max_element();
        let colour = if scale > 0.0 {
            self.f0 / scale
        } else {
            DVec3::ONE
        };
        colour * slides::cook_torrance::cook_torrance(n, l, e, self.roughness, scale) / PI
    }

    fn reflectance(&self) -> Reflectance {
        Reflectance {
            tier: self.mix.fresnel,
            f0: self.f0,
            metal: self.metal,
        }
    }

    /// Radiance of the base under `around`.
    pub fn ambient_diffuse(&self, n: DVec3, e: DVec3, around: &Surroundings) -> DVec3 {
        let leaving = self.reflectance().through(n.dot(e).clamp(0.0, 1.0));
        self.albedo * leaving * hemisphere::mean_radiance(around, n)
    }

    /// Radiance of the interface under `around`.
    pub fn ambient_specular(&self, n: DVec3, e: DVec3, around: &Surroundings) -> DVec3 {
        let m = self.roughness.max(beckmann::M_MIN);
        let f0 = match self.mix.fresnel {
            Fresnel::Spectral => self.metal.f0,
            _ => self.f0,
        };
        let f = schlick::f_rough(f0, self.roughness, n.dot(e));
        f * hemisphere::mirrored_radiance(around, n, e, m)
    }

    /// How much of what lies behind is hidden by a base of `opacity` and by what the interface reflects away.
    pub fn alpha(&self, n: DVec3, e: DVec3, opacity: f64) -> f64 {
        let through = self.reflectance().through(n.dot(e).clamp(0.0, 1.0));
        1.0 - (1.0 - opacity) * through.min_element()
    }
}
