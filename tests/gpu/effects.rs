//! Does a frame contain what its scene calls for and nothing else, and is it the same picture in every build?

#[path = "effects/everything.rs"]
mod everything;
#[path = "effects/maps.rs"]
mod maps;

use umber::gpu::Samples;
use umber::reference::shade::{Lighting, Terms};
use umber::render::effects::{ALL, Build, Census, EffectSet, Effects};
use umber::render::{Picture, Settings, Variant};
use umber::scene::Scene;

use crate::harness::{Gpu, with_gpu};
use crate::{tolerances, zoo};
use everything::scene_with;

const SIZE: u32 = 32;

fn settings(effects: Effects) -> Settings {
    Settings {
        width: SIZE,
        height: SIZE,
        samples: Samples::One,
        variant: Variant {
            lighting: Lighting::CORRECTED,
            terms: Terms::ALL,
        },
        effects,
    }
}

fn built(gpu: &Gpu, scene: &Scene, build: Build) -> Picture {
    let effects = Effects {
        build,
        ..Effects::default()
    };
    gpu.render_with(scene, &settings(effects)).0
}

/// Asserts that two builds draw the same: bit by bit on lavapipe, which compiles all of them alike; elsewhere within
/// the tolerance between builds.
fn assert_same(gpu: &Gpu, a: &Picture, b: &Picture, what: &str) {
    let difference = a.max_difference(b);
    let most = if gpu.is_lavapipe() {
        0.0
    } else {
        tolerances::SAME_PICTURE
    };
    assert!(difference <= most, "{what}: {difference:e}");
}

fn names(list: &[usize]) -> String {
    let names: Vec<_> = list.iter().map(|place| ALL[*place].name).collect();
    names.join(" + ")
}

/// The scenes in which two effects are called for, or one, or none.
fn pairs() -> Vec<Vec<usize>> {
    let mut pairs = vec![Vec::new()];
    for i in 0..ALL.len() {
        pairs.push(vec![i]);
        pairs.extend((0..i).map(|j| vec![j, i]));
    }
    pairs
}

#[test]
fn every_pair_of_effects_is_the_same_picture_whatever_else_is_compiled_in() {
    with_gpu(|gpu| {
        for pair in pairs() {
            let scene = scene_with(&pair);
            let called_for = Census::of(&scene).called_for();
            assert!(
                pair.iter().all(|place| called_for.has(&ALL[*place])),
                "{}",
                names(&pair)
            );
            let all = built(gpu, &scene, Build::Dynamic);
            for build in [Build::Scene, Build::Material] {
                let what = format!("{}, {}", names(&pair), build.name());
                assert_same(gpu, &built(gpu, &scene, build), &all, &what);
            }
            assert_eq!(all.defects().not_finite(), 0, "{}", names(&pair));
        }
    });
}

#[test]
fn with_every_effect_the_three_builds_are_the_same_picture() {
    let everything: Vec<_> = (0..ALL.len()).collect();
    let scene = scene_with(&everything);
    with_gpu(|gpu| {
        let all = built(gpu, &scene, Build::Dynamic);
        for build in [Build::Scene, Build::Material] {
            let picture = built(gpu, &scene, build);
            assert_same(gpu, &picture, &all, build.name());
        }
    });
}

#[test]
fn each_effect_shows_where_it_is_called_for_and_only_there() {
    with_gpu(|gpu| {
        for (place, effect) in ALL.iter().enumerate() {
            let without = Effects {
                allowed: EffectSet::ALL.without(effect),
                ..Effects::default()
            };
            let difference = |scene: &Scene| {
                let with = built(gpu, scene, Build::Scene);
                let (picture, _) = gpu.render_with(scene, &settings(without));
                with.max_difference(&picture)
            };
            let called_for = difference(&scene_with(&[place]));
            assert!(
                called_for > 1e-3,
                "{} does not show: {called_for}",
                effect.name
            );
            let others: Vec<_> = (0..ALL.len()).filter(|other| *other != place).collect();
            let scene = scene_with(&others);
            if effect.callers(&scene).is_empty() {
                let nobody = difference(&scene);
                assert_eq!(
                    nobody, 0.0,
                    "{} shows where nobody calls for it",
                    effect.name
                );
            }
        }
    });
}

