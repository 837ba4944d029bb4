//! Is each tier of each ladder drawn as f64 has it, and does what claims to lose no light lose none?

use std::f64::consts::PI;

use glam::{DVec3, Quat, Vec3};
use umber::interface::ProbeInput;
use umber::math::frame::spherical;
use umber::math::quadrature::{GaussLegendre, equal_breaks};
use umber::reference::ladders::{Diffuse, Fresnel, Mix, Specular};
use umber::reference::shade::{Lighting, Terms};
use umber::reference::spectral::METALS;
use umber::render::library::{Function, Tier};
use umber::render::probe::Probe;
use umber::render::{Defects, Variant};
use umber::scene::{Ambient, Material};

use crate::harness::{Gpu, whole, with_gpu};
use crate::patches::{Patch, Patches, assert_predicted, material, towards};
use crate::tolerances;

/// Each tier in place of its own in the corrected mix.
fn mixes() -> Vec<Mix> {
    let corrected = Mix::CORRECTED;
    let diffuse = Diffuse::ALL.map(|diffuse| Mix {
        diffuse,
        ..corrected
    });
    let specular = Specular::ALL.map(|specular| Mix {
        specular,
        fresnel: match specular {
            Specular::Slides => Fresnel::Scale,
            _ => corrected.fresnel,
        },
        ..corrected
    });
    let fresnel = Fresnel::ALL.map(|fresnel| Mix {
        fresnel,
        ..corrected
    });
    let all = diffuse.into_iter().chain(specular).chain(fresnel);
    all.chain([Mix::BEST]).collect()
}

fn materials() -> Vec<Material> {
    let coated = [0.1, 0.3, 0.6, 1.0]
        .map(|roughness| material([0.8, 0.4, 0.1], [0.04, 0.3, 0.95], roughness));
    let metals = METALS.iter().map(|metal| {
        let numbers = metal.metal();
        let f0 = numbers.f0.min(DVec3::ONE).as_vec3().to_array();
        Material {
            metal: Some(numbers),
            ..material([0.0; 3], f0, 0.25)
        }
    });
    coated.into_iter().chain(metals).collect()
}

/// Normals from 3 to 84 degrees away from the eye, and all materials.
fn cases(to_eye: Vec3) -> Vec<Patch> {
    let side = to_eye.any_orthonormal_vector();
    let mut patches = Vec::new();
    for tilt in 0..10 {
        for turn in 0..7 {
            let turn = Quat::from_axis_angle(to_eye, turn as f32 * std::f32::consts::TAU / 7.0);
            let tilt = Quat::from_axis_angle(turn * side, (3.0 + 9.0 * tilt as f32).to_radians());
            let patch = |material| Patch {
                normal: tilt * to_eye,
                material,
            };
            patches.extend(materials().into_iter().map(patch));
        }
    }
    patches
}

#[test]
fn every_tier_is_drawn_as_f64_has_it() {
    let to_eye = Vec3::new(0.3, 0.5, 0.8).normalize();
    for tilt in [8.0_f32, 50.0, 110.0] {
        let away = Quat::from_axis_angle(to_eye.any_orthonormal_vector(), tilt.to_radians());
        let patches = Patches {
            to_eye,
            lights: vec![towards(away * to_eye, [3.0, 2.0, 1.0])],
            ambient: Ambient {
                sky: [0.3, 0.5, 0.9],
                ground: [0.2, 0.1, 0.05],
            },
            patches: cases(to_eye),
        };
        for mix in mixes() {
            let variant = Variant {
                lighting: Lighting::Mixed(mix),
                terms: Terms::ALL,
            };
            assert_predicted(&patches, variant, tolerances::pixel(variant.lighting));
        }
    }
}

#[test]
fn no_tier_makes_a_pixel_that_is_no_number() {
    for name in ["roughness.toml", "colour-shift.toml"] {
        let scene = crate::zoo::load(name);
        let safe = |mix: &Mix| mix.diffuse != Diffuse::Slides && mix.specular != Specular::Slides;
        for mix in mixes().into_iter().filter(safe) {
            let variant = whole(Lighting::Mixed(mix));
            let picture = with_gpu(|gpu| gpu.render(&scene, (320, 180), variant));
            assert_eq!(picture.defects(), Defects::default(), "{name}: {mix}");
        }
    }
}

/// A direction to the light, and how much of the hemisphere it stands for.
type Node = (DVec3, f64);

/// What a function gives back on the device: its values at the nodes of a rule over the light's directions, summed in f64.
fn sum(probe: &Probe, nodes: &[Node], roughness: f64, eye: DVec3) -> Result<f64, Failed> {
    let function = probe.function();
    let narrow = |v: DVec3| v.as_vec3().to_array();
    let inputs: Vec<_> = nodes
        .iter()
        .map(|(light, _)| {
            let vectors = [DVec3::Z, *light, eye].map(narrow);
            ProbeInput {
                extra: function.extra_at([1.0; 4]),
                ..ProbeInput::new(vectors, roughness as f32, 1.0)
            }
        })
        .collect();
    let values = probe.at(&inputs)?;
    let weighted = values.iter().zip(nodes);
    Ok(weighted
        .map(|(result, (_, weight))| f64::from(result.value) * weight)
        .sum())
}

