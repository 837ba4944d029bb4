//! How long until a mode's pipelines draw?
//!
//! A driver may compile when a pipeline is made or when it first draws, so both count: the calls, and the first frame
//! beyond the median one.

use std::path::{Path, PathBuf};

use super::plan::{Cell, Group, SceneKind, most_pipelines};
use super::stages::{Scenes, Stages};
use super::{BenchError, Options};
use crate::gpu::{DeviceKind, PipelineCache};
use crate::math::statistics::median;
use crate::render::Renderer;
use crate::render::state_changes::{Call, Canvas, Mode};
use crate::report::BenchRow;
use crate::scene::Order;
use crate::studies::own_process::{ColdAndWarm, OwnProcess, OwnProcessError};

/// Frames after the first, whose median is taken off it.
const FRAMES: usize = 5;

/// The side of the squares whose pipelines stand for those of any side.
const SIDE: u32 = 8;

/// The scene kinds by name, for the process that is asked for one of them.
pub const SCENES: [SceneKind; 6] = [
    SceneKind::Tiny,
    SceneKind::Zoo,
    SceneKind::Patches(SIDE),
    SceneKind::Null,
    SceneKind::Bare { storage: false },
    SceneKind::Bare { storage: true },
];

/// What a process of its own measures: a mode's pipelines for so many materials, each drawn once. Milliseconds.
///
/// # Errors
/// The device cannot, or the driver fails.
pub fn here(
    renderer: &Renderer,
    cache_folder: Option<&Path>,
    (scene, materials, mode): (SceneKind, u32, &'static Mode),
    options: &Options,
) -> Result<f64, BenchError> {
    let group = Group::of_all(scene, materials, materials, &[mode]);
    let cell = Cell {
        mode,
        order: Order::Shuffled,
    };
    let scenes = Scenes::new(renderer.device().info().kind, &group, options)?;
    let stages = Stages::new(renderer, &group, &scenes)?;
    let canvas = Canvas::new(renderer.device(), scenes.size())?;
    let cache = PipelineCache::open(renderer.device(), cache_folder)?;
    let case = stages.case(&cell, mode, &cache)?;
    let first = canvas.sample(&*case)?.submit_to_idle_ms;
    cache.save();
    let later = (0..FRAMES).map(|_| Ok(canvas.sample(&*case)?.submit_to_idle_ms));
    let later: Vec<_> = later.collect::<Result<_, BenchError>>()?;
    let usual = median(&later).unwrap_or(first);
    Ok(case.made().calls_ms + (first - usual).max(0.0))
}

/// Processes of their own, and what they said so far.
pub struct Creation {
    program: PathBuf,
    arguments: Vec<String>,
    runs: usize,
    known: Vec<((&'static str, u32, &'static str), ColdAndWarm)>,
}

impl Creation {
    /// `program` is `umber` itself, `arguments` what `umber bench` is told of the device; the median of `runs` counts.
    pub fn new(program: PathBuf, arguments: Vec<String>, runs: usize) -> Self {
        Self {
            program,
            arguments,
            runs,
            known: Vec::new(),
        }
    }

    /// Adds the creation times to rows of a group that were measured.
    ///
    /// # Errors
    /// A process does not start, or fails.
    pub fn add(
        &mut self,
        kind: DeviceKind,
        group: &Group,
        rows: &mut [BenchRow],
    ) -> Result<(), OwnProcessError> {
        let most = most_pipelines(kind);
        for row in rows {
            let Some(cell) = group.cells.iter().find(|cell| group.has(cell, row)) else {
                continue;
            };
            if row.samples == 0 || cell.mode.call == Call::Nothing {
                continue;
            }
            // One pipeline is the same whatever the number of materials.
            let materials = match cell.mode.source.is_baked() {
                true => group.materials.min(most),
                false => 1,
            };
            let times = self.of(group.scene, materials, cell.mode)?;
            row.creation_cold_ms = Some(times.cold);
            row.creation_warm_ms = Some(times.warm);
        }
        Ok(())
    }

    fn of(
        &mut self,
        scene: SceneKind,
        materials: u32,
        mode: &'static Mode,
    ) -> Result<ColdAndWarm, OwnProcessError> {
        let key = (scene.name(), materials, mode.name);
        if let Some((_, known)) = self.known.iter().find(|(known, _)| *known == key) {
            return Ok(*known);
        }
        let own = ["bench", "--creation-of", mode.name, "--scene", scene.name()];
        let mut arguments: Vec<_> = own.map(str::to_owned).to_vec();
        arguments.extend(["--materials".to_owned(), materials.to_string()]);
        arguments.extend(self.arguments.iter().cloned());
        let process = OwnProcess {
            program: self.program.clone(),
            arguments,
        };
        let times = process.cold_and_warm("/creation_ms", self.runs, &|_| Vec::new())?;
        self.known.push((key, times));
        Ok(times)
    }
}
