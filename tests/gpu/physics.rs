//! Is the light that leaves a flat patch the light that f64 predicts, for every model and term?

use glam::{Quat, Vec3};
use umber::reference::shade::{Lighting, Terms};
use umber::render::Variant;
use umber::scene::{Ambient, Light, LightKind, Projection};

use crate::harness::{TERM_SETS, with_gpu};
use crate::patches::{DARK, Patch, Patches, assert_predicted, material, towards};
use crate::tolerances;

const ROUGHNESSES: [f32; 6] = [0.1, 0.2, 0.35, 0.5, 0.75, 1.0];

/// Normals around the direction to the eye, up to `degrees` away from it.
fn normals(to_eye: Vec3, degrees: f32) -> Vec<Vec3> {
    let side = to_eye.any_orthonormal_vector();
    let mut normals = Vec::new();
    for tilt in 0..12 {
        // From 2 degrees, so that no case is the slides' undefined E = N.
        let tilt = (2.0 + (degrees - 2.0) * tilt as f32 / 11.0).to_radians();
        for turn in 0..12 {
            let turn = Quat::from_axis_angle(to_eye, turn as f32 * std::f32::consts::TAU / 12.0);
            normals.push(Quat::from_axis_angle(turn * side, tilt) * to_eye);
        }
    }
    normals
}

fn cases(to_eye: Vec3, degrees: f32) -> Vec<Patch> {
    let rough = |roughness| {
        normals(to_eye, degrees)
            .into_iter()
            .map(move |normal| Patch {
                normal,
                material: material([0.8, 0.4, 0.1], [0.04, 0.3, 0.95], roughness),
            })
    };
    ROUGHNESSES.into_iter().flat_map(rough).collect()
}

fn variants() -> impl Iterator<Item = Variant> {
    Lighting::ALL
        .into_iter()
        .flat_map(|lighting| TERM_SETS.map(|terms| Variant { lighting, terms }))
}

fn around() -> Ambient {
    Ambient {
        sky: [0.3, 0.5, 0.9],
        ground: [0.2, 0.1, 0.05],
    }
}

#[test]
fn a_directional_light_over_roughness_and_angle() {
    let to_eye = Vec3::new(0.3, 0.5, 0.8).normalize();
    // At 120 degrees Phong's mirror direction points behind the surface.
    for tilt in [5.0_f32, 35.0, 70.0, 120.0] {
        let away = Quat::from_axis_angle(to_eye.any_orthonormal_vector(), tilt.to_radians());
        let patches = Patches {
            to_eye,
            lights: vec![towards(away * to_eye, [3.0, 2.0, 1.0])],
            ambient: around(),
            patches: cases(to_eye, 85.0),
        };
        for variant in variants() {
            assert_predicted(&patches, variant, tolerances::pixel(variant.lighting));
        }
    }
}

#[test]
fn point_and_spot_lights_by_distance_and_cone() {
    let to_eye = Vec3::new(-0.2, 0.9, 0.4).normalize();
    let spot = LightKind::Spot {
        position: Vec3::new(6.0, 14.0, -2.0),
        direction: Vec3::new(-0.4, -0.9, 0.15).normalize(),
        intensity: 300.0,
        radius: 0.3,
        inner_degrees: 20.0,
        outer_degrees: 50.0,
    };
    let point = LightKind::Point {
        position: Vec3::new(-3.0, 9.0, 8.0),
        intensity: 120.0,
        radius: 0.05,
    };
    let light = |kind| Light {
        name: "case".into(),
        color: [1.0, 0.7, 0.4],
        shadow: false,
        kind,
    };
    let patches = Patches {
        to_eye,
        lights: vec![light(spot), light(point)],
        ambient: DARK,
        patches: cases(to_eye, 70.0),
    };
    for variant in variants().filter(|variant| variant.terms != TERM_SETS[0]) {
        assert_predicted(&patches, variant, tolerances::pixel(variant.lighting));
    }
}