/// Directional albedo of ggx-multi: the narrow lobe of one bounce by its facets, and what is more of the others all around.
fn albedo_of_facets([once, all]: &[Probe; 2], alpha: f64, cosine: f64) -> Result<f64, Failed> {
    let (eye, around) = (eye(cosine), all_around());
    let narrow = sum(once, &by_half_vectors(alpha, eye), alpha, eye)?;
    let more = sum(all, &around, alpha, eye)? - sum(once, &around, alpha, eye)?;
    Ok(narrow + more)
}

fn probe(gpu: &Gpu, name: &str) -> Result<Probe, Failed> {
    Ok(Probe::new(
        &gpu.device,
        Function::of_name(name)?,
        Tier::F32,
    )?)
}

type Failed = Box<dyn std::error::Error>;

fn eye(cosine: f64) -> DVec3 {
    DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine)
}

/// Denser towards the surface and towards the plane of the eye.
fn all_around() -> Vec<Node> {
    let rule = GaussLegendre::new(12);
    let mut nodes = Vec::new();
    let cosines = [0.0, 0.01, 0.05, 0.15, 0.3, 0.5, 0.7, 0.85, 0.95, 1.0];
    let azimuths = [0.0, 0.02, 0.1, 0.3, 0.8, 1.6, 2.4, PI];
    for (mu, mu_weight) in rule.places(&cosines) {
        for (phi, phi_weight) in rule.places(&azimuths) {
            // Symmetric: half the azimuths stand for all.
            nodes.push((spherical(mu.acos(), phi), 2.0 * mu_weight * phi_weight));
        }
    }
    nodes
}

/// As likely as GGX's facets mirror light there: slopes r = alpha tan(t), up to those that mirror the horizon, where
/// dL = 4 (e.h) dh, dh = cos^3 r dr dphi and dr = alpha dt / cos(t)^2.
fn by_half_vectors(alpha: f64, e: DVec3) -> Vec<Node> {
    let rule = GaussLegendre::new(16);
    let mut nodes = Vec::new();
    for (phi, phi_weight) in rule.places(&equal_breaks(0.0, PI, 4)) {
        let across = e.x * phi.cos();
        let steepest = (across + across.hypot(e.z)) / e.z;
        let last = (steepest / alpha).atan();
        for (t, t_weight) in rule.places(&equal_breaks(0.0, last, 6)) {
            let r = alpha * t.tan();
            let h = DVec3::new(r * phi.cos(), r * phi.sin(), 1.0);
            let (h, cosine) = (h.normalize(), 1.0 / h.length());
            let light = h * (2.0 * e.dot(h)) - e;
            let spread = cosine.powi(3) * r * alpha / t.cos().powi(2);
            nodes.push((light, 2.0 * phi_weight * t_weight * 4.0 * e.dot(h) * spread));
        }
    }
    nodes
}

#[test]
fn eon_loses_no_light() -> Result<(), Failed> {
    with_gpu(|gpu| {
        let eon = probe(gpu, "eon")?;
        let mut worst = 0.0_f64;
        for step in 0..=20 {
            let roughness = f64::from(step) / 20.0;
            for cosine in [0.01, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0] {
                let back = sum(&eon, &all_around(), roughness, eye(cosine))? / PI;
                worst = worst.max((back - 1.0).abs());
            }
        }
        println!("eon: albedo within {worst:.1e} of 1");
        assert!(worst <= tolerances::EON_FURNACE, "{worst}");
        Ok(())
    })
}

#[test]
fn ggx_multi_loses_no_light() -> Result<(), Failed> {
    with_gpu(|gpu| {
        let probes = [probe(gpu, "ggx")?, probe(gpu, "ggx-multi")?];
        let mut worst = (0.0_f64, 0.0, 0.0);
        for step in 0..=40 {
            // From smooth to rough, at nodes of the table and between.
            let alpha = (0.1 + 0.9 * f64::from(step) / 40.0).powi(3).max(0.01);
            for cosine in [0.01, 0.03, 0.1, 0.21, 0.35, 0.5, 0.67, 0.81, 0.93, 1.0] {
                let off = (albedo_of_facets(&probes, alpha, cosine)? - 1.0).abs();
                if off > worst.0 {
                    worst = (off, alpha, cosine);
                }
            }
        }
        println!("ggx-multi: albedo within {worst:?} of 1");
        assert!(worst.0 <= tolerances::GGX_FURNACE, "{worst:?}");
        Ok(())
    })
}
