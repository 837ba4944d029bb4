//! Does one pipeline draw glass as well: blended, last, far to near?

use glam::Vec3;
use umber::gpu::Samples;
use umber::reference::shade::Lighting;
use umber::scene::{Material, Scene};

use crate::harness::{whole, with_gpu};
use crate::patches::{DARK, Patch, Patches, material};
use crate::tolerances::BLENDED_PIXEL;

fn sheet(opacity: f32, emission: [f32; 3]) -> Material {
    Material {
        opacity,
        emission,
        ..material([0.0; 3], [0.0; 3], 0.5)
    }
}

/// Sheets over each other in one place, at these heights towards the eye, in this order.
fn stack(sheets: &[(f32, Material)]) -> Scene {
    let patches = Patches {
        to_eye: Vec3::Z,
        lights: Vec::new(),
        ambient: DARK,
        patches: sheets
            .iter()
            .map(|(_, material)| Patch {
                normal: Vec3::Z,
                material: material.clone(),
            })
            .collect(),
    };
    let mut scene = patches.scene();
    for (object, (height, _)) in scene.objects.iter_mut().zip(sheets) {
        object.transform.translation = Vec3::new(0.0, 0.0, *height).into();
    }
    scene
}

fn middle_pixel(scene: &Scene) -> [f32; 4] {
    with_gpu(|gpu| gpu.render(scene, (3, 3), whole(Lighting::Phong))).at(1, 1)
}

#[test]
fn sheets_of_glass_blend_far_to_near_whatever_their_order() {
    let ground = (0.0, sheet(1.0, [0.8, 0.4, 0.2]));
    let far = (1.0, sheet(0.25, [0.0, 1.0, 0.0]));
    let near = (2.0, sheet(0.5, [0.0, 0.0, 3.0]));
    // Over: what is emitted, plus what the sheet lets through.
    let over = |color: f32, alpha: f32, behind: f32| color + (1.0 - alpha) * behind;
    let want: Vec<f32> = (0..3)
        .map(|c| {
            let behind = over(far.1.emission[c], 0.25, ground.1.emission[c]);
            over(near.1.emission[c], 0.5, behind)
        })
        .collect();
    let orders = [
        [&ground, &far, &near],
        [&near, &far, &ground],
        [&far, &ground, &near],
        [&near, &ground, &far],
    ];
    for order in orders {
        let sheets: Vec<_> = order.into_iter().cloned().collect();
        let got = middle_pixel(&stack(&sheets));
        for (got, want) in got.into_iter().zip(&want) {
            assert!(
                BLENDED_PIXEL.holds(f64::from(got), f64::from(*want)),
                "{got} for {want}: {sheets:?}"
            );
        }
        assert_eq!(got[3], 1.0, "something opaque lies behind");
    }
}

#[test]
fn what_is_opaque_and_near_hides_glass_and_ground() {
    let sheets = [
        (3.0, sheet(1.0, [0.5, 0.0, 0.0])),
        (1.0, sheet(0.5, [0.0, 9.0, 0.0])),
        (0.0, sheet(1.0, [0.0, 0.0, 9.0])),
    ];
    assert_eq!(middle_pixel(&stack(&sheets)), [0.5, 0.0, 0.0, 1.0]);
}

#[test]
fn triangles_of_one_glass_object_blend_far_to_near() {
    // Two sheets in one mesh, the near one first in its index list.
    let mut scene = stack(&[(0.0, sheet(0.5, [1.0, 0.0, 0.0]))]);
    let mesh = &mut scene.meshes[0];
    let far: Vec<_> = mesh
        .positions
        .iter()
        .map(|[x, y, z]| [*x, *y, z - 1.0])
        .collect();
    mesh.positions.extend(far);
    mesh.normals.extend(vec![[0.0, 0.0, 1.0]; 4]);
    mesh.indices.extend([4, 5, 6, 4, 6, 7]);
    let got = middle_pixel(&scene);
    assert_eq!(got, [1.5, 0.0, 0.0, 0.75], "both sheets are seen");
    // Turned about, the sheet that was far is near.
    scene.objects[0].transform = glam::Affine3A::from_rotation_y(std::f32::consts::PI);
    let got = middle_pixel(&scene);
    assert_eq!(got, [1.5, 0.0, 0.0, 0.75], "sorted where they stand");
}

