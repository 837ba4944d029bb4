//! What has a pass bound, and is that all that a draw needs?

use std::sync::Arc;

use ash::vk;

use super::depth_array::DepthArray;
use super::descriptors::DescriptorSet;
use super::pipeline::Pipeline;
use super::pipeline_layout::{MOST_SETS, PipelineLayout};

/// What a pass has bound; a draw without all of it would be undefined.
#[derive(Default)]
pub(super) struct Bound<'a> {
    pipeline: Option<&'a Pipeline>,
    sets: [Option<BoundSet>; MOST_SETS],
    /// The layout that the push constants were pushed for.
    pushed: Option<vk::PipelineLayout>,
    vertex_buffers: usize,
    indices: u64,
    /// Whether `check` passed since the last change.
    checked: bool,
}

#[derive(Clone, Copy)]
struct BoundSet {
    /// The layout that it was bound for.
    layout: vk::PipelineLayout,
    /// Whether it holds depth that the pass does not read.
    unread: bool,
}

impl<'a> Bound<'a> {
    pub(super) fn pipeline(&mut self, pipeline: &'a Pipeline) {
        self.pipeline = Some(pipeline);
        self.checked = false;
    }

    /// The layout of the pipeline; sets and push constants are bound for it.
    pub(super) fn layout(&self) -> &'a PipelineLayout {
        let Some(pipeline) = self.pipeline else {
            panic!("a pipeline is bound before its sets");
        };
        &pipeline.layout
    }

    /// The set's place and layout are checked here, whether the pass reads its depth where it is drawn with.
    pub(super) fn set(&mut self, place: usize, set: &DescriptorSet, reads: &[&DepthArray]) {
        let layout = self.layout();
        let fits = layout
            .sets
            .get(place)
            .is_some_and(|own| Arc::ptr_eq(own, &set.layout));
        assert!(fits, "set {place} of the pipeline's layout");
        let is_read =
            |array: &Arc<DepthArray>| reads.iter().any(|read| std::ptr::eq(&**array, *read));
        self.sets[place] = Some(BoundSet {
            layout: layout.raw,
            unread: !set.depth_arrays().all(is_read),
        });
        self.checked = false;
    }

    pub(super) fn pushed(&mut self) {
        self.pushed = Some(self.layout().raw);
        self.checked = false;
    }

    pub(super) fn geometry(&mut self, vertex_buffers: usize, index_bytes: u64) {
        self.vertex_buffers = vertex_buffers;
        self.indices = index_bytes / 4;
        self.checked = false;
    }

    /// Asserts that a draw which reads indices up to `indices_end` finds all that it needs.
    pub(super) fn check(&mut self, indices_end: u32) {
        assert!(
            u64::from(indices_end) <= self.indices,
            "the index range is in the index buffer"
        );
        if !self.checked {
            self.check_binds();
            self.checked = true;
        }
    }

    fn check_binds(&self) {
        let layout = self.layout();
        let fragments = self.pipeline.is_some_and(Pipeline::has_fragments);
        for (place, set) in self.sets[..layout.sets.len()].iter().enumerate() {
            let set = set.filter(|set| set.layout == layout.raw);
            let Some(set) = set else {
                panic!("set {place} of the pipeline's layout is bound");
            };
            // Only fragments see textures.
            assert!(
                !(fragments && set.unread),
                "the pass reads the depth that set {place} holds"
            );
        }
        assert!(
            layout.push_bytes == 0 || self.pushed == Some(layout.raw),
            "constants are pushed"
        );
        assert_eq!(
            self.pipeline.map(Pipeline::vertex_buffers),
            Some(self.vertex_buffers),
            "the pipeline's vertex buffers are bound"
        );
    }
}
