//! Do all ways to give a draw its material leave one picture, by the commands that they say?

use umber::gpu::PipelineCache;
use umber::render::effects::{Build, EffectSet, Effects};
use umber::render::state_changes::{
    Call, Canvas, Case, Change, Drawing, MODES, Mode, ONE_PIPELINE, Source, Stage, TEXTURE_ARRAY,
};
use umber::render::{Picture, Settings, Variant};
use umber::report::BenchRow;
use umber::scene::{Exhibit, Order, Wall};
use umber::studies::state_changes::{BenchError, Group, Options, SceneKind, Timing, Visits};
use umber::{gpu, gpu::Samples};

use crate::harness::{Gpu, with_gpu};
use crate::tolerances;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const SEED: u64 = 7;

const OPTIONS: Options = Options {
    rounds: 2,
    further_seconds: 0.0,
    warm_up: 1,
    cell_seconds: 30.0,
    seed: SEED,
    timing: Timing::Submit,
};

fn wall(exhibit: Exhibit, materials: u32, objects: u32) -> Wall {
    Wall {
        exhibit,
        objects,
        materials,
        distinct: materials,
        pictures: materials,
    }
}

/// Works with a wall on the device.
fn on_stage<T>(
    gpu: &Gpu,
    wall: Wall,
    order: Order,
    work: impl FnOnce(&Stage, &Canvas, &PipelineCache) -> Result<T, gpu::Error>,
) -> Result<T, Box<dyn std::error::Error>> {
    let scene = wall.scene(order, SEED)?;
    let stage = Stage::new(&gpu.renderer, &scene, wall.size())?;
    let canvas = Canvas::new(&gpu.device, wall.size())?;
    let cache = PipelineCache::open(&gpu.device, None)?;
    Ok(work(&stage, &canvas, &cache)?)
}

fn picture(
    gpu: &Gpu,
    wall: Wall,
    order: Order,
    mode: &'static Mode,
) -> Result<Picture, Box<dyn std::error::Error>> {
    on_stage(gpu, wall, order, |stage, canvas, cache| {
        let case = Case::new(stage, mode, false, cache)?;
        canvas.picture(&case)
    })
}

/// The rows of a group; this device is visited each time.
fn measured(gpu: &Gpu, group: &Group, options: &Options) -> Result<Vec<BenchRow>, BenchError> {
    let mut visits = Visits::new(&gpu.device, group, options)?;
    while visits.left() > 0 {
        visits.visit(&gpu.renderer, &|_| {})?;
    }
    Ok(visits.rows())
}

#[test]
fn every_mode_draws_every_scene_in_every_order() -> Outcome {
    // A visit holds pictures and counts against what they must be.
    with_gpu(|gpu| -> Outcome {
        let modes: Vec<_> = MODES.iter().collect();
        for scene in [
            SceneKind::Bare { storage: false },
            SceneKind::Bare { storage: true },
            SceneKind::Tiny,
            SceneKind::Zoo,
            SceneKind::Patches(3),
            SceneKind::Null,
        ] {
            let group = Group::of_all(scene, 5, 40, &modes);
            let rows = measured(gpu, &group, &OPTIONS)?;
            assert_eq!(rows.len(), group.cells.len());
            for row in &rows {
                let drawn = row.mode != "nothing" && scene != SceneKind::Null;
                assert_eq!(row.image_hash.is_some(), drawn, "{row:?}");
                assert_eq!(row.samples, 2, "{row:?}");
                let hash = |mode: &str| {
                    rows.iter()
                        .find(|r| r.mode == mode && r.order == row.order)
                        .map(|r| r.image_hash.clone())
                };
                if drawn && gpu.is_lavapipe() {
                    let of = if row.mode.starts_with("texture") {
                        TEXTURE_ARRAY
                    } else {
                        ONE_PIPELINE
                    };
                    assert_eq!(Some(row.image_hash.clone()), hash(of), "{row:?}");
                }
            }
        }
        Ok(())
    })
}

