//! What does a mode make for a scene, and which commands does it record?

use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

use super::super::draw_list::Draw;
use super::canvas::{self, Drawing};
use super::mode::{Call, Change, Mode};
use super::own::Own;
use super::pipelines::ModePipelines;
use super::stage::Stage;
use crate::gpu::{
    DrawCommand, Error, IndirectDraws, Output, Pass, PassCounts, Pipeline, PipelineCache,
};

/// A mode, ready to draw a scene.
pub struct Case<'s> {
    mode: &'static Mode,
    stage: &'s Stage<'s>,
    equipment: Arc<Equipment>,
    /// For each draw, which of the things that differ between materials it needs.
    keys: Vec<u32>,
    indirect: Option<IndirectDraws>,
    runs: Vec<Run>,
    /// Device memory of the indirect draws, bytes.
    memory_bytes: u64,
}

/// What a mode needs for the materials of a scene, in whatever order its objects are drawn.
pub struct Equipment {
    pipelines: ModePipelines,
    own: Own,
    made: Made,
}

/// Draws that follow each other and share their triangles.
#[derive(Clone, PartialEq, Eq, Debug)]
struct Run {
    draw: Draw,
    instances: Range<u32>,
}

/// What making a case took.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Made {
    /// The calls that make its pipelines, ms. Some drivers compile at the first draw.
    pub calls_ms: f64,
    /// Its pipelines.
    pub pipelines: u64,
    /// Device memory of its own, bytes.
    pub memory_bytes: u64,
}

impl Equipment {
    /// Makes what the mode needs. Nothing of it is rasterised where `discard` is set.
    ///
    /// # Errors
    /// The device cannot, there is no memory, or the driver fails.
    pub fn new(
        stage: &Stage,
        mode: &Mode,
        discard: bool,
        cache: &PipelineCache,
    ) -> Result<Self, Error> {
        let device = &stage.renderer.device;
        let memory = device.memory_in_use();
        let own = Own::new(stage, mode)?;
        let output = if discard {
            Output::Discarded
        } else {
            mode.output
        };
        let before = Instant::now();
        let pipelines = ModePipelines::new(stage, mode, &own, output, cache)?;
        Ok(Self {
            made: Made {
                calls_ms: before.elapsed().as_secs_f64() * 1e3,
                pipelines: pipelines.pipelines.len() as u64,
                memory_bytes: device.memory_in_use().saturating_sub(memory),
            },
            pipelines,
            own,
        })
    }
}

impl<'s> Case<'s> {
    /// Makes what the mode needs, and draws the scene with it.
    ///
    /// # Errors
    /// As [`Equipment::new`].
    pub fn new(
        stage: &'s Stage<'s>,
        mode: &'static Mode,
        discard: bool,
        cache: &PipelineCache,
    ) -> Result<Self, Error> {
        let equipment = Equipment::new(stage, mode, discard, cache)?;
        Self::with(stage, mode, Arc::new(equipment))
    }

    /// Draws the scene with what was made for this mode and this scene's materials.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn with(
        stage: &'s Stage<'s>,
        mode: &'static Mode,
        equipment: Arc<Equipment>,
    ) -> Result<Self, Error> {
        let device = &stage.renderer.device;
        let memory = device.memory_in_use();
        let count = equipment.own.count().unwrap_or(u32::MAX);
        let keys = stage.draws.iter().map(|(_, material)| material % count);
        let indirect = (mode.call == Call::Indirect)
            .then(|| indirect(stage))
            .transpose()?;
        Ok(Self {
            mode,
            equipment,
            keys: keys.collect(),
            indirect,
            runs: match mode.call {
                Call::Instanced => runs(stage),
                _ => Vec::new(),
            },
            memory_bytes: device.memory_in_use().saturating_sub(memory),
            stage,
        })
    }

    fn draw_runs<'a>(&'a self, pass: &mut Pass<'_, 'a>) {
        for Run { draw, instances } in &self.runs {
            pass.draw_instances(draw.indices.clone(), draw.vertex_offset, instances.clone());
        }
    }

    fn draw_each<'a>(&'a self, pass: &mut Pass<'_, 'a>, mut last: u32) {
        for ((draw, _), key) in self.stage.draws.iter().zip(&self.keys) {
            if *key != last {
                self.change(pass, *key);
                last = *key;
            }
            pass.draw(draw.indices.clone(), draw.vertex_offset, draw.instance);
        }
    }

    fn change<'a>(&'a self, pass: &mut Pass<'_, 'a>, key: u32) {
        match self.mode.change {
            Change::Nothing => {}
            Change::Push | Change::Window | Change::Set => self.equipment.own.bind(pass, key),
            Change::Pipeline | Change::SamePipeline => pass.bind_pipeline(self.pipeline(key)),
            Change::PipelineAndSet => {
                pass.bind_pipeline(self.pipeline(key));
                self.equipment.own.bind(pass, key);
            }
            Change::SameSet => {
                let records = self.stage.records(self.mode.source.has_pictures());
                pass.bind_set(0, &records.set);
            }
        }
    }

    /// The pipeline of a key; there is one for all, or one for each.
    fn pipeline(&self, key: u32) -> &Pipeline {
        let pipelines = &self.equipment.pipelines.pipelines;
        &pipelines[(key as usize).min(pipelines.len() - 1)]
    }
}

