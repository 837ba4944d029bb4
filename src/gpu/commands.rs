//! What is recorded, in which order, and when is it done?
//!
//! A recorder borrows all that it uses, and `submit` waits until the device is idle: nothing can be
//! dropped, read or written by the host while the device still needs it.

use std::ffi::CString;
use std::marker::PhantomData;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use ash::vk;

use super::barriers::{self, ImageUse, ImageUses};
use super::buffer::{Buffer, BufferUse};
use super::depth_array::DepthArray;
use super::device::Device;
use super::error::{Error, Named};
use super::format::{Samples, TargetFormat};
use super::image::{Image, whole};
use super::pass::{Pass, PassCounts};
use super::pass_info::{DepthPassInfo, PassInfo, Rendering};
use super::texture_array::TextureArray;
use super::timestamps::Timestamps;

/// A command buffer in the making.
pub struct Recorder<'a> {
    pub(super) commands: vk::CommandBuffer,
    pool: vk::CommandPool,
    images: ImageUses,
    passes: Vec<PassCounts>,
    /// Depth arrays, and whether shaders were the last to use them.
    depths: Vec<(&'a DepthArray, bool)>,
    pub(super) device: Arc<Device>,
    used: PhantomData<&'a mut ()>,
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
            images: ImageUses::default(),
            passes: Vec::new(),
            depths: Vec::new(),
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
    ///
    /// # Panics
    /// The targets differ in size or samples, or there is no resolve target where colour has
    /// several samples (or one where it has not).
    pub fn pass(&mut self, info: &PassInfo<'a>, draw: impl FnOnce(&mut Pass<'_, 'a>)) {
        info.check(&self.device);
        self.transition(info.color, ImageUse::ColorTarget);
        self.transition(info.depth, ImageUse::DepthTarget);
        if let Some(resolve) = info.resolve {
            self.transition(resolve, ImageUse::ColorTarget);
        }
        for array in info.reads {
            self.transition_depth(array, ImageUse::ShaderRead);
        }
        self.record(info.rendering(), draw);
    }

    /// Records a pass that draws depth alone: `draw` says what is in it.
    ///
    /// # Panics
    /// There is no such layer.
    pub fn depth_pass(&mut self, info: &DepthPassInfo<'a>, draw: impl FnOnce(&mut Pass<'_, 'a>)) {
        let rendering = info.rendering(&self.device);
        self.transition_depth(info.target, ImageUse::DepthTarget);
        self.record(rendering, draw);
    }

    /// Takes an array as an earlier recording left it: its passes may read it without drawing to it first.
    ///
    /// # Panics
    /// No recording that is done drew to it and read it, or this one has used it already.
    pub fn keep(&mut self, array: &'a DepthArray) {
        assert!(array.is_of(&self.device));
        assert!(
            array.is_kept.load(Ordering::Acquire),
            "there is something to keep"
        );
        let before = self.images.next(array.image.raw, ImageUse::ShaderRead);
        assert_eq!(before, ImageUse::Undefined, "it is kept before it is used");
    }

    fn record(&mut self, rendering: Rendering<'a>, draw: impl FnOnce(&mut Pass<'_, 'a>)) {
        self.begin_label(rendering.name);
        let counts = Pass::record(self, rendering, draw);
        self.end_label();
        self.passes.push(counts);
    }

    /// Copies the texels of a one-sample colour image, row by row without padding.
    ///
    /// # Panics
    /// The image is of another kind, or the buffer is too small or not for readback.
    pub fn copy_image(&mut self, image: &'a Image, to: &'a mut Buffer) {
        let copyable = (TargetFormat::Rgba32Float, Samples::One);
        assert_eq!((image.format(), image.samples()), copyable);
        assert!(image.is_of(&self.device) && to.is_of(&self.device));
        assert!(to.usage() == BufferUse::Readback && to.bytes() >= image.bytes());
        self.transition(image, ImageUse::TransferSource);
        self.before_copy(to);
        let range = whole(image.format());
        let region = vk::BufferImageCopy::default()
            .image_subresource(vk::ImageSubresourceLayers {
                aspect_mask: range.aspect_mask,
                mip_level: 0,
                base_array_layer: 0,
                layer_count: 1,
            })
            .image_extent(image.extent().into());
        // SAFETY: the image is in the layout named and can be copied from; the buffer can be copied
        // to and is large enough.
        unsafe {
            self.device.raw.cmd_copy_image_to_buffer(
                self.commands,
                image.image.raw,
                vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
                to.raw,
                &[region],
            );
        }
        self.after_copy(to);
    }

    /// Copies `bytes` (at least 1) from the start of a staging buffer to an offset in another buffer.
    ///
    /// # Panics
    /// A range leaves its buffer, or the buffers are of another use.
    pub fn copy_buffer(&mut self, from: &'a Buffer, to: &'a mut Buffer, offset: u64, bytes: u64) {
        assert!(from.is_of(&self.device) && to.is_of(&self.device));
        assert!(from.usage() == BufferUse::Staging && to.usage() != BufferUse::Staging);
        self.copy(from, to, offset, bytes);
    }

    /// Copies the first `bytes` (at least 1) of a buffer that a dispatch wrote to where the host can read them.
    ///
    /// # Panics
    /// A buffer is smaller, or of another use.
    pub fn read_back(&mut self, from: &'a Buffer, to: &'a mut Buffer, bytes: u64) {
        assert!(from.is_of(&self.device) && to.is_of(&self.device));
        assert!(from.usage() == BufferUse::Written && to.usage() == BufferUse::Readback);
        let buffers = [barriers::before_read_back(from.raw)];
        self.barrier(&vk::DependencyInfo::default().buffer_memory_barriers(&buffers));
        self.copy(from, to, 0, bytes);
    }

    fn copy(&mut self, from: &Buffer, to: &Buffer, offset: u64, bytes: u64) {
        let end = offset.checked_add(bytes);
        assert!(bytes > 0 && bytes <= from.bytes() && end.is_some_and(|end| end <= to.bytes()));
        self.before_copy(to);
        let region = vk::BufferCopy::default().dst_offset(offset).size(bytes);
        // SAFETY: both ranges are inside their buffers, which can be copied from and to.
        unsafe {
            self.device
                .raw
                .cmd_copy_buffer(self.commands, from.raw, to.raw, &[region]);
        }
        self.after_copy(to);
    }

    /// Stamps the time before and after `work`, which records passes.
    pub fn timed(&mut self, timestamps: &'a Timestamps, work: impl FnOnce(&mut Self)) {
        assert!(timestamps.is_of(&self.device));
        // SAFETY: outside a rendering instance; the pool has two queries.
        unsafe {
            self.device
                .raw
                .cmd_reset_query_pool(self.commands, timestamps.pool, 0, 2);
        }
        self.stamp(timestamps, 0);
        work(self);
        self.stamp(timestamps, 1);
    }

    fn stamp(&mut self, timestamps: &Timestamps, query: u32) {
        let stage = vk::PipelineStageFlags2::ALL_COMMANDS;
        // SAFETY: outside a rendering instance; `timed` reset the queries.
        unsafe {
            self.device
                .raw
                .cmd_write_timestamp2(self.commands, stage, timestamps.pool, query);
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

    /// Copies staged texels into an array that was last used for `from`, and makes it ready for
    /// `then`. The copies are parts of both.
    pub(super) fn fill(
        &mut self,
        staging: &'a Buffer,
        array: &'a mut TextureArray,
        copies: &[vk::BufferImageCopy],
        from: ImageUse,
        then: ImageUse,
    ) {
        let (image, range) = (array.image.raw, array.range());
        self.image_barrier(image, range, from, ImageUse::TransferDestination);
        // SAFETY: the image is in the layout named and can be copied to; `TextureUpload` made the
        // copies of rows that it staged, each inside its level and layer.
        unsafe {
            self.device.raw.cmd_copy_buffer_to_image(
                self.commands,
                staging.raw,
                image,
                vk::ImageLayout::TRANSFER_DST_OPTIMAL,
                copies,
            );
        }
        self.image_barrier(image, range, ImageUse::TransferDestination, then);
    }

    fn transition(&mut self, image: &'a Image, to: ImageUse) {
        let raw = image.image.raw;
        let from = self.images.next(raw, to);
        self.image_barrier(raw, whole(image.format()), from, to);
    }

    fn transition_depth(&mut self, array: &'a DepthArray, to: ImageUse) {
        let raw = array.image.raw;
        let from = self.images.next(raw, to);
        self.image_barrier(raw, array.range(), from, to);
        // Whatever becomes of the commands, nothing is kept until they are done.
        array.is_kept.store(false, Ordering::Release);
        self.depths.push((array, to == ImageUse::ShaderRead));
    }

    fn image_barrier(
        &mut self,
        image: vk::Image,
        range: vk::ImageSubresourceRange,
        from: ImageUse,
        to: ImageUse,
    ) {
        let images = [barriers::image_barrier(image, range, from, to)];
        self.barrier(&vk::DependencyInfo::default().image_memory_barriers(&images));
    }

    fn before_copy(&mut self, to: &Buffer) {
        let buffers = [barriers::before_copy(to.raw)];
        self.barrier(&vk::DependencyInfo::default().buffer_memory_barriers(&buffers));
    }

    fn after_copy(&mut self, to: &Buffer) {
        let by_host = to.usage() == BufferUse::Readback;
        let buffers = [barriers::after_copy(to.raw, by_host)];
        self.barrier(&vk::DependencyInfo::default().buffer_memory_barriers(&buffers));
    }

    pub(super) fn barrier(&mut self, dependency: &vk::DependencyInfo) {
        // SAFETY: outside a rendering instance; every handle is alive.
        unsafe {
            self.device
                .raw
                .cmd_pipeline_barrier2(self.commands, dependency);
        }
    }

    fn begin_label(&mut self, label: &str) {
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
    /// Throws the commands away; returns what was recorded.
    pub fn discard(mut self) -> Vec<PassCounts> {
        std::mem::take(&mut self.recorder.passes)
    }

    /// Submits and waits until the device is idle; returns what was recorded.
    ///
    /// # Errors
    /// The driver fails, or the device is lost.
    pub fn submit(mut self) -> Result<Vec<PassCounts>, Error> {
        let passes = std::mem::take(&mut self.recorder.passes);
        let last = passes.last().map(|pass| pass.name.clone());
        self.recorder.device.run(self.recorder.commands, last)?;
        for (array, is_read) in &self.recorder.depths {
            array.is_kept.store(*is_read, Ordering::Release);
        }
        Ok(passes)
    }
}