#[test]
fn the_base_is_the_renderers_own_frame() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        for exhibit in [Exhibit::Triangles, Exhibit::Balls, Exhibit::Squares(5)] {
            let wall = wall(exhibit, 12, 50);
            for (name, build, allowed) in [
                (ONE_PIPELINE, Build::Scene, "without"),
                (TEXTURE_ARRAY, Build::Scene, "all"),
                ("dynamic", Build::Dynamic, "without"),
            ] {
                let map = EffectSet::of_names(["base-color-map"])?;
                let without = map
                    .iter()
                    .fold(EffectSet::ALL, |set, effect| set.without(effect));
                let settings = Settings {
                    width: wall.size().0,
                    height: wall.size().1,
                    samples: Samples::One,
                    variant: Variant::default(),
                    effects: Effects {
                        allowed: if allowed == "all" {
                            EffectSet::ALL
                        } else {
                            without
                        },
                        build,
                        ..Effects::default()
                    },
                };
                let scene = wall.scene(Order::Shuffled, SEED)?;
                let (frame, report) = gpu.render_with(&scene, &settings);
                let mode = Mode::of_name(name)?;
                let own = picture(gpu, wall, Order::Shuffled, mode)?;
                assert_eq!(own.hash(), frame.hash(), "{exhibit:?}, {name}");
                let counts = on_stage(gpu, wall, Order::Shuffled, |stage, canvas, cache| {
                    let case = Case::new(stage, mode, false, cache)?;
                    Ok(canvas.sample(&case)?.counts)
                })?;
                assert_eq!([counts], report.passes[..], "{exhibit:?}, {name}");
            }
        }
        Ok(())
    })
}

#[test]
fn objects_cover_the_pixels_that_rows_say() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        for exhibit in [Exhibit::Triangles, Exhibit::Squares(1), Exhibit::Squares(6)] {
            let wall = wall(exhibit, 3, 70);
            let picture = picture(gpu, wall, Order::Shuffled, &MODES[0])?;
            let covered = picture.pixels.iter().filter(|pixel| pixel[3] > 0.0).count();
            assert_eq!(
                covered as f64,
                70.0 * wall.pixels_per_object(),
                "{exhibit:?}"
            );
        }
        // Of balls as many as their outline, a polygon of 12 corners in a circle, encloses.
        let wall = wall(Exhibit::Balls, 3, 70);
        let picture = picture(gpu, wall, Order::Shuffled, &MODES[0])?;
        let covered = picture.pixels.iter().filter(|pixel| pixel[3] > 0.0).count();
        let share = covered as f64 / (70.0 * wall.pixels_per_object());
        assert!((0.9..1.0).contains(&share), "{share}");
        Ok(())
    })
}

#[test]
fn binds_are_those_that_follow_from_the_materials() -> Outcome {
    let counts = |gpu: &Gpu, mode, order, materials, objects| {
        on_stage(
            gpu,
            wall(Exhibit::Triangles, materials, objects),
            order,
            |stage, canvas, cache| {
                let case = Case::new(stage, mode, false, cache)?;
                let counts = canvas.sample(&case)?.counts;
                assert_eq!(counts, case.expected());
                let PassCounts {
                    draws,
                    pipeline_binds,
                    descriptor_set_binds,
                    push_constants,
                    ..
                } = counts;
                Ok([draws, pipeline_binds, descriptor_set_binds, push_constants])
            },
        )
    };
    use umber::gpu::PassCounts;
    with_gpu(|gpu| -> Outcome {
        for mode in MODES.iter().filter(|mode| mode.call == Call::Each) {
            let own_set = matches!(
                mode.source,
                Source::Window
                    | Source::OwnSet
                    | Source::BakedWithOwnSet
                    | Source::RecordWithOwnImage
            );
            let pushed = u64::from(mode.source == Source::Pushed);
            let [pipelines, sets, pushes] = mode.change.binds();
            let want = |draws: u64, changes: u64| {
                [
                    draws,
                    1 + pipelines * changes,
                    1 + u64::from(own_set) + sets * changes,
                    pushed + pushes * changes,
                ]
            };
            // Sorted, six materials change five times; each object of its own material changes at every draw; one
            // material never does.
            let name = mode.name;
            assert_eq!(
                counts(gpu, mode, Order::Sorted, 6, 60)?,
                want(60, 5),
                "{name}"
            );
            assert_eq!(
                counts(gpu, mode, Order::Shuffled, 30, 30)?,
                want(30, 29),
                "{name}"
            );
            assert_eq!(
                counts(gpu, mode, Order::Shuffled, 1, 30)?,
                want(30, 0),
                "{name}"
            );
        }
        for (name, draws) in [("indirect", 1), ("instanced", 1), ("nothing", 0)] {
            let binds = u64::from(draws > 0);
            let counted = counts(gpu, Mode::of_name(name)?, Order::Shuffled, 6, 60)?;
            assert_eq!(counted, [draws, binds, binds, 0], "{name}");
        }
        Ok(())
    })
}