impl Drawing for Case<'_> {
    fn made(&self) -> Made {
        let made = self.equipment.made;
        Made {
            memory_bytes: made.memory_bytes + self.memory_bytes,
            ..made
        }
    }

    fn expected(&self) -> PassCounts {
        let changes = self
            .keys
            .windows(2)
            .filter(|pair| pair[0] != pair[1])
            .count() as u64;
        let [pipelines, sets, pushes] = self.mode.change.binds().map(|binds| binds * changes);
        let draws = self.keys.len();
        let first = |there: bool| u64::from(there && draws > 0);
        let own = self
            .equipment
            .own
            .first_binds()
            .map(|binds| binds * first(true));
        let nothing = PassCounts {
            name: canvas::NAME.to_owned(),
            draws: 0,
            pipeline_binds: 0,
            descriptor_set_binds: 0,
            push_constants: 0,
            cull_changes: 0,
        };
        match self.mode.call {
            Call::Nothing => nothing,
            call => PassCounts {
                draws: match call {
                    Call::Each => draws as u64,
                    Call::Indirect => first(true),
                    Call::Instanced => self.runs.len() as u64,
                    Call::Nothing => 0,
                },
                pipeline_binds: first(true) + pipelines,
                descriptor_set_binds: first(true) + own[0] + sets,
                push_constants: own[1] + pushes,
                cull_changes: first(!self.equipment.pipelines.two_sided),
                ..nothing
            },
        }
    }

    fn commands<'a>(&'a self, pass: &mut Pass<'_, 'a>) {
        let (Some(key), Some((draw, _))) = (self.keys.first(), self.stage.draws.first()) else {
            return;
        };
        if self.mode.call == Call::Nothing {
            return;
        }
        let geometry = &self.stage.uploaded.geometry;
        let ModePipelines {
            attributes,
            two_sided,
            ..
        } = self.equipment.pipelines;
        pass.bind_pipeline(self.pipeline(*key));
        let records = self.stage.records(self.mode.source.has_pictures());
        pass.bind_set(0, &records.set);
        self.equipment.own.bind(pass, *key);
        pass.bind_geometry(&geometry.vertices(attributes), &geometry.indices);
        // One mesh, not mirrored and of materials with two sides: all draws agree.
        pass.set_cull(draw.faces.cull(two_sided));
        match (self.mode.call, &self.indirect) {
            (_, Some(draws)) => pass.draw_indirect(draws),
            (Call::Instanced, _) => self.draw_runs(pass),
            _ => self.draw_each(pass, *key),
        }
    }
}

fn indirect(stage: &Stage) -> Result<IndirectDraws, Error> {
    let command = |(draw, _): &(Draw, u32)| DrawCommand {
        indices: draw.indices.clone(),
        vertex_offset: draw.vertex_offset,
        instance: draw.instance,
    };
    let commands: Vec<_> = stage.draws.iter().map(command).collect();
    IndirectDraws::new(&stage.renderer.device, "draws", &commands)
}

fn runs(stage: &Stage) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for (draw, _) in &stage.draws {
        match runs.last_mut() {
            Some(run)
                if run.instances.end == draw.instance
                    && run.draw.indices == draw.indices
                    && run.draw.vertex_offset == draw.vertex_offset =>
            {
                run.instances.end += 1;
            }
            _ => runs.push(Run {
                draw: draw.clone(),
                instances: draw.instance..draw.instance + 1,
            }),
        }
    }
    runs
}
