//! Is it true that one pipeline and one descriptor set serve every material?

use glam::{Affine3A, Vec3};
use umber::gpu::{PassCounts, Samples};
use umber::reference::shade::{Lighting, Terms};
use umber::render::{Renderer, Variant};
use umber::scene::{Ambient, Camera, Material, Mesh, Object, Projection, Scene};

use crate::harness::{Gpu, whole, with_gpu};

/// A scene of `count` small triangles on a grid, each of a material of its own; every seventh lets
/// light through, every third shines, every fifth is a metal.
fn scene(count: usize) -> Scene {
    let columns = (count as f64).sqrt().ceil() as usize;
    let triangle = Mesh {
        name: "triangle".into(),
        positions: vec![[0.0, 0.0, 0.0], [0.8, 0.0, 0.0], [0.0, 0.8, 0.0]],
        normals: vec![[0.0, 0.0, 1.0]; 3],
        indices: vec![0, 1, 2],
        ..Mesh::default()
    };
    let material = |i: usize| Material {
        name: format!("material {i}"),
        albedo: if i.is_multiple_of(5) {
            [0.0; 3]
        } else {
            [0.5, (i % 11) as f32 / 11.0, 0.2]
        },
        f0: if i.is_multiple_of(5) {
            [0.9, 0.7, 0.3]
        } else {
            [0.04; 3]
        },
        roughness: (i % 13) as f32 / 12.0,
        opacity: if i.is_multiple_of(7) { 0.3 } else { 1.0 },
        emission: if i.is_multiple_of(3) {
            [1.0, 0.0, 0.0]
        } else {
            [0.0; 3]
        },
        shininess: i as f32 % 100.0,
        ..Material::default()
    };
    let object = |i: usize| Object {
        name: format!("object {i}"),
        mesh: 0,
        material: i,
        transform: Affine3A::from_translation(Vec3::new(
            (i % columns) as f32,
            (i / columns) as f32,
            0.0,
        )),
    };
    let middle = Vec3::new(columns as f32, columns as f32, 0.0) / 2.0;
    Scene {
        camera: Camera {
            position: middle + Vec3::Z * 10.0,
            target: middle,
            up: Vec3::Y,
            projection: Projection::Orthographic {
                height: columns as f32,
            },
            exposure_ev100: 0.0,
        },
        ambient: Ambient {
            sky: [1.0; 3],
            ground: [0.5; 3],
        },
        lights: Vec::new(),
        materials: (0..count).map(material).collect(),
        meshes: vec![triangle],
        objects: (0..count).map(object).collect(),
        textures: Vec::new(),
        warnings: Vec::new(),
    }
}

#[test]
fn one_bind_of_each_for_1_8_and_10_000_materials() {
    for count in [1, 8, 10_000] {
        for lighting in Lighting::ALL {
            let (picture, report) = with_gpu(|gpu| {
                gpu.render_at(&scene(count), (200, 200), Samples::One, whole(lighting))
            });
            let expected = PassCounts {
                name: "shading".into(),
                draws: count as u64,
                pipeline_binds: 1,
                descriptor_set_binds: 1,
                push_constants: 0,
                cull_changes: 0,
            };
            assert_eq!(report.passes, [expected], "{count} materials, {lighting:?}");
            let covered = picture.pixels.iter().filter(|pixel| pixel[3] > 0.0).count();
            // A triangle covers 0.32 of its cell.
            assert!(covered > 200 * 200 / 5, "{covered} pixels are covered");
        }
    }
}

#[test]
fn ten_thousand_materials_are_ten_thousand_colours() {
    // 100 x 100 cells of 2 x 2 pixels; the lower left pixel of a cell is inside its triangle.
    let scene = scene(10_000);
    let picture = with_gpu(|gpu| gpu.render(&scene, (200, 200), whole(Lighting::Phong)));
    for i in (0..10_000_u32).filter(|i| i % 7 != 0) {
        let (column, row) = (i % 100, i / 100);
        let pixel = picture.at(column * 2, 199 - row * 2);
        let Material {
            albedo,
            f0,
            emission,
            ..
        } = &scene.materials[i as usize];
        // Facing sideways, half of the surroundings is sky and half is ground.
        for channel in 0..3 {
            let want = (albedo[channel] + f0[channel]) * 0.75 + emission[channel];
            assert!(
                (pixel[channel] - want).abs() < 1e-5,
                "material {i}: {pixel:?}"
            );
        }
    }
}

#[test]
fn a_pipeline_is_made_once_for_a_variant_and_never_for_a_material() -> Result<(), umber::gpu::Error>
{
    let made = |gpu: &Gpu| {
        let fresh = Gpu {
            device: std::sync::Arc::clone(&gpu.device),
            renderer: Renderer::new(&gpu.device, None)?,
        };
        let frame = |count: usize, samples, variant| {
            let (_, report) = fresh.render_at(&scene(count), (20, 20), samples, variant);
            report.pipelines_created
        };
        let corrected = whole(Lighting::CORRECTED);
        let diffuse = Variant {
            lighting: Lighting::CORRECTED,
            terms: Terms {
                diffuse: true,
                ..Terms::NONE
            },
        };
        let frames = [
            (1, frame(1, Samples::One, corrected), "the first"),
            (0, frame(1, Samples::One, corrected), "the same again"),
            (1, frame(8, Samples::One, corrected), "other effects"),
            (0, frame(10_000, Samples::One, corrected), "more materials"),
            (1, frame(8, Samples::Four, corrected), "other targets"),
            (1, frame(8, Samples::One, diffuse), "other terms"),
            (
                1,
                frame(8, Samples::One, whole(Lighting::Phong)),
                "another model",
            ),
            (0, frame(8, Samples::One, diffuse), "a model from before"),
        ];
        Ok(frames)
    };
    for (want, got, what) in with_gpu(made)? {
        assert_eq!(got, want, "pipelines for {what}");
    }
    Ok(())
}
