//! What does a pass bind and draw, and how many state commands does that take?
//!
//! A pass counts what it records, so that the claim of one pipeline and one set is a number and not
//! a promise.

use std::ops::Range;
use std::sync::Arc;

use ash::vk;

use super::bound::Bound;
use super::buffer::{Buffer, BufferUse};
use super::commands::Recorder;
use super::descriptors::DescriptorSet;
use super::device::Device;
use super::indirect::{self, IndirectDraws};
use super::pass_info::Rendering;
use super::pipeline::{Pipeline, Targets};

/// What one pass recorded.
#[derive(Clone, PartialEq, Eq, Debug, serde::Serialize)]
pub struct PassCounts {
    /// The pass's label.
    pub name: String,
    /// Draw commands.
    pub draws: u64,
    /// Pipeline binds.
    pub pipeline_binds: u64,
    /// Descriptor set binds.
    pub descriptor_set_binds: u64,
    /// Updates of push constants.
    pub push_constants: u64,
    /// Changes of the faces that are culled.
    pub cull_changes: u64,
}

/// Which faces the rasteriser drops.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Cull {
    /// None.
    None,
    /// Those whose corners run counter-clockwise, seen from the eye.
    Front,
    /// Those whose corners run clockwise.
    Back,
}

/// A pass in the making.
pub struct Pass<'r, 'a> {
    recorder: &'r mut Recorder<'a>,
    rendering: Rendering<'a>,
    counts: PassCounts,
    bound: Bound<'a>,
    cull: Cull,
}

impl<'r, 'a> Pass<'r, 'a> {
    /// Records one rendering instance.
    pub(super) fn record(
        recorder: &'r mut Recorder<'a>,
        rendering: Rendering<'a>,
        draw: impl FnOnce(&mut Self),
    ) -> PassCounts {
        begin_rendering(recorder, &rendering);
        let mut pass = Self {
            recorder,
            counts: PassCounts {
                name: rendering.name.to_owned(),
                draws: 0,
                pipeline_binds: 0,
                descriptor_set_binds: 0,
                push_constants: 0,
                cull_changes: 0,
            },
            bound: Bound::default(),
            cull: Cull::None,
            rendering,
        };
        draw(&mut pass);
        // SAFETY: rendering was begun above.
        unsafe { pass.device().raw.cmd_end_rendering(pass.recorder.commands) };
        pass.counts
    }

    fn device(&self) -> &Arc<Device> {
        &self.recorder.device
    }

    fn targets(&self) -> Targets {
        self.rendering.targets
    }

    /// Culls these faces from now on; a pass begins with none. Nothing is recorded where nothing changes.
    pub fn set_cull(&mut self, cull: Cull) {
        if self.cull == cull {
            return;
        }
        set_cull_mode(self.recorder, cull);
        self.cull = cull;
        self.counts.cull_changes += 1;
    }

    /// Binds the pipeline.
    ///
    /// # Panics
    /// It was made for other targets or another device.
    pub fn bind_pipeline(&mut self, pipeline: &'a Pipeline) {
        assert!(pipeline.is_of(self.device()), "a pipeline of this device");
        assert_eq!(
            pipeline.targets(),
            self.targets(),
            "a pipeline of these targets"
        );
        // SAFETY: the pipeline is this device's and fits the targets; the recorder borrows it.
        unsafe {
            self.device().raw.cmd_bind_pipeline(
                self.recorder.commands,
                vk::PipelineBindPoint::GRAPHICS,
                pipeline.raw,
            );
        }
        self.counts.pipeline_binds += 1;
        self.bound.pipeline(pipeline);
    }

    /// Binds a set at its place in the layout of the pipeline that is bound. It stays bound for every pipeline of
    /// that layout.
    ///
    /// # Panics
    /// No pipeline is bound, its layout has another set there, or the set has a window.
    pub fn bind_set(&mut self, place: u32, set: &'a DescriptorSet) {
        assert!(set.window().is_none(), "a set without a window");
        self.record_set(place, set, &[]);
    }

    /// Binds a set with its window at `offset`, bytes.
    ///
    /// # Panics
    /// As `bind_set`, but the set must have a window; or it cannot stand there.
    pub fn bind_set_at(&mut self, place: u32, set: &'a DescriptorSet, offset: u32) {
        let fits = set
            .window()
            .is_some_and(|(buffer, bytes)| buffer.fits_window(offset, bytes));
        assert!(fits, "a set whose window can stand at {offset}");
        self.record_set(place, set, &[offset]);
    }

    fn record_set(&mut self, place: u32, set: &'a DescriptorSet, offsets: &[u32]) {
        self.bound.set(place as usize, set, self.rendering.reads);
        // SAFETY: the set is of the layout's own set layout, which `bound` checked, and so of this device, and its
        // window fits; the recorder borrows it.
        unsafe {
            self.device().raw.cmd_bind_descriptor_sets(
                self.recorder.commands,
                vk::PipelineBindPoint::GRAPHICS,
                self.bound.layout().raw,
                place,
                &[set.raw],
                offsets,
            );
        }
        self.counts.descriptor_set_binds += 1;
    }

