//! How is the picture drawn? One pipeline, one set, a draw an object.

use std::sync::Arc;

use super::draw_list::Draw;
use super::geometry::{Attributes, Geometry};
use super::targets::Targets;
use crate::gpu::{DepthArray, DescriptorSet, Pipeline, Recorder};

/// The pass's label, in captures and reports.
pub const NAME: &str = "shading";

/// Draws that follow each other with one pipeline. A build for the scene has one batch.
pub struct Batch {
    /// Their pipeline.
    pub pipeline: Arc<Pipeline>,
    /// Which attributes it reads.
    pub attributes: Attributes,
    /// Whether faces may be seen from behind.
    pub two_sided: bool,
    /// The draws.
    pub draws: Vec<Draw>,
}

impl Batch {
    /// The same with one triangle alone.
    pub fn one_triangle(&self) -> Self {
        Self {
            pipeline: Arc::clone(&self.pipeline),
            attributes: self.attributes,
            two_sided: self.two_sided,
            draws: self
                .draws
                .iter()
                .find_map(Draw::one_triangle)
                .into_iter()
                .collect(),
        }
    }
}

/// All that the pass needs.
pub struct Shading<'a> {
    /// Where it draws.
    pub targets: &'a Targets,
    /// What it draws.
    pub batches: &'a [Batch],
    /// The one set.
    pub set: &'a DescriptorSet,
    /// The geometry.
    pub geometry: &'a Geometry,
    /// The shadow maps that it reads.
    pub reads: Vec<&'a DepthArray>,
}

impl Shading<'_> {
    /// Records the pass: everything is bound once, and no state command stands between two draws of a batch.
    pub fn record<'r>(&'r self, recorder: &mut Recorder<'r>) {
        recorder.pass(&self.targets.pass(NAME, &self.reads), |pass| {
            let mut bound = None;
            for (number, batch) in self.batches.iter().enumerate() {
                pass.bind_pipeline(&batch.pipeline);
                if number == 0 {
                    pass.bind_set(0, self.set);
                }
                if bound.replace(batch.attributes) != Some(batch.attributes) {
                    let vertices = self.geometry.vertices(batch.attributes);
                    pass.bind_geometry(&vertices, &self.geometry.indices);
                }
                for draw in &batch.draws {
                    pass.set_cull(draw.faces.cull(batch.two_sided));
                    pass.draw(draw.indices.clone(), draw.vertex_offset, draw.instance);
                }
            }
        });
    }
}