#[test]
fn an_effect_that_is_compiled_in_and_idle_changes_nothing() {
    let scene = scene_with(&[]);
    with_gpu(|gpu| {
        let (plain, _) = gpu.render_with(&scene, &settings(Effects::default()));
        for effect in &ALL {
            let idle = Effects {
                allowed: EffectSet::ALL.without(effect),
                idle: EffectSet::NONE.with(effect),
                build: Build::Scene,
            };
            let without = Effects {
                idle: EffectSet::NONE,
                ..idle
            };
            let (picture, _) = gpu.render_with(&scene, &settings(idle));
            let (base, _) = gpu.render_with(&scene, &settings(without));
            assert_same(gpu, &picture, &base, effect.name);
            if effect.callers(&scene).is_empty() {
                assert_same(gpu, &base, &plain, effect.name);
            }
        }
    });
}

#[test]
fn a_scene_that_calls_for_nothing_makes_no_extra_pass_or_image() {
    with_gpu(|gpu| {
        let images = gpu.device.images_created();
        let (_, report) = gpu.render_with(&scene_with(&[]), &settings(Effects::default()));
        let passes: Vec<_> = report
            .passes
            .iter()
            .map(|pass| pass.name.as_str())
            .collect();
        assert_eq!(passes, ["shading"]);
        // Colour and depth.
        assert_eq!(report.images_created, 2);
        assert_eq!(gpu.device.images_created() - images, 2);

        let everything: Vec<_> = (0..ALL.len()).collect();
        let scene = scene_with(&everything);
        let images = gpu.device.images_created();
        let (_, report) = gpu.render_with(&scene, &settings(Effects::default()));
        let passes: Vec<_> = report
            .passes
            .iter()
            .map(|pass| pass.name.as_str())
            .collect();
        assert_eq!(passes, ["shadow", "shading"]);
        assert_eq!(report.images_created, 3);
        // The same and an array for each of the four formats.
        assert_eq!(gpu.device.images_created() - images, 7);
        // And switched off, they are not made.
        let none = Effects {
            allowed: EffectSet::NONE,
            ..Effects::default()
        };
        let images = gpu.device.images_created();
        let (_, report) = gpu.render_with(&scene, &settings(none));
        assert_eq!(report.passes.len(), 1);
        assert_eq!(gpu.device.images_created() - images, 2);
    });
}

#[test]
fn with_every_effect_the_pass_shading_binds_one_pipeline_and_one_set() {
    let everything: Vec<_> = (0..ALL.len()).collect();
    let scene = scene_with(&everything);
    with_gpu(|gpu| {
        for build in [Build::Dynamic, Build::Scene] {
            let effects = Effects {
                build,
                ..Effects::default()
            };
            let (_, report) = gpu.render_with(&scene, &settings(effects));
            let Some(shading) = report.passes.iter().find(|pass| pass.name == "shading") else {
                panic!("no pass");
            };
            let binds = (shading.pipeline_binds, shading.descriptor_set_binds);
            assert_eq!(binds, (1, 1), "{}", build.name());
        }
    });
}

#[test]
fn what_is_left_of_the_effects_is_the_same_picture_in_every_build() {
    let everything: Vec<_> = (0..ALL.len()).collect();
    let scenes = [
        scene_with(&everything),
        zoo::load("effects/spot-light.toml"),
        zoo::load("effects/shadow.toml"),
    ];
    with_gpu(|gpu| {
        for scene in &scenes {
            for effect in &ALL {
                let left = |build| {
                    let effects = Effects {
                        allowed: EffectSet::ALL.without(effect),
                        idle: EffectSet::NONE,
                        build,
                    };
                    gpu.render_with(scene, &settings(effects)).0
                };
                let all = left(Build::Dynamic);
                assert_eq!(all.defects().not_finite(), 0, "without {}", effect.name);
                for build in [Build::Scene, Build::Material] {
                    let what = format!("without {}, {}", effect.name, build.name());
                    assert_same(gpu, &left(build), &all, &what);
                }
            }
        }
    });
}