#[test]
fn of_two_opaque_faces_in_one_place_the_first_stays() {
    let sheets = [
        (0.0, sheet(1.0, [1.0, 0.0, 0.0])),
        (0.0, sheet(1.0, [0.0, 1.0, 0.0])),
    ];
    assert_eq!(middle_pixel(&stack(&sheets)), [1.0, 0.0, 0.0, 1.0]);
}

#[test]
fn four_samples_average_an_edge_and_leave_the_rest_alone() {
    let patches = Patches {
        to_eye: Vec3::Z,
        lights: Vec::new(),
        ambient: DARK,
        patches: vec![Patch {
            normal: Vec3::Z,
            material: sheet(1.0, [4.0, 2.0, 1.0]),
        }],
    };
    let mut scene = patches.scene();
    scene.objects[0].transform = glam::Affine3A::from_rotation_z(0.3);
    let one = with_gpu(|gpu| gpu.render(&scene, (32, 32), whole(Lighting::CORRECTED)));
    let (four, _) =
        with_gpu(|gpu| gpu.render_at(&scene, (32, 32), Samples::Four, whole(Lighting::CORRECTED)));
    assert_eq!(one.at(16, 16), [4.0, 2.0, 1.0, 1.0]);
    assert_eq!(four.at(16, 16), [4.0, 2.0, 1.0, 1.0]);
    let steps = |value: f32| (value * 4.0).fract() == 0.0;
    assert!(
        one.pixels
            .iter()
            .all(|pixel| [0.0, 1.0].contains(&pixel[3]))
    );
    assert!(four.pixels.iter().all(|pixel| steps(pixel[3])));
    let partly = four
        .pixels
        .iter()
        .filter(|pixel| pixel[3] > 0.0 && pixel[3] < 1.0)
        .count();
    assert!(partly >= 16, "{partly} edge pixels are partly covered");
}

#[test]
fn both_sides_of_a_face_are_lit_and_a_mirrored_object_is_no_different() {
    let patches = Patches {
        to_eye: Vec3::Z,
        lights: vec![crate::patches::towards(Vec3::new(0.0, 0.6, 0.8), [1.0; 3])],
        ambient: DARK,
        patches: vec![Patch {
            normal: Vec3::Z,
            material: material([0.5; 3], [0.04; 3], 0.4),
        }],
    };
    let plain = patches.scene();
    let mut behind = plain.clone();
    behind.objects[0].transform = glam::Affine3A::from_rotation_y(std::f32::consts::PI);
    let mut mirrored = plain.clone();
    mirrored.objects[0].transform = glam::Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    let mut inverted = plain.clone();
    inverted.objects[0].transform = glam::Affine3A::from_scale(Vec3::new(1.0, 1.0, -1.0));
    let want = middle_pixel_corrected(&plain);
    assert!(want[0] > 0.1);
    for (scene, name) in [
        (behind, "behind"),
        (mirrored, "mirrored"),
        (inverted, "inverted"),
    ] {
        let got = middle_pixel_corrected(&scene);
        for (got, want) in got.into_iter().zip(want) {
            let near = BLENDED_PIXEL.holds(f64::from(got), f64::from(want));
            assert!(near, "{name}: {got} for {want}");
        }
    }
}

fn middle_pixel_corrected(scene: &Scene) -> [f32; 4] {
    with_gpu(|gpu| gpu.render(scene, (3, 3), whole(Lighting::CORRECTED))).at(1, 1)
}

#[test]
fn a_one_sided_face_is_seen_from_its_front_alone_mirrored_or_not() {
    let patches = Patches {
        to_eye: Vec3::Z,
        lights: Vec::new(),
        ambient: DARK,
        patches: vec![Patch {
            normal: Vec3::Z,
            material: Material {
                two_sided: false,
                ..sheet(1.0, [1.0; 3])
            },
        }],
    };
    let half_turn = glam::Affine3A::from_rotation_y(std::f32::consts::PI);
    let mirror = glam::Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    let cases = [
        ("as it is", glam::Affine3A::IDENTITY, true),
        ("from behind", half_turn, false),
        ("mirrored", mirror, true),
        ("mirrored, from behind", half_turn * mirror, false),
    ];
    for (name, transform, seen) in cases {
        let mut scene = patches.scene();
        scene.objects[0].transform = transform;
        assert_eq!(middle_pixel(&scene)[3] > 0.0, seen, "{name}");
    }
}