    /// Sets all push constants, for every pipeline of the bound one's layout.
    ///
    /// # Panics
    /// No pipeline is bound, or its layout has another number of them.
    pub fn push_constants(&mut self, bytes: &[u8]) {
        let layout = self.bound.layout();
        assert!(
            bytes.len() == layout.push_bytes as usize && !bytes.is_empty(),
            "the push constants of the pipeline's layout"
        );
        // SAFETY: the layout has one range, of these stages and this many bytes.
        unsafe {
            self.device().raw.cmd_push_constants(
                self.recorder.commands,
                layout.raw,
                layout.push_stages,
                0,
                bytes,
            );
        }
        self.counts.push_constants += 1;
        self.bound.pushed();
    }

    /// Binds one buffer an attribute, and the indices.
    ///
    /// # Panics
    /// A buffer is of another use or device.
    pub fn bind_geometry(&mut self, vertices: &[&'a Buffer], indices: &'a Buffer) {
        for buffer in vertices {
            assert!(buffer.is_of(self.device()) && buffer.usage() == BufferUse::Vertices);
        }
        assert!(indices.is_of(self.device()) && indices.usage() == BufferUse::Indices);
        let raw: Vec<_> = vertices.iter().map(|buffer| buffer.raw).collect();
        let offsets = vec![0; raw.len()];
        // SAFETY: buffers of the right use, from their start; the recorder borrows them.
        unsafe {
            let device = &self.recorder.device.raw;
            let commands = self.recorder.commands;
            device.cmd_bind_vertex_buffers(commands, 0, &raw, &offsets);
            device.cmd_bind_index_buffer(commands, indices.raw, 0, vk::IndexType::UINT32);
        }
        self.bound.geometry(vertices.len(), indices.bytes());
    }

    /// Draws a range of the indices, each plus `vertex_offset`, as instance `instance`.
    /// Vertices and records beyond their buffers read as the device's robust access defines.
    ///
    /// # Panics
    /// Something is not bound, the range leaves the index buffer, or a fragment shader would see
    /// depth that is not among the pass's `reads`.
    pub fn draw(&mut self, indices: Range<u32>, vertex_offset: i32, instance: u32) {
        assert!(instance < u32::MAX, "the instance after it can be counted");
        self.draw_instances(indices, vertex_offset, instance..instance + 1);
    }

    /// The same as each of several instances, by one command.
    ///
    /// # Panics
    /// As `draw`.
    pub fn draw_instances(
        &mut self,
        indices: Range<u32>,
        vertex_offset: i32,
        instances: Range<u32>,
    ) {
        self.bound.check(indices.end);
        // SAFETY: all is bound and the index range was checked; vertex and instance fetches are robust (`Device`
        // turns robustBufferAccess on).
        unsafe {
            self.recorder.device.raw.cmd_draw_indexed(
                self.recorder.commands,
                indices.end.saturating_sub(indices.start),
                instances.end.saturating_sub(instances.start),
                indices.start,
                vertex_offset,
                instances.start,
            );
        }
        self.counts.draws += 1;
    }

    /// Draws objects whose commands lie on the device, by one command.
    ///
    /// # Panics
    /// As `draw`, or they are another device's.
    pub fn draw_indirect(&mut self, draws: &'a IndirectDraws) {
        self.bound.check(draws.indices_end);
        assert!(draws.buffer.is_of(self.device()), "draws of this device");
        // SAFETY: as above; `IndirectDraws` checked the commands, that the device can, and its limit.
        unsafe {
            self.recorder.device.raw.cmd_draw_indexed_indirect(
                self.recorder.commands,
                draws.buffer.raw,
                0,
                draws.count,
                indirect::STRIDE,
            );
        }
        self.counts.draws += 1;
    }
}

fn begin_rendering(recorder: &Recorder, rendering: &Rendering) {
    let area = vk::Rect2D {
        offset: vk::Offset2D::default(),
        extent: rendering.extent,
    };
    let info = vk::RenderingInfo::default()
        .render_area(area)
        .layer_count(1)
        .color_attachments(rendering.color.as_slice())
        .depth_attachment(&rendering.depth);
    // SAFETY: the targets are in the layouts named, and the pass's `check` found that they fit.
    unsafe {
        let raw = &recorder.device.raw;
        let commands = recorder.commands;
        raw.cmd_begin_rendering(commands, &info);
        raw.cmd_set_viewport(commands, 0, &[flipped_viewport(area.extent)]);
        raw.cmd_set_scissor(commands, 0, &[area]);
    }
    set_cull_mode(recorder, Cull::None);
}

fn set_cull_mode(recorder: &Recorder, cull: Cull) {
    let mode = match cull {
        Cull::None => vk::CullModeFlags::NONE,
        Cull::Front => vk::CullModeFlags::FRONT,
        Cull::Back => vk::CullModeFlags::BACK,
    };
    // SAFETY: recording is under way; every pipeline leaves this state to the pass.
    unsafe {
        recorder
            .device
            .raw
            .cmd_set_cull_mode(recorder.commands, mode)
    };
}

/// A viewport of negative height: clip space has y up, as the world does, and counter-clockwise
/// faces stay counter-clockwise.
fn flipped_viewport(extent: vk::Extent2D) -> vk::Viewport {
    vk::Viewport {
        x: 0.0,
        y: extent.height as f32,
        width: extent.width as f32,
        height: -(extent.height as f32),
        min_depth: 0.0,
        max_depth: 1.0,
    }
}
