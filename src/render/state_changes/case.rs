//! What does a mode make for a scene, and which commands does it record?

use std::ops::Range;
use std::time::Instant;

use super::super::draw_list::Draw;
use super::super::geometry::Attributes;
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
    attributes: Attributes,
    /// Whether faces may be seen from behind.
    two_sided: bool,
    /// One, or one for each material.
    pipelines: Vec<Pipeline>,
    own: Own,
    /// For each draw, which of the things that differ between materials it needs.
    keys: Vec<u32>,
    indirect: Option<IndirectDraws>,
    runs: Vec<Run>,
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

impl<'s> Case<'s> {
    /// Makes what the mode needs. Nothing of it is rasterised where `discard` is set.
    ///
    /// # Errors
    /// The device cannot, there is no memory, or the driver fails.
    pub fn new(
        stage: &'s Stage<'s>,
        mode: &'static Mode,
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
        let ModePipelines {
            pipelines,
            attributes,
            two_sided,
        } = ModePipelines::new(stage, mode, &own, output, cache)?;
        let calls_ms = before.elapsed().as_secs_f64() * 1e3;
        let count = own.count().unwrap_or(u32::MAX);
        let keys = stage.draws.iter().map(|(_, material)| material % count);
        let indirect = (mode.call == Call::Indirect)
            .then(|| indirect(stage))
            .transpose()?;
        Ok(Self {
            mode,
            attributes,
            two_sided,
            made: Made {
                calls_ms,
                pipelines: pipelines.len() as u64,
                memory_bytes: device.memory_in_use().saturating_sub(memory),
            },
            pipelines,
            own,
            keys: keys.collect(),
            indirect,
            runs: match mode.call {
                Call::Instanced => runs(stage),
                _ => Vec::new(),
            },
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
            Change::Push | Change::Window | Change::Set => self.own.bind(pass, key),
            Change::Pipeline | Change::SamePipeline => pass.bind_pipeline(self.pipeline(key)),
            Change::PipelineAndSet => {
                pass.bind_pipeline(self.pipeline(key));
                self.own.bind(pass, key);
            }
            Change::SameSet => {
                let records = self.stage.records(self.mode.source.has_pictures());
                pass.bind_set(0, &records.set);
            }
        }
    }

    /// The pipeline of a key; there is one for all, or one for each.
    fn pipeline(&self, key: u32) -> &Pipeline {
        let place = (key as usize).min(self.pipelines.len() - 1);
        &self.pipelines[place]
    }
}

impl Drawing for Case<'_> {
    fn made(&self) -> Made {
        self.made
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
        let own = self.own.first_binds().map(|binds| binds * first(true));
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
                cull_changes: first(!self.two_sided),
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
        pass.bind_pipeline(self.pipeline(*key));
        let records = self.stage.records(self.mode.source.has_pictures());
        pass.bind_set(0, &records.set);
        self.own.bind(pass, *key);
        pass.bind_geometry(&geometry.vertices(self.attributes), &geometry.indices);
        // One mesh, not mirrored and of materials with two sides: all draws agree.
        pass.set_cull(draw.faces.cull(self.two_sided));
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
