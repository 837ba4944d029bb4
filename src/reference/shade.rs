//! Which colour should a pixel have?

use std::f64::consts::PI;

use glam::DVec3;

use super::coupled::Coupled;
use super::hemisphere::{Surroundings, mean_radiance};
use super::ladders::Mix;
use super::metal::Metal;
use super::punctual::{Incident, Light};
use super::slides;

/// A whole model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Lighting {
    /// The slides' starting point: ambient, Lambert, Phong's highlight.
    Phong,
    /// The slides' listings, to the letter.
    Slides,
    /// A tier of each ladder, coupled.
    Mixed(Mix),
}

impl Lighting {
    /// The slides' models, rightly normalised and coupled.
    pub const CORRECTED: Lighting = Lighting::Mixed(Mix::CORRECTED);
    /// The presets whose formulas are the slides'.
    pub const ALL: [Lighting; 3] = [Lighting::Phong, Lighting::Slides, Lighting::CORRECTED];
}

/// Which terms count. Emission always does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Terms {
    /// What the surroundings give, diffuse and specular.
    pub ambient: bool,
    /// The lamps' diffuse lobes.
    pub diffuse: bool,
    /// The lamps' specular lobes.
    pub specular: bool,
}

impl Terms {
    pub const ALL: Terms = Terms {
        ambient: true,
        diffuse: true,
        specular: true,
    };
    pub const NONE: Terms = Terms {
        ambient: false,
        diffuse: false,
        specular: false,
    };
}

/// One point of a surface, and the way to the eye.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// World space, m.
    pub position: DVec3,
    /// On the side that is seen, any length. Without direction: faces the eye.
    pub normal: DVec3,
    /// Any length. Without direction (the eye on the surface): +Y.
    pub to_eye: DVec3,
    /// Diffuse reflectance, 0..1, linear sRGB.
    pub albedo: DVec3,
    /// 0..1; 1 hides what lies behind.
    pub opacity: f64,
    /// Specular reflectance at normal incidence, 0..1.
    pub f0: DVec3,
    /// What Fresnel terms take beside f0; none for a clear interface.
    pub metal: Option<Metal>,
    /// 0..1.
    pub roughness: f64,
    /// Radiance given off, cd/m^2.
    pub emission: DVec3,
    /// Phong's exponent, >= 0.
    pub shininess: f64,
}

/// A base's and an interface's radiance, cd/m^2.
struct Lobes {
    diffuse: DVec3,
    specular: DVec3,
}

/// Radiance to the eye, premultiplied by alpha, cd/m^2 in linear sRGB; and alpha, 0..1.
///
/// The base is dimmed by opacity, the interface and emission are not. NaN where `Slides` is undefined.
pub fn shade(
    surface: &Surface,
    lights: &[Light],
    around: &Surroundings,
    lighting: Lighting,
    terms: Terms,
) -> ([f64; 3], f64) {
    let e = surface.to_eye.try_normalize().unwrap_or(DVec3::Y);
    let n = surface.normal.try_normalize().unwrap_or(e);

    let mut sum = Lobes {
        diffuse: DVec3::ZERO,
        specular: DVec3::ZERO,
    };
    if terms.ambient {
        sum = ambient(surface, n, e, around, lighting);
    }
    for incident in lights.iter().filter_map(|light| light.at(surface.position)) {
        let lobes = match lighting {
            Lighting::Phong => phong(surface, n, e, &incident),
            Lighting::Slides => slides(surface, n, e, &incident),
            Lighting::Mixed(mix) => mixed(surface, mix, n, e, &incident),
        };
        if terms.diffuse {
            sum.diffuse += lobes.diffuse;
        }
        if terms.specular {
            sum.specular += lobes.specular;
        }
    }
    let alpha = match lighting {
        Lighting::Phong | Lighting::Slides => surface.opacity,
        Lighting::Mixed(mix) => coupled(surface, mix).alpha(n, e, surface.opacity),
    };
    let radiance = sum.diffuse * surface.opacity + sum.specular + surface.emission;
    (radiance.to_array(), alpha)
}

fn coupled(surface: &Surface, mix: Mix) -> Coupled {
    Coupled {
        mix,
        albedo: surface.albedo,
        f0: surface.f0,
        metal: surface.metal.unwrap_or_else(|| Metal::clear(surface.f0)),
        roughness: surface.roughness.clamp(0.0, 1.0),
    }
}

/// The classic models have one ambient colour, albedo + f0, so that metals are not black.
fn ambient(
    surface: &Surface,
    n: DVec3,
    e: DVec3,
    around: &Surroundings,
    lighting: Lighting,
) -> Lobes {
    match lighting {
        Lighting::Phong | Lighting::Slides => Lobes {
            diffuse: (surface.albedo + surface.f0) * mean_radiance(around, n),
            specular: DVec3::ZERO,
        },
        Lighting::Mixed(mix) => Lobes {
            diffuse: coupled(surface, mix).ambient_diffuse(n, e, around),
            specular: coupled(surface, mix).ambient_specular(n, e, around),
        },
    }
}

fn phong(surface: &Surface, n: DVec3, e: DVec3, incident: &Incident) -> Lobes {
    let radiance = incident.illuminance / PI;
    Lobes {
        diffuse: radiance * surface.albedo * slides::phong::diffuse(n, incident.l),
        specular: radiance
            * surface.f0
            * slides::phong::specular(n, incident.l, e, surface.shininess),
    }
}

/// (E/pi)(albedo OrenNayar + specular CookTorrance), no further cosine. FresnelScale is the largest channel of f0,
/// and the specular colour f0 divided by it.
fn slides(surface: &Surface, n: DVec3, e: DVec3, incident: &Incident) -> Lobes {
    let radiance = incident.illuminance / PI;
    let scale = surface.f0.max_element();
    let colour = if scale > 0.0 {
        surface.f0 / scale
    } else {
        DVec3::ONE
    };
    let roughness = surface.roughness;
    let oren_nayar = slides::oren_nayar::oren_nayar(n, incident.l, e, roughness);
    let cook_torrance = slides::cook_torrance::cook_torrance(n, incident.l, e, roughness, scale);
    Lobes {
        diffuse: radiance * surface.albedo * oren_nayar,
        specular: radiance * colour * cook_torrance,
    }
}

fn mixed(surface: &Surface, mix: Mix, n: DVec3, e: DVec3, incident: &Incident) -> Lobes {
    let coupled = coupled(surface, mix);
    Lobes {
        diffuse: incident.illuminance * coupled.diffuse(n, incident.l, e),
        specular: incident.illuminance
            * coupled.specular(n, incident.l, e, incident.angular_radius),
    }
}