#[test]
fn several_lights_add_up() {
    let to_eye = Vec3::Z;
    let directions = [
        Vec3::new(0.5, 0.5, 1.0),
        Vec3::new(-1.0, 0.2, 0.6),
        Vec3::Y + Vec3::Z,
    ];
    let lights: Vec<_> = directions
        .iter()
        .map(|direction| towards(direction.normalize(), [1.0, 0.5, 0.25]))
        .collect();
    let patches = Patches {
        to_eye,
        lights,
        ambient: around(),
        patches: cases(to_eye, 60.0),
    };
    for lighting in Lighting::ALL {
        let variant = Variant {
            lighting,
            terms: Terms::ALL,
        };
        assert_predicted(&patches, variant, tolerances::pixel(variant.lighting));
    }
}

#[test]
fn mirrors_and_other_smooth_surfaces_show_the_light_itself() {
    // Close to the peak, where a mirror's highlight is: N within a few widths of the half vector.
    let to_eye = Vec3::new(0.1, 0.2, 0.97).normalize();
    let to_light = Vec3::new(-0.4, 0.6, 0.7).normalize();
    let half = (to_eye + to_light).normalize();
    let patches: Vec<_> = [0.0_f32, 1e-3, 1e-2, 0.05]
        .into_iter()
        .flat_map(|roughness| {
            (0..64).map(move |step| {
                let width = roughness.max(2e-3);
                let tilt = width * step as f32 / 20.0;
                let axis = half.any_orthonormal_vector();
                Patch {
                    normal: Quat::from_axis_angle(axis, tilt) * half,
                    material: material([0.0; 3], [0.9, 0.6, 0.3], roughness),
                }
            })
        })
        .collect();
    let patches = Patches {
        to_eye,
        lights: vec![towards(to_light, [1.0; 3])],
        ambient: DARK,
        patches,
    };
    let variant = Variant::default();
    assert_predicted(&patches, variant, tolerances::SMOOTH_PIXEL);
    let brightest = with_gpu(|gpu| patches.rendered(gpu, variant))
        .into_iter()
        .map(|pixel| pixel[0])
        .fold(0.0, f32::max);
    assert!(brightest > 1e4, "the mirror's peak is there: {brightest:e}");
}

#[test]
fn emission_is_added_and_opacity_dims_the_base_alone() {
    let to_eye = Vec3::Z;
    let mut patches = cases(to_eye, 80.0);
    for (i, patch) in patches.iter_mut().enumerate() {
        patch.material.opacity = (i % 11) as f32 / 10.0;
        patch.material.emission = [0.0, 2.0, (i % 7) as f32];
    }
    let patches = Patches {
        to_eye,
        lights: vec![towards(Vec3::new(0.6, 0.0, 0.8), [1.0; 3])],
        ambient: around(),
        patches,
    };
    for lighting in Lighting::ALL {
        let variant = Variant {
            lighting,
            terms: Terms::ALL,
        };
        assert_predicted(&patches, variant, tolerances::pixel(variant.lighting));
    }
}

#[test]
fn no_input_makes_a_corrected_pixel_that_is_no_number() {
    let to_eye = Vec3::new(0.0, 1.0, 0.2).normalize();
    let awkward = [
        Vec3::ZERO,
        Vec3::splat(1e-30),
        Vec3::splat(f32::MIN_POSITIVE),
        to_eye,
        -to_eye,
        to_eye.any_orthonormal_vector(),
        Vec3::new(1e18, 1.0, 1e-18),
    ];
    let patches: Vec<_> = awkward
        .into_iter()
        .flat_map(|normal| {
            [0.0, 1e-6, 0.3, 1.0].map(|roughness| Patch {
                normal,
                material: material([1.0; 3], [1.0; 3], roughness),
            })
        })
        .collect();
    for to_light in [to_eye, -to_eye, to_eye.any_orthonormal_vector()] {
        let mut patches = Patches {
            to_eye,
            lights: vec![towards(to_light, [1.0; 3])],
            ambient: around(),
            patches: patches.clone(),
        };
        // Lamps on a patch, as near as f32 has it, larger than their distance, and beyond all reach.
        let lamps = [
            (patches.middle(0), 1e-3),
            (patches.middle(0) + to_eye * 1e-16, 1e-18),
            (patches.middle(9), 5.0),
            (to_eye * 1e19, 1.0),
        ];
        for (position, radius) in lamps {
            patches.lights.push(Light {
                name: "on the surface".into(),
                color: [1.0; 3],
                shadow: false,
                kind: LightKind::Point {
                    position,
                    intensity: 1e12,
                    radius,
                },
            });
        }
        let pixels = with_gpu(|gpu| patches.rendered(gpu, Variant::default()));
        for (pixel, patch) in pixels.into_iter().zip(&patches.patches) {
            let good = pixel.iter().all(|value| value.is_finite() && *value >= 0.0);
            assert!(good, "{pixel:?} from {patch:?}, light towards {to_light:?}");
        }
    }
}

