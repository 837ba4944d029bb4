//! How long does a shaded fragment take, of each form, under so many lamps?
//!
//! Layers that let light through cover the whole picture, so that none hides another. The frame of the base tier, Lambert without an
//! interface, is drawn in turn and taken off: what fetching lamps, interpolation and blending take is in every form.

use glam::{Affine3A, Quat, Vec3};

use super::evaluations::SLIDES;
use super::gallery::in_turn;
use crate::gpu::Samples;
use crate::math::statistics::{Interval, mad, median, paired_ratio};
use crate::reference::ladders::{Diffuse, Mix};
use crate::reference::shade::{Lighting, Terms};
use crate::render::effects::{ALL, Effect, EffectSet, Effects};
use crate::render::{Frame, FrameReport, RenderError, Renderer, Settings, Uploaded, Variant};
use crate::scene::{Ambient, Camera, Light, LightKind, Material, Mesh, Object, Projection, Scene};

/// Pixels a side, and layers: 131,072 fragments a frame.
const SIDE: u32 = 128;
const LAYERS: u32 = 8;
/// Forms that take turns with the listings and the base tier.
const TOGETHER: usize = 12;

/// A form's time a fragment, beyond the base tier's.
#[derive(Clone, Copy, Debug)]
pub struct Fragment {
    /// Median, ns.
    pub ns: f64,
    /// Median distance from it.
    pub ns_mad: f64,
    /// Over the slides' listings, round by round.
    pub of_slides: Interval,
}

/// Measures each form under `lamps` lamps, `rounds` frames each. `progress` hears of each form.
///
/// # Errors
/// There is no memory, or the driver fails.
pub fn fragments(
    renderer: &Renderer,
    variants: &[Variant],
    lamps: u32,
    rounds: usize,
    progress: &dyn Fn(),
) -> Result<Vec<Fragment>, RenderError> {
    let scene = layers(lamps);
    let uploaded = Uploaded::new(renderer, &scene, EffectSet::ALL)?;
    let mut all = Vec::new();
    for some in variants.chunks(TOGETHER) {
        let forms = [BASE, SLIDES].into_iter().chain(some.iter().copied());
        let frames = forms.map(|variant| frame(renderer, &uploaded, variant));
        let mut frames = frames.collect::<Result<Vec<_>, _>>()?;
        // The first round is warm-up.
        in_turn(&mut frames, 1)?;
        let reports = in_turn(&mut frames, rounds)?;
        let ms = |reports: &Vec<FrameReport>| reports.iter().map(FrameReport::ms).collect();
        let times: Vec<Vec<f64>> = reports.iter().map(ms).collect();
        for form in &times[2..] {
            all.push(of(form, &times[1], &times[0]));
            progress();
        }
    }
    Ok(all)
}

/// Lambert without an interface.
const BASE: Variant = Variant {
    lighting: Lighting::Mixed(Mix {
        diffuse: Diffuse::Lambert,
        ..Mix::CORRECTED
    }),
    terms: Terms {
        diffuse: true,
        ..Terms::NONE
    },
};

fn frame<'s>(
    renderer: &'s Renderer,
    uploaded: &'s Uploaded<'s>,
    variant: Variant,
) -> Result<Frame<'s>, RenderError> {
    // A lobe that no term counts is not computed either.
    let is_off = |effect: &&Effect| variant.lobes().contains(&(effect.constant, false));
    let allowed = ALL
        .iter()
        .filter(is_off)
        .fold(EffectSet::ALL, EffectSet::without);
    let settings = Settings {
        width: SIDE,
        height: SIDE,
        samples: Samples::One,
        variant,
        effects: Effects {
            allowed,
            ..Effects::default()
        },
    };
    Frame::new(renderer, uploaded, &settings)
}

fn of(form: &[f64], slides: &[f64], base: &[f64]) -> Fragment {
    let fragments = f64::from(SIDE * SIDE * LAYERS);
    let net = |times: &[f64]| -> Vec<f64> {
        let pairs = times.iter().zip(base);
        pairs
            .map(|(ms, base)| (ms - base) * 1e6 / fragments)
            .collect()
    };
    let (form, slides) = (net(form), net(slides));
    let pairs: Vec<_> = form.iter().copied().zip(slides).collect();
    Fragment {
        ns: median(&form).unwrap_or(f64::NAN),
        ns_mad: mad(&form).unwrap_or(f64::NAN),
        of_slides: paired_ratio(&pairs).unwrap_or(Interval::UNKNOWN),
    }
}

/// Squares before each other that fill the picture, each of a material of its own, under lamps all around.
fn layers(lamps: u32) -> Scene {
    let material = |i: u32| {
        let share = i as f32 / LAYERS as f32;
        Material {
            name: format!("layer {i}"),
            albedo: [0.2 + 0.5 * share, 0.4, 0.7 - 0.5 * share],
            f0: [0.9, 0.3 + 0.5 * share, 0.04 + 0.2 * share],
            roughness: 0.2 + 0.6 * share,
            opacity: 0.5,
            ..Material::default()
        }
    };
    // Tilted by up to a fifth, so that the cosines differ from pixel to pixel.
    let corners = [[-1.0_f32, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let normal = |[x, y]: [f32; 2]| Vec3::new(x * 0.2, y * 0.2, 1.0).normalize().to_array();
    let square = Mesh {
        name: "square".to_owned(),
        positions: corners.iter().map(|[x, y]| [*x, *y, 0.0]).collect(),
        normals: corners.map(normal).to_vec(),
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    };
    let object = |i: u32| Object {
        name: format!("layer {i}"),
        mesh: 0,
        material: i as usize,
        transform: Affine3A::from_translation(Vec3::new(0.0, 0.0, 0.01 * i as f32)),
    };
    Scene {
        camera: Camera {
            position: Vec3::new(0.0, 0.0, 4.0),
            target: Vec3::ZERO,
            up: Vec3::Y,
            projection: Projection::Orthographic { height: 2.0 },
            exposure_ev100: 0.0,
        },
        ambient: Ambient::default(),
        lights: (0..lamps).map(|i| lamp(i, lamps)).collect(),
        materials: (0..LAYERS).map(material).collect(),
        meshes: vec![square],
        textures: Vec::new(),
        objects: (0..LAYERS).map(object).collect(),
        warnings: Vec::new(),
    }
}

/// At 20 to 70 degrees from the normal.
fn lamp(i: u32, of: u32) -> Light {
    let share = (i as f32 + 0.5) / of as f32;
    let turned = Quat::from_rotation_z(share * 40.0) * Quat::from_rotation_x(0.35 + 0.87 * share);
    Light {
        name: format!("lamp {i}"),
        color: [1.0; 3],
        shadow: false,
        kind: LightKind::Directional {
            direction: -(turned * Vec3::Z),
            illuminance: 1.0,
            angular_diameter_degrees: 0.5,
        },
    }
}
