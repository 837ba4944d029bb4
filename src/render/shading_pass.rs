//! How is the picture drawn? One pipeline, one set, a draw an object.

use super::draw_list::Draw;
use super::scene_buffers::SceneBuffers;
use super::targets::Targets;
use crate::gpu::{DescriptorSet, Pipeline, Recorder};

/// The pass's label, in captures and reports.
pub const NAME: &str = "shading";

/// Records the pass: everything is bound once, and no state command stands between two draws.
pub fn record<'a>(
    recorder: &mut Recorder<'a>,
    targets: &'a Targets,
    pipeline: &'a Pipeline,
    set: &'a DescriptorSet,
    scene: &'a SceneBuffers,
    draws: &[Draw],
) {
    recorder.pass(&targets.pass(NAME), |pass| {
        pass.bind_pipeline(pipeline);
        pass.bind_set(set);
        pass.bind_geometry(&[&scene.positions, &scene.normals], &scene.indices);
        for draw in draws {
            pass.draw(draw.indices.clone(), draw.vertex_offset, draw.instance);
        }
    });
}
