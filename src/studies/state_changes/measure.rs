//! What does a group of cells take, drawn in turn, and do they all leave one picture?

use std::time::Instant;

use super::plan::{Cell, Group, SceneKind, most_pipelines};
use super::rows::{Measured, row};
use super::{BenchError, Options, Timing};
use crate::gpu::{self, PassCounts, PipelineCache};
use crate::render::state_changes::{Call, Canvas, Case, Mode, Sample, Stage};
use crate::render::{Picture, Renderer};
use crate::report::BenchRow;
use crate::scene::{Order, Scene};

/// Distinct pictures that are made; further materials share them in turn. Every device has this many layers.
const MOST_PICTURES: u32 = 256;

/// What a picture may differ by where its code differs (DESIGN: 1e-5 relative and 1e-6 absolute).
const MAX_DIFFERENCE: f64 = 1e-5;

/// A group's scenes.
struct Scenes {
    scenes: Vec<Ordered>,
    distinct: u32,
    size: (u32, u32),
}

/// The rows of a group's cells, in their order. `progress` hears of each frame.
///
/// # Errors
/// The device cannot, a mode records other commands than it says or leaves another picture, or the driver fails.
pub fn measure(
    renderer: &Renderer,
    group: &Group,
    options: &Options,
    progress: &dyn Fn(u64),
) -> Result<Vec<BenchRow>, BenchError> {
    check_records(renderer, group)?;
    let scenes = Scenes::new(renderer, group, options)?;
    let canvas = Canvas::new(renderer.device(), scenes.size)?;
    let stages: Vec<Stage> = scenes
        .scenes
        .iter()
        .map(|ordered| Stage::new(renderer, &ordered.scene, scenes.size))
        .collect::<Result<_, _>>()?;
    let bench = Bench {
        renderer,
        group,
        options,
        scenes: &scenes,
        stages: &stages,
        canvas: &canvas,
        cache: PipelineCache::open(renderer.device(), None)?,
    };
    bench.rows(progress)
}

/// An object's record for each draw must fit what a shader may see.
fn check_records(renderer: &Renderer, group: &Group) -> Result<(), BenchError> {
    let bytes = u64::from(group.draws) * size_of::<crate::interface::Instance>() as u64;
    let limit = renderer.device().max_storage_bytes();
    if bytes > limit {
        return Err(BenchError::TooManyDraws {
            draws: group.draws,
            bytes,
            most: limit / size_of::<crate::interface::Instance>() as u64,
        });
    }
    Ok(())
}

/// The scene of one order.
struct Ordered {
    order: Order,
    /// Whether materials beyond those that have pipelines of their own look like those in turn.
    folded: bool,
    scene: Scene,
}

impl Scenes {
    fn new(renderer: &Renderer, group: &Group, options: &Options) -> Result<Self, BenchError> {
        let cells = &group.cells;
        let distinct = most_pipelines(renderer.device().info().kind).min(group.materials);
        let pictures = cells.iter().any(|cell| cell.mode.source.has_pictures());
        let pictures = if pictures { MOST_PICTURES } else { 0 };
        let capped = distinct < group.materials;
        let mut scenes = Vec::new();
        for order in Order::ALL {
            if !cells.iter().any(|cell| cell.order == order) {
                continue;
            }
            for folded in [false, true] {
                let wanted = cells.iter().any(|cell| {
                    cell.order == order && folded == (capped && cell.mode.source.is_baked())
                });
                if wanted || !folded {
                    let distinct = if folded { distinct } else { group.materials };
                    let scene = group.wall(distinct, pictures).scene(order, options.seed)?;
                    scenes.push(Ordered {
                        order,
                        folded,
                        scene,
                    });
                }
            }
        }
        Ok(Self {
            scenes,
            distinct,
            size: group.wall(distinct, pictures).size(),
        })
    }

