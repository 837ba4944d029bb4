//! Is a sphere shaded as its interpolated positions and normals say, also when turned and stretched?

use glam::{Affine3A, Quat, Vec3};
use umber::reference::shade::{self, Lighting, Terms};
use umber::render::Variant;
use umber::scene::shapes::Shape;
use umber::scene::{Ambient, Camera, Mesh, Object, Projection, Scene};
use umber::studies::cost::reference_light;

use crate::harness::{TERM_SETS, with_gpu};
use crate::patches::{material, surface, surroundings, towards};
use crate::tolerances;

const SIZE: u32 = 192;
const HEIGHT: f32 = 3.0;
const PIXELS_PER_METRE: f64 = SIZE as f64 / HEIGHT as f64;

fn scene(transform: Affine3A, roughness: f32) -> Scene {
    let parts = Shape::Sphere.parts();
    Scene {
        camera: Camera {
            position: Vec3::new(0.0, 0.0, 9.0),
            target: Vec3::ZERO,
            up: Vec3::Y,
            projection: Projection::Orthographic { height: HEIGHT },
            exposure_ev100: 0.0,
        },
        ambient: Ambient {
            sky: [0.3, 0.5, 0.9],
            ground: [0.2, 0.1, 0.05],
        },
        lights: vec![towards(Vec3::new(0.5, 0.6, 0.8).normalize(), [2.0; 3])],
        materials: vec![material([0.8, 0.4, 0.1], [0.04, 0.3, 0.95], roughness)],
        meshes: parts.into_iter().map(|part| part.mesh).collect(),
        objects: vec![Object {
            name: "sphere".into(),
            mesh: 0,
            material: 0,
            transform,
        }],
        textures: Vec::new(),
        warnings: Vec::new(),
    }
}

/// World positions and unit normals of each triangle's corners. The normal matrix is the inverse
/// transpose here, and cofactors in the shader.
fn triangles(mesh: &Mesh, transform: &Affine3A) -> Vec<[(Vec3, Vec3); 3]> {
    let normal_map = transform.matrix3.inverse().transpose();
    let corner = |i: u32| {
        let position = Vec3::from_array(mesh.positions[i as usize]);
        let normal = Vec3::from_array(mesh.normals[i as usize]);
        (
            transform.transform_point3(position),
            (normal_map * normal).normalize(),
        )
    };
    let (triangles, _) = mesh.indices.as_chunks::<3>();
    triangles
        .iter()
        .map(|triangle| triangle.map(corner))
        .collect()
}

/// The nearest hit of the ray through `(x, y)` along -z: position and interpolated normal; `None` also
/// where an edge is so near that the
/// rasteriser may choose either side. `winding` is -1 where the object's map mirrors.
fn hit(triangles: &[[(Vec3, Vec3); 3]], winding: f32, x: f32, y: f32) -> Option<(Vec3, Vec3)> {
    let mut best: Option<(Vec3, Vec3)> = None;
    for [(a, na), (b, nb), (c, nc)] in triangles {
        let cross = |p: Vec3, q: Vec3| (p.x - x) * (q.y - y) - (p.y - y) * (q.x - x);
        let weights = Vec3::new(cross(*b, *c), cross(*c, *a), cross(*a, *b));
        let area = weights.element_sum();
        let w = weights / area;
        if area * winding <= 0.0 || w.min_element() < 1e-3 {
            continue;
        }
        let position = *a * w.x + *b * w.y + *c * w.z;
        if best.is_none_or(|(nearest, _)| position.z > nearest.z) {
            best = Some((position, *na * w.x + *nb * w.y + *nc * w.z));
        }
    }
    best
}

/// `least_radius` is the least radius of curvature, m.
fn assert_sphere(transform: Affine3A, least_radius: f64, roughness: f32, variant: Variant) {
    let scene = scene(transform, roughness);
    let (picture, bits) = with_gpu(|gpu| {
        let picture = gpu.render(&scene, (SIZE, SIZE), variant);
        (picture, gpu.device.subpixel_bits())
    });
    let triangles = triangles(&scene.meshes[0], &transform);
    let around = surroundings(&scene.ambient);
    let lights: Vec<_> = scene.lights.iter().map(reference_light).collect();
    let winding = transform.matrix3.determinant().signum();
    let (mut compared, mut worst) = (0, 0.0_f64);
    for y in (0..SIZE).step_by(8) {
        for x in (0..SIZE).step_by(8) {
            let metres = |pixel: u32| ((pixel as f32 + 0.5) / SIZE as f32 - 0.5) * HEIGHT;
            let Some((position, normal)) = hit(&triangles, winding, metres(x), -metres(y)) else {
                continue;
            };
            // Within 3 degrees of the silhouette the interpolated normal turns by its own
            // tolerance in a hundredth of a pixel.
            let facing = f64::from(normal.normalize().z);
            if facing < 0.05 {
                continue;
            }
            let surface = surface(&scene.materials[0], position, normal, Vec3::Z);
            let (rgb, _) =
                shade::shade(&surface, &lights, &around, variant.lighting, variant.terms);
            if !rgb.iter().all(|value| value.is_finite()) {
                continue;
            }
            compared += 1;
            // Seen at a slant, a pixel is a longer way along the surface.
            let radius = least_radius * PIXELS_PER_METRE * facing;
            let tolerance = tolerances::curved_pixel(variant.lighting, bits, radius);
            for (got, want) in picture.at(x, y).into_iter().zip(rgb) {
                let share = tolerance.share(f64::from(got), want);
                worst = worst.max(share);
                assert!(
                    share <= 1.0,
                    "{variant}, pixel ({x}, {y}), N {normal:?}: {got:e} for {want:e}"
                );
            }
        }
    }
    println!("{variant}: the worst pixel takes {worst:.3} of the tolerance");
    assert!(compared > 80, "{compared} pixels were compared");
}

#[test]
fn a_sphere_in_every_model_and_term() {
    for lighting in Lighting::ALL {
        for terms in TERM_SETS {
            for roughness in [0.2, 0.6, 1.0] {
                assert_sphere(
                    Affine3A::IDENTITY,
                    1.0,
                    roughness,
                    Variant { lighting, terms },
                );
            }
        }
    }
}

#[test]
fn a_sphere_that_is_turned_and_stretched_has_the_normals_of_an_ellipsoid() {
    for scale in [Vec3::new(1.3, 0.5, 0.8), Vec3::new(-0.7, 1.2, 1.0)] {
        let transform = Affine3A::from_scale_rotation_translation(
            scale,
            Quat::from_euler(glam::EulerRot::XYZ, 0.5, 0.8, -0.3),
            Vec3::new(0.1, -0.1, 0.4),
        );
        let variant = Variant {
            lighting: Lighting::CORRECTED,
            terms: Terms::ALL,
        };
        // Where the longest half-axis ends: the shortest, squared, over it.
        let half_axes = scale.abs().as_dvec3();
        let least = half_axes.min_element().powi(2) / half_axes.max_element();
        assert_sphere(transform, least, 0.4, variant);
    }
}
