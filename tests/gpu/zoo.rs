//! Are the sample scenes made of numbers, and drawn with one pipeline?

use std::path::Path;

use umber::gpu::Samples;
use umber::reference::shade::Lighting;
use umber::render::effects::{Build, Effects};
use umber::render::{Defects, Renderer, Settings};
use umber::scene::{self, LoadOptions, Scene};

use crate::harness::{whole, with_gpu};
use crate::records::record;
use crate::tolerances;

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

/// The names of all sample scenes, those of single effects included.
fn names() -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut names = Vec::new();
    for folder in ["", "effects/"] {
        for entry in std::fs::read_dir(root.join(folder))
            .into_iter()
            .flatten()
            .flatten()
        {
            let name = entry.file_name().to_string_lossy().into_owned();
            if name.ends_with(".toml") {
                names.push(format!("{folder}{name}"));
            }
        }
    }
    names.sort();
    let found = names.len() >= 2 + umber::render::effects::ALL.len();
    assert!(found, "the sample scenes are not found: {names:?}");
    names
}

#[test]
fn no_pixel_of_a_sample_scene_is_nan_infinite_or_negative() {
    for name in names() {
        let scene = load(&name);
        assert!(scene.warnings.is_empty(), "{name}: {:?}", scene.warnings);
        for samples in [Samples::One, Samples::Four] {
            let corrected = whole(Lighting::CORRECTED);
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
            // One for each pass: `shadow`, where a lamp throws one, and `shading`.
            let passes = report.passes.len() as u64;
            assert_eq!(report.pipelines_created, passes, "{name}, {lighting:?}");
            let Some(pass) = report.passes.iter().find(|pass| pass.name == "shading") else {
                panic!("{name}: no pass `shading`");
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

#[test]
fn the_scene_of_an_effect_calls_for_it() {
    for effect in &umber::render::effects::ALL {
        let scene = load(&format!("effects/{}.toml", effect.name));
        let called_for = umber::render::effects::Census::of(&scene).called_for();
        assert!(called_for.has(effect), "{}: {called_for}", effect.name);
    }
}

#[test]
fn the_three_builds_of_a_sample_scene_are_the_same_picture() {
    for name in names() {
        let scene = load(&name);
        with_gpu(|gpu| {
            let picture = |build| {
                let effects = Effects {
                    build,
                    ..Effects::default()
                };
                let settings = Settings {
                    width: 160,
                    height: 90,
                    samples: Samples::One,
                    variant: whole(Lighting::CORRECTED),
                    effects,
                };
                gpu.render_with(&scene, &settings).0
            };
            let [dynamic, of_scene, of_material] = Build::ALL.map(picture);
            for picture in [of_scene, of_material] {
                let difference = picture.max_difference(&dynamic);
                assert!(
                    difference <= tolerances::SAME_PICTURE,
                    "{name}: {difference:e}"
                );
            }
        });
    }
}
