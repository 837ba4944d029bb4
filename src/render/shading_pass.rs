//! How is the picture drawn? One pipeline, one set, a draw an object.

use super::draw_list::Draw;
use super::scene_buffers::SceneBuffers;
use super::targets::Targets;
use crate::gpu::{DescriptorSet, Pipeline, Recorder};

/// The pass's label, in captures and reports.
pub const NAME: &str = "shading";

/// All that the pass needs.
#[derive(Clone, Copy)]
pub struct Shading<'a> {
    /// Where it draws.
    pub targets: &'a Targets,
    /// The one pipeline.
    pub pipeline: &'a Pipeline,
    /// The one set.
    pub set: &'a DescriptorSet,
    /// The geometry.
    pub scene: &'a SceneBuffers,
}

impl<'a> Shading<'a> {
    /// Records the pass: everything is bound once, and no state command stands between two draws.
    pub fn record(&self, recorder: &mut Recorder<'a>, draws: &[Draw]) {
        let scene = self.scene;
        recorder.pass(&self.targets.pass(NAME), |pass| {
            pass.bind_pipeline(self.pipeline);
            pass.bind_set(self.set);
            pass.bind_geometry(&[&scene.positions, &scene.normals], &scene.indices);
            for draw in draws {
                pass.draw(draw.indices.clone(), draw.vertex_offset, draw.instance);
            }
        });
    }
}
