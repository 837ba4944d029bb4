//! Are the sample scenes made of numbers, and drawn with one pipeline?

use std::path::Path;

use umber::gpu::Samples;
use umber::reference::shade::Lighting;
use umber::render::{Defects, Renderer};
use umber::scene::{self, LoadOptions, Scene};

use crate::harness::{whole, with_gpu};
use crate::records::record;

/// One of the sample scenes.
pub fn load(name: &str) -> Scene {
    load_from("scenes", name)
}

/// A scene in a folder of the project.
pub fn load_from(folder: &str, name: &str) -> Scene {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    match scene::load(&root.join(folder).join(name), &LoadOptions::default()) {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    }
}

/// The names of all sample scenes.
fn names() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let names: std::io::Result<Vec<_>> = std::fs::read_dir(folder)
        .into_iter()
        .flatten()
        .map(|entry| entry.map(|e| e.file_name().to_string_lossy().into_owned()))
        .collect();
    let mut names = names.unwrap_or_default();
    names.retain(|name| name.ends_with(".toml"));
    assert!(
        names.len() >= 2,
        "the sample scenes are not found: {names:?}"
    );
    names
}

#[test]
fn no_pixel_of_a_sample_scene_is_nan_infinite_or_negative() {
    for name in names() {
        let scene = load(&name);
        assert!(scene.warnings.is_empty(), "{name}: {:?}", scene.warnings);
        for samples in [Samples::One, Samples::Four] {
            let corrected = whole(Lighting::Corrected);
            let (picture, _) =
                with_gpu(|gpu| gpu.render_at(&scene, (480, 270), samples, corrected));
            assert_eq!(picture.defects(), Defects::default(), "{name}, {samples:?}");
        }
    }
}

#[test]
fn a_sample_scene_needs_one_pipeline_and_one_bind_of_each() -> Result<(), umber::gpu::Error> {
    for name in names() {
        let scene = load(&name);
        for lighting in Lighting::ALL {
            let frame = |gpu: &crate::harness::Gpu| {
                // Fresh: nothing that another test made is at hand.
                let fresh = crate::harness::Gpu {
                    device: std::sync::Arc::clone(&gpu.device),
                    renderer: Renderer::new(&gpu.device, None)?,
                };
                Ok(fresh
                    .render_at(&scene, (64, 36), Samples::One, whole(lighting))
                    .1)
            };
            let report = with_gpu(frame)?;
            assert_eq!(report.pipelines_created, 1, "{name}, {lighting:?}");
            let [pass] = &report.passes[..] else {
                panic!("{name}: {} passes", report.passes.len());
            };
            let binds = (pass.pipeline_binds, pass.descriptor_set_binds);
            assert_eq!(binds, (1, 1), "{name}, {lighting:?}");
            assert_eq!(pass.draws, scene.objects.len() as u64, "{name}");
        }
    }
    Ok(())
}

#[test]
fn the_listing_on_the_sample_scenes_is_counted() {
    for name in names() {
        let scene = load(&name);
        with_gpu(|gpu| {
            let picture = gpu.render(&scene, (480, 270), whole(Lighting::Slides));
            let defects = picture.defects();
            let pixels = picture.pixels.len();
            let counts = [
                ("nan", defects.nan),
                ("infinite", defects.infinite),
                ("negative", defects.negative),
                ("of", pixels),
            ];
            record(gpu, "slides_scenes", &name, &counts);
            // The count is the driver's; that it is a part of the picture is not.
            assert!(defects.not_finite() < pixels / 2);
        });
    }
}