#[test]
fn a_faint_interface_fades_at_grazing_too() {
    // Below 2 %, and the largest channel is not the first.
    let to_eye = Vec3::Z;
    let mut patches = cases(to_eye, 85.0);
    for patch in &mut patches {
        patch.material.f0 = [0.002, 0.01, 0.0];
    }
    let patches = Patches {
        to_eye,
        lights: vec![towards(Vec3::new(0.6, 0.0, 0.8), [1.0; 3])],
        ambient: around(),
        patches,
    };
    assert_predicted(&patches, Variant::default(), tolerances::CORRECTED_PIXEL);
}

#[test]
fn inside_a_lamp_light_stops_growing() {
    let to_eye = Vec3::Z;
    let lamp = Light {
        name: "larger than its distance".into(),
        color: [1.0; 3],
        shadow: false,
        kind: LightKind::Point {
            position: Vec3::new(0.5, 0.5, 6.0),
            intensity: 900.0,
            radius: 40.0,
        },
    };
    let patches = Patches {
        to_eye,
        lights: vec![lamp],
        ambient: DARK,
        patches: cases(to_eye, 60.0),
    };
    assert_predicted(&patches, Variant::default(), tolerances::CORRECTED_PIXEL);
}

#[test]
fn no_normal_faces_the_eye_and_roughness_stops_at_1() {
    let to_eye = Vec3::new(0.6, 0.0, 0.8);
    let patch = |normal, roughness| Patch {
        normal,
        material: material([0.5; 3], [0.04; 3], roughness),
    };
    let patches = Patches {
        to_eye,
        lights: vec![towards(Vec3::Z, [1.0; 3])],
        ambient: around(),
        patches: vec![
            patch(Vec3::ZERO, 0.5),
            patch(to_eye, 0.5),
            patch(Vec3::Z, 1.5),
            patch(Vec3::Z, 1.0),
        ],
    };
    let got = with_gpu(|gpu| patches.rendered(gpu, Variant::default()));
    for (a, b) in [(0, 1), (2, 3)] {
        for (a, b) in got[a].into_iter().zip(got[b]) {
            let near = tolerances::CORRECTED_PIXEL.holds(f64::from(a), f64::from(b));
            assert!(near, "{a} and {b}");
        }
    }
}

#[test]
fn a_perspective_eye_is_a_place() {
    let to_eye = Vec3::new(0.3, 0.5, 0.8).normalize();
    let patches = Patches {
        to_eye,
        lights: vec![towards(Vec3::Z, [1.0; 3])],
        ambient: around(),
        patches: vec![Patch {
            normal: Vec3::Z,
            material: material([0.5; 3], [0.3; 3], 0.3),
        }],
    };
    // Off the origin, where a position is not a direction.
    let away = Vec3::new(5.0, -3.0, 2.0);
    let mut scene = patches.scene();
    scene.camera.projection = Projection::Perspective {
        vertical_fov_degrees: 4.0,
    };
    scene.camera.position += away;
    scene.camera.target += away;
    scene.objects[0].transform.translation += glam::Vec3A::from(away);
    let got = with_gpu(|gpu| gpu.render(&scene, (3, 3), Variant::default())).at(1, 1);
    let want = patches.predicted(0, Variant::default());
    for (got, want) in got.into_iter().zip(want) {
        let near = tolerances::CORRECTED_PIXEL.holds(f64::from(got), want);
        assert!(near, "{got} for {want}");
    }
}