#[test]
fn objects_of_glass_are_drawn_last_and_instanced_only_where_they_share_triangles() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        // Ten materials, one of them glass: 4 of 40 balls.
        let wall = wall(Exhibit::Balls, 10, 40);
        let scene = wall.scene(Order::Shuffled, SEED)?;
        let glass = |object: &umber::scene::Object| scene.materials[object.material].opacity < 1.0;
        assert_eq!(
            scene.objects.iter().filter(|object| glass(object)).count(),
            4
        );
        let counts = on_stage(gpu, wall, Order::Shuffled, |stage, canvas, cache| {
            let case = Case::new(
                stage,
                Mode::of_name("instanced").map_err(other)?,
                false,
                cache,
            )?;
            Ok(canvas.sample(&case)?.counts)
        })?;
        // Those between two of glass stand in different runs, and each of glass has triangles of its own order.
        assert!((5..=9).contains(&counts.draws), "{counts:?}");
        Ok(())
    })
}

fn other(message: String) -> gpu::Error {
    panic!("{message}")
}

#[test]
fn materials_beyond_the_pipelines_look_like_those_that_have_one() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        // Folded to four, the wall is another; its baked pipelines draw what its base draws.
        let folded = Wall {
            distinct: 4,
            ..wall(Exhibit::Squares(4), 9, 36)
        };
        let whole = wall(Exhibit::Squares(4), 9, 36);
        let [base, baked] = [ONE_PIPELINE, "pipeline-per-material"].map(Mode::of_name);
        let (base, baked) = (base?, baked?);
        let picture = |wall, mode| picture(gpu, wall, Order::Sorted, mode);
        let difference = picture(folded, baked)?.max_difference(&picture(folded, base)?);
        assert!(difference <= tolerances::SAME_PICTURE, "{difference}");
        assert_ne!(picture(folded, base)?.hash(), picture(whole, base)?.hash());
        Ok(())
    })
}

/// Draws everything with the first material's pipeline.
static WRONG_PICTURE: Mode = Mode {
    name: "wrong",
    what: "never switches",
    base: ONE_PIPELINE,
    source: Source::Baked,
    change: Change::Nothing,
    call: Call::Each,
    output: gpu::Output::Blended,
};

#[test]
fn a_mode_that_draws_something_else_fails() {
    let outcome = with_gpu(|gpu| {
        let group = Group::of_all(SceneKind::Tiny, 4, 16, &[&MODES[0], &WRONG_PICTURE]);
        measured(gpu, &group, &OPTIONS)
    });
    assert!(
        matches!(&outcome, Err(BenchError::OtherPicture { cell, .. }) if cell == "wrong, sorted" || cell == "wrong, shuffled"),
        "{outcome:?}"
    );
}

#[test]
fn both_orders_share_the_pipelines_of_a_mode() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        let modes = [&MODES[0], Mode::of_name("pipeline-per-material")?];
        let group = Group::of_all(SceneKind::Tiny, 3, 24, &modes);
        assert_eq!(group.cells.len(), 4);
        let before = gpu.device.pipelines_created();
        measured(gpu, &group, &OPTIONS)?;
        // Two visits: the base's one, and one for each material.
        assert_eq!(gpu.device.pipelines_created() - before, 2 * (1 + 3));
        Ok(())
    })
}

#[test]
fn more_draws_than_records_fit_are_refused_before_anything_is_made() {
    let outcome = with_gpu(|gpu| {
        let most = gpu.device.max_storage_bytes() / 64;
        let draws = u32::try_from(most + 1).unwrap_or(u32::MAX);
        let group = Group::of_all(SceneKind::Tiny, 1, draws, &[&MODES[0]]);
        let images = gpu.device.images_created();
        let outcome = measured(gpu, &group, &OPTIONS);
        assert_eq!(gpu.device.images_created(), images);
        (outcome, most)
    });
    let (Err(BenchError::TooManyDraws { most, .. }), room) = outcome else {
        panic!("{outcome:?}");
    };
    assert_eq!(most, room);
}

#[test]
fn what_is_recorded_and_reset_has_no_times_of_the_device() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        let options = Options {
            timing: Timing::RecordAndReset,
            ..OPTIONS
        };
        let group = Group::of_all(
            SceneKind::Null,
            4,
            100,
            &[&MODES[0], Mode::of_name("push-constant")?],
        );
        let rows = measured(gpu, &group, &options)?;
        for row in rows {
            assert!(row.record_ns_per_draw.is_some_and(|ns| ns > 0.0), "{row:?}");
            assert_eq!((row.submit_to_idle_ms, row.gpu_ms), (None, None));
        }
        Ok(())
    })
}