    /// Where the scene of a cell stands, and whether it is folded.
    fn of(&self, cell: &Cell) -> (usize, bool) {
        let baked = cell.mode.source.is_baked();
        // Folded scenes come after those that are not.
        let found = self
            .scenes
            .iter()
            .rposition(|scene| scene.order == cell.order && (!scene.folded || baked));
        let place = found.unwrap_or_default();
        (place, self.scenes[place].folded)
    }
}

struct Bench<'a> {
    renderer: &'a Renderer,
    group: &'a Group,
    options: &'a Options,
    scenes: &'a Scenes,
    stages: &'a [Stage<'a>],
    canvas: &'a Canvas,
    cache: PipelineCache,
}

/// A cell that can be drawn, and its frames so far.
struct Running<'a> {
    cell: Cell,
    case: Case<'a>,
    /// Round by round; `None` once its time is up.
    samples: Vec<Option<Sample>>,
    seconds: f64,
    hash: Option<String>,
    notes: Vec<String>,
}

impl<'a> Bench<'a> {
    fn rows(&self, progress: &dyn Fn(u64)) -> Result<Vec<BenchRow>, BenchError> {
        let (possible, impossible): (Vec<Cell>, Vec<Cell>) = with_bases(&self.group.cells)
            .into_iter()
            .partition(|cell| self.why_not(cell.mode).is_none());
        let mut running = self.prepare(&possible)?;
        self.rounds(&mut running, progress)?;
        let base_of = |cell: &Cell| {
            running.iter().find(|other| {
                other.cell.mode.name == cell.mode.base && other.cell.order == cell.order
            })
        };
        let rows = self.group.cells.iter().map(|cell| {
            let own = running.iter().find(|other| other.cell == *cell);
            let measured = own.map(|own| Measured {
                samples: &own.samples,
                base: base_of(cell).map_or(&own.samples, |base| &base.samples),
                made: own.case.made(),
                counts: own.case.expected(),
                hash: own.hash.clone(),
            });
            let mut notes = own.map_or(Vec::new(), |own| own.notes.clone());
            if impossible.contains(cell) {
                notes.extend(self.why_not(cell.mode));
            }
            row(
                self.group,
                cell,
                self.scenes.size,
                measured,
                notes,
                self.options.timing,
            )
        });
        Ok(rows.collect())
    }

    /// Why a mode cannot be drawn here.
    fn why_not(&self, mode: &Mode) -> Option<String> {
        let indirect = mode.call == Call::Indirect && !self.renderer.device().draws_indirect();
        indirect.then(|| "unsupported: multiDrawIndirect, drawIndirectFirstInstance".to_owned())
    }

