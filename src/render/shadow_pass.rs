//! How are the depth maps of lamps drawn? One pipeline, one set, a draw an object and map.

use std::sync::Arc;

use super::draw_list::Draw;
use super::geometry::{Attributes, Geometry};
use crate::gpu::{DepthArray, DepthPassInfo, DescriptorSet, Pipeline, Recorder};

/// The pass's label, in captures and reports.
pub const NAME: &str = "shadow";

/// The maps, and what is drawn to them.
pub struct ShadowPass {
    /// A layer for each map.
    pub depths: Arc<DepthArray>,
    /// The one set, without the maps themselves: nothing is drawn to and bound at once.
    pub set: Arc<DescriptorSet>,
    /// The one pipeline.
    pub pipeline: Arc<Pipeline>,
    /// Which attributes it reads.
    pub attributes: Attributes,
    /// For each layer its draws.
    pub draws: Vec<Vec<Draw>>,
}

impl ShadowPass {
    /// The same with one triangle alone.
    pub fn one_triangle(&self) -> Self {
        let mut draws = vec![Vec::new(); self.draws.len()];
        let triangle = self.draws.iter().flatten().find_map(Draw::one_triangle);
        if let Some(first) = draws.first_mut() {
            first.extend(triangle);
        }
        Self {
            depths: Arc::clone(&self.depths),
            set: Arc::clone(&self.set),
            pipeline: Arc::clone(&self.pipeline),
            attributes: self.attributes,
            draws,
        }
    }

    /// Records the pass, layer by layer.
    pub fn record<'a>(&'a self, recorder: &mut Recorder<'a>, geometry: &'a Geometry) {
        for (layer, draws) in (0..).zip(&self.draws) {
            let info = DepthPassInfo {
                name: NAME,
                target: &self.depths,
                layer,
            };
            recorder.depth_pass(&info, |pass| {
                pass.bind_pipeline(&self.pipeline);
                pass.bind_set(0, &self.set);
                pass.bind_geometry(&geometry.outlines(self.attributes), &geometry.indices);
                for draw in draws {
                    pass.draw(draw.indices.clone(), draw.vertex_offset, draw.instance);
                }
            });
        }
    }
}
