//! What does a visit to a group of cells see, drawn in turn on one device, and do they all leave one picture?

use std::time::Instant;

use super::plan::{Cell, Group, SceneKind};
use super::stages::{MOST_PICTURES, PictureKey, Scenes, Stages};
use super::{BenchError, Options, Timing};
use crate::gpu::{self, PassCounts, PipelineCache};
use crate::render::state_changes::{Call, Canvas, Drawing, Made, Mode, Sample};
use crate::render::{Picture, Renderer};

/// More rounds narrow a visit's medians by less than what visits differ by.
const MOST_ROUNDS: u32 = 60;

/// What a picture may differ by where its code differs, as `Picture::max_difference` measures it: 1e-5 relative and
/// 1e-6 absolute.
const MAX_DIFFERENCE: f64 = 1e-5;

/// What a visit saw of a cell.
pub struct Frames {
    /// Which.
    pub cell: Cell,
    /// Round by round; `None` once its time is up.
    pub samples: Vec<Option<Sample>>,
    /// What making it took.
    pub made: Made,
    /// What a frame records.
    pub counts: PassCounts,
    /// Its picture's, in hexadecimal.
    pub hash: Option<String>,
    /// What is less than its row's numbers say.
    pub notes: Vec<String>,
}

/// Which visit of how many, and with what each scene is drawn.
pub struct Turn<'a> {
    /// From 0.
    pub number: u32,
    /// How many there are.
    pub visits: u32,
    /// Over all visits.
    pub options: &'a Options,
    /// The group's.
    pub scenes: &'a Scenes,
}

impl Turn<'_> {
    /// Rounds of this visit, at least.
    fn rounds(&self) -> u32 {
        let (rounds, visits) = (self.options.rounds, self.visits);
        rounds * (self.number + 1) / visits - rounds * self.number / visits
    }

    /// What is a visit's share of seconds for all of them.
    fn share(&self, seconds: f64) -> f64 {
        seconds / f64::from(self.visits)
    }
}

/// The frames of a group's cells, and of the bases that they lack. `progress` hears of each frame.
///
/// # Errors
/// The device cannot, a mode records other commands than it says or leaves another picture, or the driver fails.
pub fn visit(
    renderer: &Renderer,
    group: &Group,
    turn: &Turn,
    progress: &dyn Fn(u64),
) -> Result<Vec<Frames>, BenchError> {
    let bench = Bench {
        renderer,
        group,
        turn,
        stages: &Stages::new(renderer, group, turn.scenes)?,
        canvas: &Canvas::new(renderer.device(), turn.scenes.size())?,
        cache: PipelineCache::open(renderer.device(), None)?,
    };
    bench.frames(progress)
}

/// Why a mode cannot be drawn on a device.
pub fn why_not(mode: &Mode, device: &gpu::Device) -> Option<String> {
    let indirect = mode.call == Call::Indirect && !device.draws_indirect();
    indirect.then(|| "unsupported: multiDrawIndirect, drawIndirectFirstInstance".to_owned())
}

struct Bench<'a> {
    renderer: &'a Renderer,
    group: &'a Group,
    turn: &'a Turn<'a>,
    stages: &'a Stages<'a>,
    canvas: &'a Canvas,
    cache: PipelineCache,
}

/// A cell that can be drawn, and its frames so far.
struct Running<'a> {
    cell: Cell,
    case: Box<dyn Drawing + 'a>,
    samples: Vec<Option<Sample>>,
    seconds: f64,
    hash: Option<String>,
    notes: Vec<String>,
}

impl<'a> Bench<'a> {
    fn frames(&self, progress: &dyn Fn(u64)) -> Result<Vec<Frames>, BenchError> {
        let mut cells = with_bases(&self.group.cells);
        cells.retain(|cell| why_not(cell.mode, self.renderer.device()).is_none());
        let mut running = self.prepare(&cells)?;
        self.rounds(&mut running, progress)?;
        let frames = running.into_iter().map(|one| Frames {
            cell: one.cell,
            samples: one.samples,
            made: one.case.made(),
            counts: one.case.expected(),
            hash: one.hash,
            notes: one.notes,
        });
        Ok(frames.collect())
    }

    /// Makes all cases, draws each until it is warm, and holds its picture and its commands against what they must be.
    fn prepare(&self, cells: &[Cell]) -> Result<Vec<Running<'a>>, BenchError> {
        let mut references = Vec::new();
        let mut running = Vec::new();
        for cell in cells {
            let case = self.case(cell, cell.mode)?;
            for _ in 0..self.turn.options.warm_up {
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
            if self.group.scene != SceneKind::Null && self.turn.options.timing == Timing::Submit {
                self.check_picture(&mut one, &mut references)?;
            }
            running.push(one);
        }
        Ok(running)
    }

    fn case(&self, cell: &Cell, mode: &'static Mode) -> Result<Box<dyn Drawing + 'a>, gpu::Error> {
        self.stages.case(cell, mode, &self.cache)
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
        let Turn {
            number,
            visits,
            options,
            ..
        } = *self.turn;
        let mut random = fastrand::Rng::with_seed(options.seed.wrapping_add(number.into()));
        let mut places: Vec<_> = (0..running.len()).collect();
        let start = Instant::now();
        let seconds = self.turn.share(options.further_seconds) * running.len() as f64;
        let least = self.turn.rounds();
        for round in 0..(MOST_ROUNDS / visits).max(least) {
            let spent = start.elapsed().as_secs_f64();
            if round >= least && spent > seconds {
                break;
            }
            random.shuffle(&mut places);
            for place in &places {
                let one = &mut running[*place];
                progress(u64::from(round < least));
                if one.seconds > self.turn.share(options.cell_seconds) {
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
        match self.turn.options.timing {
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