    /// Makes all cases, draws each until it is warm, and holds its picture and its commands against what they must be.
    fn prepare(&self, cells: &[Cell]) -> Result<Vec<Running<'a>>, BenchError> {
        let mut references: Vec<(&str, bool, Picture)> = Vec::new();
        let mut running = Vec::new();
        for cell in cells {
            let (place, folded) = self.scenes.of(cell);
            let case = self.case(place, cell.mode)?;
            for _ in 0..self.options.warm_up {
                let counts = self.sample(&case)?.counts;
                check_counts(cell, &counts, &case.expected())?;
            }
            let mut one = Running {
                cell: *cell,
                case,
                samples: Vec::new(),
                seconds: 0.0,
                hash: None,
                notes: Vec::new(),
            };
            if folded {
                one.notes
                    .push(format!("capped at {}", self.scenes.distinct));
            }
            if self.group.scene != SceneKind::Null && self.options.timing == Timing::Submit {
                self.check_picture(&mut one, folded, &mut references)?;
            }
            running.push(one);
        }
        Ok(running)
    }

    fn case(&self, place: usize, mode: &'static Mode) -> Result<Case<'a>, gpu::Error> {
        let discard = self.group.scene == SceneKind::Null;
        Case::new(&self.stages[place], mode, discard, &self.cache)
    }

    /// Compares the picture with that of the mode that it must equal, which is drawn first where it was not yet.
    fn check_picture(
        &self,
        one: &mut Running<'a>,
        folded: bool,
        references: &mut Vec<(&'static str, bool, Picture)>,
    ) -> Result<(), BenchError> {
        let Some(of) = one.cell.mode.picture_of() else {
            return Ok(());
        };
        let known = |references: &[(&str, bool, Picture)]| {
            references
                .iter()
                .position(|(name, fold, _)| *name == of && *fold == folded)
        };
        if known(references).is_none() {
            let mode = Mode::of_name(of).map_err(BenchError::Mode)?;
            let (place, _) = self.scenes.of(&one.cell);
            let picture = self.canvas.picture(&self.case(place, mode)?)?;
            references.push((mode.name, folded, picture));
        }
        let picture = self.canvas.picture(&one.case)?;
        let reference = &references[known(references).unwrap_or_default()].2;
        let difference = picture.max_difference(reference);
        if !(difference <= MAX_DIFFERENCE) {
            return Err(BenchError::OtherPicture {
                cell: told(&one.cell),
                difference,
            });
        }
        let hash = picture.hash();
        if hash != reference.hash() {
            one.notes.push(format!("picture within {difference:.1e}"));
        }
        one.hash = Some(format!("{hash:016x}"));
        Ok(())
    }

    /// Draws the cells in turn, in each round in an order of its own.
    fn rounds(
        &self,
        running: &mut [Running<'a>],
        progress: &dyn Fn(u64),
    ) -> Result<(), BenchError> {
        let mut random = fastrand::Rng::with_seed(self.options.seed);
        let mut places: Vec<_> = (0..running.len()).collect();
        for _ in 0..self.options.rounds {
            random.shuffle(&mut places);
            for place in &places {
                let one = &mut running[*place];
                progress(1);
                if one.seconds > self.options.cell_seconds {
                    one.samples.push(None);
                    continue;
                }
                let before = Instant::now();
                let sample = self.sample(&one.case)?;
                one.seconds += before.elapsed().as_secs_f64();
                check_counts(&one.cell, &sample.counts, &one.case.expected())?;
                one.samples.push(Some(sample));
            }
        }
        Ok(())
    }

    fn sample(&self, case: &Case) -> Result<Sample, gpu::Error> {
        match self.options.timing {
            Timing::Submit => self.canvas.sample(case),
            Timing::RecordAndReset => self.recorded(case),
        }
    }

    /// Several command buffers, so that the clock's steps do not show.
    fn recorded(&self, case: &Case) -> Result<Sample, gpu::Error> {
        const SECONDS: f64 = 0.05;
        let (mut times, mut last) = (Vec::new(), None::<PassCounts>);
        let before = Instant::now();
        while last.is_none() || before.elapsed().as_secs_f64() < SECONDS {
            let (ns, counts) = self.canvas.record_and_reset(case)?;
            times.push(ns);
            last = Some(counts);
        }
        Ok(Sample {
            record_ns: times.iter().sum::<f64>() / times.len() as f64,
            submit_to_idle_ms: 0.0,
            gpu_ms: None,
            counts: last.unwrap_or_else(|| case.expected()),
        })
    }
}

/// The cells, and before them the bases that they lack.
fn with_bases(cells: &[Cell]) -> Vec<Cell> {
    let mut all: Vec<Cell> = Vec::new();
    for cell in cells {
        // The base's own base too: one that is there, each compared with its own.
        let base = Mode::of_name(cell.mode.base).map(|mode| Cell { mode, ..*cell });
        for wanted in base.into_iter().chain([*cell]) {
            if !all.contains(&wanted) {
                all.push(wanted);
            }
        }
    }
    all
}

fn check_counts(cell: &Cell, got: &PassCounts, want: &PassCounts) -> Result<(), BenchError> {
    if got == want {
        return Ok(());
    }
    Err(BenchError::OtherCommands {
        cell: told(cell),
        got: format!("{got:?}"),
        want: format!("{want:?}"),
    })
}

fn told(cell: &Cell) -> String {
    format!("{}, {}", cell.mode.name, cell.order.name())
}
