//! What does a group of cells take, drawn in turn, and do they all leave one picture?

use std::time::Instant;

use super::plan::{Cell, Group, SceneKind};
use super::rows::{Measured, row};
use super::stages::{MOST_PICTURES, PictureKey, Scenes, Stages};
use super::{BenchError, Options, Timing};
use crate::gpu::{self, PassCounts, PipelineCache};
use crate::render::state_changes::{Call, Canvas, Drawing, Mode, Sample};
use crate::render::{Picture, Renderer};
use crate::report::BenchRow;

/// More rounds narrow an interval by less than the noise of a second run.
const MOST_ROUNDS: u32 = 60;

/// What a picture may differ by where its code differs, as `Picture::max_difference` measures it: 1e-5 relative and
/// 1e-6 absolute.
const MAX_DIFFERENCE: f64 = 1e-5;

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
    let canvas = Canvas::new(renderer.device(), scenes.size())?;
    let stages = Stages::new(renderer, group, &scenes)?;
    let bench = Bench {
        renderer,
        group,
        options,
        size: scenes.size(),
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
    let (width, height) = group.wall(group.materials, 0).size();
    let draws = group.draws;
    let size = renderer.device().check_target_size(width, height);
    size.map_err(|error| BenchError::TooLarge { draws, error })
}

struct Bench<'a> {
    renderer: &'a Renderer,
    group: &'a Group,
    options: &'a Options,
    size: (u32, u32),
    stages: &'a Stages<'a>,
    canvas: &'a Canvas,
    cache: PipelineCache,
}

/// A cell that can be drawn, and its frames so far.
struct Running<'a> {
    cell: Cell,
    case: Box<dyn Drawing + 'a>,
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
                self.size,
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
        let mut references = Vec::new();
        let mut running = Vec::new();
        for cell in cells {
            let case = self.case(cell, cell.mode)?;
            for _ in 0..self.options.warm_up {
                let counts = self.sample(&*case)?.counts;
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
            one.notes.extend(self.notes(cell));
            if self.group.scene != SceneKind::Null && self.options.timing == Timing::Submit {
                self.check_picture(&mut one, &mut references)?;
            }
            running.push(one);
        }
        Ok(running)
    }

    fn case(&self, cell: &Cell, mode: &'static Mode) -> Result<Box<dyn Drawing + 'a>, gpu::Error> {
        let discard = self.group.scene == SceneKind::Null;
        self.stages.case(cell, mode, discard, &self.cache)
    }

    /// What of a cell is less than its row's numbers say.
    fn notes(&self, cell: &Cell) -> Vec<String> {
        let capped = self.stages.cap(cell);
        let shared = cell.mode.source.has_pictures() && self.group.materials > MOST_PICTURES;
        let capped = capped.map(|most| format!("capped at {most}"));
        let shared = shared.then(|| format!("{MOST_PICTURES} pictures"));
        capped.into_iter().chain(shared).collect()
    }

    /// Compares the picture with that of the mode that it must equal, which is drawn first where it was not yet.
    fn check_picture(
        &self,
        one: &mut Running<'a>,
        references: &mut Vec<(PictureKey, Picture)>,
    ) -> Result<(), BenchError> {
        let key = self.stages.picture(&one.cell);
        let Some(of) = key.of else {
            return Ok(());
        };
        let known = |references: &[(PictureKey, Picture)]| {
            references.iter().position(|(known, _)| *known == key)
        };
        if known(references).is_none() {
            let mode = Mode::of_name(of).map_err(BenchError::Mode)?;
            let picture = self.canvas.picture(&*self.case(&one.cell, mode)?)?;
            references.push((key, picture));
        }
        let picture = self.canvas.picture(&*one.case)?;
        let reference = &references[known(references).unwrap_or_default()].1;
        let difference = picture.max_difference(reference);
        if difference > MAX_DIFFERENCE {
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
        let start = Instant::now();
        let seconds = self.options.further_seconds * running.len() as f64;
        for round in 0..MOST_ROUNDS.max(self.options.rounds) {
            let spent = start.elapsed().as_secs_f64();
            if round >= self.options.rounds && spent > seconds {
                break;
            }
            random.shuffle(&mut places);
            for place in &places {
                let one = &mut running[*place];
                progress(u64::from(round < self.options.rounds));
                if one.seconds > self.options.cell_seconds {
                    one.samples.push(None);
                    continue;
                }
                let before = Instant::now();
                let sample = self.sample(&*one.case)?;
                one.seconds += before.elapsed().as_secs_f64();
                check_counts(&one.cell, &sample.counts, &one.case.expected())?;
                one.samples.push(Some(sample));
            }
        }
        Ok(())
    }

    fn sample(&self, case: &dyn Drawing) -> Result<Sample, gpu::Error> {
        match self.options.timing {
            Timing::Submit => self.canvas.sample(case),
            Timing::RecordAndReset => self.recorded(case),
        }
    }

    /// Several command buffers, so that the clock's steps do not show.
    fn recorded(&self, case: &dyn Drawing) -> Result<Sample, gpu::Error> {
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
