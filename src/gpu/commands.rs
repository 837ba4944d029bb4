//! What is recorded, in which order, and how many state commands does it take?
//!
//! A recorder borrows all that it uses, and `submit` waits until the device is idle: nothing can be
//! dropped while the device still needs it. It counts what it records, so that the claim of one
//! pipeline and one set is a number and not a promise.

use std::ffi::CString;
use std::marker::PhantomData;
use std::sync::Arc;

use ash::vk;

use super::barriers::{self, ImageUse};
use super::buffer::{Buffer, BufferUse};
use super::descriptors::DescriptorSet;
use super::device::Device;
use super::error::{Error, Named};
use super::image::{Image, whole};
use super::pipeline::Pipeline;
use super::timestamps::Timestamps;

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

/// A command buffer in the making.
pub struct Recorder<'a> {
    commands: vk::CommandBuffer,
    pool: vk::CommandPool,
    images: Vec<(vk::Image, ImageUse)>,
    passes: Vec<PassCounts>,
    device: Arc<Device>,
    used: PhantomData<&'a ()>,
}

impl<'a> Recorder<'a> {
    /// Begins recording under a label.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(device: &Arc<Device>, label: &str) -> Result<Self, Error> {
        let info = vk::CommandPoolCreateInfo::default()
            .flags(vk::CommandPoolCreateFlags::TRANSIENT)
            .queue_family_index(device.queue_family);
        // SAFETY: the family is the device's own.
        let pool =
            unsafe { device.raw.create_command_pool(&info, None) }.named("vkCreateCommandPool")?;
        // From here on `Drop` destroys the pool on every path.
        let mut recorder = Self {
            commands: vk::CommandBuffer::null(),
            pool,
            images: Vec::new(),
            passes: Vec::new(),
            device: Arc::clone(device),
            used: PhantomData,
        };
        let info = vk::CommandBufferAllocateInfo::default()
            .command_pool(pool)
            .command_buffer_count(1);
        // SAFETY: the pool is alive and used by this recorder alone.
        let buffers = unsafe { device.raw.allocate_command_buffers(&info) }
            .named("vkAllocateCommandBuffers")?;
        recorder.commands = buffers[0];
        device.name(recorder.commands, label);
        let info = vk::CommandBufferBeginInfo::default()
            .flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the buffer is new.
        unsafe { device.raw.begin_command_buffer(recorder.commands, &info) }
            .named("vkBeginCommandBuffer")?;
        recorder.begin_label(label);
        Ok(recorder)
    }

    /// Records a pass: `draw` says what is in it.
    pub fn pass(&mut self, info: &PassInfo<'a>, draw: impl FnOnce(&mut Pass<'_, 'a>)) {
        let targets = [info.color, info.depth];
        for image in targets.into_iter().chain(info.resolve) {
            assert_eq!(
                image.size(),
                info.color.size(),
                "{}: targets of one size",
                info.name
            );
            self.transition(image, target_use(image));
        }
        self.begin_label(info.name);
        self.begin_rendering(info);
        let mut pass = Pass {
            recorder: self,
            counts: PassCounts {
                name: info.name.to_owned(),
                draws: 0,
                pipeline_binds: 0,
                descriptor_set_binds: 0,
            },
            bound: Bound::default(),
        };
        draw(&mut pass);
        let counts = pass.counts;
        // SAFETY: rendering was begun above.
        unsafe { self.device.raw.cmd_end_rendering(self.commands) };
        self.end_label();
        self.passes.push(counts);
    }

    /// Copies the texels of a one-sample image, row by row without padding.
    pub fn copy_image(&mut self, image: &'a Image, to: &'a Buffer) {
        assert!(to.bytes() >= image.bytes(), "the buffer holds the image");
        self.transition(image, ImageUse::TransferSource);
        let range = whole(image.format());
        let region = vk::BufferImageCopy::default()
            .image_subresource(vk::ImageSubresourceLayers {
                aspect_mask: range.aspect_mask,
                mip_level: 0,
                base_array_layer: 0,
                layer_count: 1,
            })
            .image_extent(image.extent().into());
        // SAFETY: the image is in the layout named, and the buffer is large enough.
        unsafe {
            self.device.raw.cmd_copy_image_to_buffer(
                self.commands,
                image.raw,
                vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
                to.raw,
                &[region],
            );
        }
        self.after_copy(to);
    }

    /// Copies `bytes` from the start of one buffer to an offset in another.
    pub fn copy_buffer(&mut self, from: &'a Buffer, to: &'a Buffer, offset: u64, bytes: u64) {
        let end = offset.checked_add(bytes);
        assert!(bytes <= from.bytes() && end.is_some_and(|end| end <= to.bytes()));
        let region = vk::BufferCopy::default().dst_offset(offset).size(bytes);
        // SAFETY: both ranges are inside their buffers.
        unsafe {
            self.device
                .raw
                .cmd_copy_buffer(self.commands, from.raw, to.raw, &[region]);
        }
        self.after_copy(to);
    }

    /// The stamp before the work that is timed.
    pub fn begin_timing(&mut self, timestamps: &'a Timestamps) {
        // SAFETY: outside a rendering instance; both queries are reset before they are written.
        unsafe {
            let raw = &self.device.raw;
            raw.cmd_reset_query_pool(self.commands, timestamps.pool, 0, 2);
            raw.cmd_write_timestamp2(
                self.commands,
                vk::PipelineStageFlags2::ALL_COMMANDS,
                timestamps.pool,
                0,
            );
        }
    }

    /// The stamp after it.
    pub fn end_timing(&mut self, timestamps: &'a Timestamps) {
        // SAFETY: outside a rendering instance, after `begin_timing`.
        unsafe {
            self.device.raw.cmd_write_timestamp2(
                self.commands,
                vk::PipelineStageFlags2::ALL_COMMANDS,
                timestamps.pool,
                1,
            );
        }
    }

    /// Ends recording; `submit` then only submits, so that the two can be timed apart.
    ///
    /// # Errors
    /// The driver fails.
    pub fn finish(mut self) -> Result<Recorded<'a>, Error> {
        self.end_label();
        // SAFETY: recording is under way.
        unsafe { self.device.raw.end_command_buffer(self.commands) }.named("vkEndCommandBuffer")?;
        Ok(Recorded { recorder: self })
    }

    /// Ends, submits and waits until the device is idle.
    ///
    /// # Errors
    /// The driver fails, or the device is lost.
    pub fn submit(self) -> Result<Vec<PassCounts>, Error> {
        self.finish()?.submit()
    }

    pub(super) fn device(&self) -> &Device {
        &self.device
    }

    pub(super) fn raw(&self) -> vk::CommandBuffer {
        self.commands
    }

    fn transition(&mut self, image: &'a Image, to: ImageUse) {
        let known = self.images.iter_mut().find(|(raw, _)| *raw == image.raw);
        let from = match known {
            Some((_, state)) => std::mem::replace(state, to),
            None => {
                self.images.push((image.raw, to));
                ImageUse::Undefined
            }
        };
        let range = whole(image.format());
        let images = [barriers::image_barrier(image.raw, range, from, to)];
        self.barrier(&vk::DependencyInfo::default().image_memory_barriers(&images));
    }

    fn after_copy(&mut self, to: &Buffer) {
        let by_host = to.usage() == BufferUse::Readback;
        let buffers = [barriers::after_copy(to.raw, by_host)];
        self.barrier(&vk::DependencyInfo::default().buffer_memory_barriers(&buffers));
    }

    fn barrier(&mut self, dependency: &vk::DependencyInfo) {
        // SAFETY: outside a rendering instance; every handle is alive.
        unsafe {
            self.device
                .raw
                .cmd_pipeline_barrier2(self.commands, dependency);
        }
    }

    fn begin_rendering(&mut self, info: &PassInfo) {
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
        // SAFETY: the targets are in the layouts named, of one size and sample count.
        unsafe {
            let raw = &self.device.raw;
            raw.cmd_begin_rendering(self.commands, &rendering);
            raw.cmd_set_viewport(self.commands, 0, &[flipped_viewport(area.extent)]);
            raw.cmd_set_scissor(self.commands, 0, &[area]);
        }
    }

    fn begin_label(&mut self, label: &str) {
        self.device.begin_label(label);
        if let (Some(debug_utils), Ok(label)) = (&self.device.debug_utils, CString::new(label)) {
            let info = vk::DebugUtilsLabelEXT::default().label_name(&label);
            // SAFETY: recording is under way; the name lives until the call returns.
            unsafe { debug_utils.cmd_begin_debug_utils_label(self.commands, &info) };
        }
    }

    fn end_label(&mut self) {
        if let Some(debug_utils) = &self.device.debug_utils {
            // SAFETY: a label was begun.
            unsafe { debug_utils.cmd_end_debug_utils_label(self.commands) };
        }
    }
}

