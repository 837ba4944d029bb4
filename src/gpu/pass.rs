//! What does a pass draw to, what does it bind, and how many state commands does it take?
//!
//! A pass counts what it records, so that the claim of one pipeline and one set is a number and not
//! a promise.

use std::ops::Range;
use std::sync::Arc;

use ash::vk;

use super::buffer::{Buffer, BufferUse};
use super::commands::Recorder;
use super::descriptors::DescriptorSet;
use super::device::Device;
use super::format::{Samples, TargetFormat};
use super::image::Image;
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
}

/// Where a pass draws. The colour target is cleared to transparent black, depth to 0 (far).
#[derive(Clone, Copy)]
pub struct PassInfo<'a> {
    /// The pass's label.
    pub name: &'a str,
    /// Colour target.
    pub color: &'a Image,
    /// Where the colour target's samples are averaged to, if it has several.
    pub resolve: Option<&'a Image>,
    /// Depth target.
    pub depth: &'a Image,
}

impl PassInfo<'_> {
    /// Asserts that the targets fit each other.
    pub(super) fn check(&self, device: &Arc<Device>) {
        let Self {
            name,
            color,
            resolve,
            depth,
        } = self;
        for image in [*color, *depth].into_iter().chain(*resolve) {
            assert!(image.is_of(device), "{name}: targets of this device");
            assert_eq!(image.size(), color.size(), "{name}: targets of one size");
        }
        assert_eq!(color.samples(), depth.samples(), "{name}: samples");
        assert_eq!(depth.format(), TargetFormat::Depth32Float, "{name}: depth");
        let several = color.samples() != Samples::One;
        assert_eq!(several, resolve.is_some(), "{name}: a resolve target");
        if let Some(resolve) = resolve {
            assert_eq!(resolve.samples(), Samples::One, "{name}: resolve");
            assert_eq!(resolve.format(), color.format(), "{name}: resolve");
        }
    }

    fn targets(&self) -> Targets {
        Targets {
            color: self.color.format(),
            depth: self.depth.format(),
            samples: self.color.samples(),
        }
    }
}

/// What a pass has bound; a draw without all of it would be undefined.
#[derive(Default)]
struct Bound {
    pipeline: Option<(usize, vk::PipelineLayout)>,
    vertex_buffers: usize,
    set: Option<vk::PipelineLayout>,
    indices: Option<u64>,
}

/// A pass in the making.
pub struct Pass<'r, 'a> {
    recorder: &'r mut Recorder<'a>,
    targets: Targets,
    counts: PassCounts,
    bound: Bound,
}

impl<'r, 'a> Pass<'r, 'a> {
    /// Records one rendering instance.
    pub(super) fn record(
        recorder: &'r mut Recorder<'a>,
        info: &PassInfo<'a>,
        draw: impl FnOnce(&mut Self),
    ) -> PassCounts {
        begin_rendering(recorder, info);
        let mut pass = Self {
            recorder,
            targets: info.targets(),
            counts: PassCounts {
                name: info.name.to_owned(),
                draws: 0,
                pipeline_binds: 0,
                descriptor_set_binds: 0,
            },
            bound: Bound::default(),
        };
        draw(&mut pass);
        // SAFETY: rendering was begun above.
        unsafe { pass.device().raw.cmd_end_rendering(pass.recorder.commands) };
        pass.counts
    }

    fn device(&self) -> &Arc<Device> {
        &self.recorder.device
    }

    /// Binds the pipeline.
    ///
    /// # Panics
    /// It was made for other targets or another device.
    pub fn bind_pipeline(&mut self, pipeline: &'a Pipeline) {
        assert!(pipeline.is_of(self.device()), "a pipeline of this device");
        assert_eq!(
            pipeline.targets(),
            self.targets,
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
        let layout = pipeline.layout.pipeline_layout;
        self.bound.pipeline = Some((pipeline.vertex_buffers(), layout));
    }

    /// Binds the set.
    ///
    /// # Panics
    /// It is another device's.
    pub fn bind_set(&mut self, set: &'a DescriptorSet) {
        assert!(set.layout.is_of(self.device()), "a set of this device");
        // SAFETY: the set was made for this layout; the recorder borrows it.
        unsafe {
            self.device().raw.cmd_bind_descriptor_sets(
                self.recorder.commands,
                vk::PipelineBindPoint::GRAPHICS,
                set.layout.pipeline_layout,
                0,
                &[set.raw],
                &[],
            );
        }
        self.counts.descriptor_set_binds += 1;
        self.bound.set = Some(set.layout.pipeline_layout);
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
        self.bound.vertex_buffers = vertices.len();
        self.bound.indices = Some(indices.bytes() / 4);
    }

    /// Draws a range of the indices, each plus `vertex_offset`, as instance `instance`.
    /// Vertices and records beyond their buffers read as the device's robust access defines.
    ///
    /// # Panics
    /// Something is not bound, or the range leaves the index buffer.
    pub fn draw(&mut self, indices: Range<u32>, vertex_offset: i32, instance: u32) {
        let bound = &self.bound;
        let wanted = bound.set.map(|layout| (bound.vertex_buffers, layout));
        assert!(
            wanted.is_some() && bound.pipeline == wanted,
            "a pipeline, a set of its layout and its vertex buffers are bound"
        );
        let fits = bound
            .indices
            .is_some_and(|count| u64::from(indices.end) <= count);
        assert!(fits, "the index range is in the index buffer");
        assert!(instance < u32::MAX, "the instance after it can be counted");
        // SAFETY: pipeline, set and buffers are bound; the index range was checked; vertex and
        // instance fetches are robust (`Device` turns robustBufferAccess on).
        unsafe {
            self.recorder.device.raw.cmd_draw_indexed(
                self.recorder.commands,
                indices.end.saturating_sub(indices.start),
                1,
                indices.start,
                vertex_offset,
                instance,
            );
        }
        self.counts.draws += 1;
    }
}

fn begin_rendering(recorder: &Recorder, info: &PassInfo) {
    let mut color = vk::RenderingAttachmentInfo::default()
        .image_view(info.color.view)
        .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(vk::AttachmentStoreOp::STORE);
    if let Some(resolve) = info.resolve {
        color = color
            .resolve_mode(vk::ResolveModeFlags::AVERAGE)
            .resolve_image_view(resolve.view)
            .resolve_image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
            .store_op(vk::AttachmentStoreOp::DONT_CARE);
    }
    // Both clear values are all zero bits: transparent black, and far in reversed depth.
    let depth = vk::RenderingAttachmentInfo::default()
        .image_view(info.depth.view)
        .image_layout(vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL)
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(vk::AttachmentStoreOp::DONT_CARE);
    let area = vk::Rect2D {
        offset: vk::Offset2D::default(),
        extent: info.color.extent(),
    };
    let colors = [color];
    let rendering = vk::RenderingInfo::default()
        .render_area(area)
        .layer_count(1)
        .color_attachments(&colors)
        .depth_attachment(&depth);
    // SAFETY: the targets are in the layouts named, and `PassInfo::check` found that they fit.
    unsafe {
        let raw = &recorder.device.raw;
        let commands = recorder.commands;
        raw.cmd_begin_rendering(commands, &rendering);
        raw.cmd_set_viewport(commands, 0, &[flipped_viewport(area.extent)]);
        raw.cmd_set_scissor(commands, 0, &[area]);
    }
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
