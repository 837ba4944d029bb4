//! Are the sample scenes made of numbers, and drawn with one pipeline?

use std::path::Path;

use umber::gpu::Samples;
use umber::reference::shade::Lighting;
use umber::scene::{self, LoadOptions, Scene};

use crate::harness::{whole, with_gpu};

/// One of the sample scenes.
pub fn load(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("scenes")
        .join(name);
    match scene::load(&path, &LoadOptions::default()) {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn no_pixel_of_a_sample_scene_is_nan_infinite_or_negative() {
    for name in ["zoo.toml", "roughness.toml"] {
        let scene = load(name);
        assert!(scene.warnings.is_empty(), "{name}: {:?}", scene.warnings);
        let (picture, report) = with_gpu(|gpu| {
            gpu.render_at(&scene, (480, 270), Samples::One, whole(Lighting::Corrected))
        });
        let defects = picture.defects();
        assert_eq!(defects, umber::render::Defects::default(), "{name}");
        let [pass] = &report.passes[..] else {
            panic!("{name}: {} passes", report.passes.len());
        };
        assert_eq!(
            (pass.pipeline_binds, pass.descriptor_set_binds),
            (1, 1),
            "{name}"
        );
        assert_eq!(pass.draws, scene.objects.len() as u64, "{name}");
    }
}

#[test]
fn the_listing_on_the_sample_scenes_is_counted() {
    for name in ["zoo.toml", "roughness.toml"] {
        let scene = load(name);
        with_gpu(|gpu| {
            let defects = gpu
                .render(&scene, (480, 270), whole(Lighting::Slides))
                .defects();
            let device = &gpu.device.info().name;
            println!("slides on {name}, {device}: {defects:?}");
            // The count is the driver's; that it is a part of the picture is not.
            assert!(defects.not_finite() < 480 * 270 / 2);
        });
    }
}