impl Drop for Recorder<'_> {
    fn drop(&mut self) {
        // SAFETY: `submit` waited for the commands, or they were never submitted; the pool takes
        // its buffers with it.
        unsafe { self.device.raw.destroy_command_pool(self.pool, None) };
    }
}

/// Recorded commands, ready to be submitted once.
pub struct Recorded<'a> {
    recorder: Recorder<'a>,
}

impl Recorded<'_> {
    /// Submits and waits until the device is idle; returns what was recorded.
    ///
    /// # Errors
    /// The driver fails, or the device is lost.
    pub fn submit(mut self) -> Result<Vec<PassCounts>, Error> {
        self.recorder.device.run(self.recorder.commands)?;
        Ok(std::mem::take(&mut self.recorder.passes))
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
    counts: PassCounts,
    bound: Bound,
}

impl<'a> Pass<'_, 'a> {
    /// Binds the pipeline.
    pub fn bind_pipeline(&mut self, pipeline: &'a Pipeline) {
        // SAFETY: the pipeline is this device's; the recorder borrows it.
        unsafe {
            self.recorder.device.raw.cmd_bind_pipeline(
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
    pub fn bind_set(&mut self, set: &'a DescriptorSet) {
        // SAFETY: the set was made for this layout; the recorder borrows it.
        unsafe {
            self.recorder.device.raw.cmd_bind_descriptor_sets(
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
    pub fn bind_geometry(&mut self, vertices: &[&'a Buffer], indices: &'a Buffer) {
        for buffer in vertices {
            assert_eq!(buffer.usage(), BufferUse::Vertices);
        }
        assert_eq!(indices.usage(), BufferUse::Indices);
        let raw: Vec<_> = vertices.iter().map(|buffer| buffer.raw).collect();
        let offsets = vec![0; raw.len()];
        // SAFETY: buffers of the right use, from their start; the recorder borrows them.
        unsafe {
            let device = &self.recorder.device.raw;
            device.cmd_bind_vertex_buffers(self.recorder.commands, 0, &raw, &offsets);
            device.cmd_bind_index_buffer(
                self.recorder.commands,
                indices.raw,
                0,
                vk::IndexType::UINT32,
            );
        }
        self.bound.vertex_buffers = vertices.len();
        self.bound.indices = Some(indices.bytes() / 4);
    }

    /// Draws a range of the indices, each plus `vertex_offset`, as instance `instance`.
    /// Vertices and records beyond their buffers read as the device's robust access defines.
    pub fn draw(&mut self, indices: std::ops::Range<u32>, vertex_offset: i32, instance: u32) {
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

fn target_use(image: &Image) -> ImageUse {
    match image.format() {
        super::format::Format::Depth32Float => ImageUse::DepthTarget,
        _ => ImageUse::ColorTarget,
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
