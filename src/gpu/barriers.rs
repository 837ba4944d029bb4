//! What must be waited for, and made visible, between one use of an image and the next?
//!
//! One function answers for every pass, because Debian 12's validation layers (1.3.239) see no
//! hazards on dynamic-rendering attachments: what they cannot check is checked by the table below.

use ash::vk;

/// How a pass uses an image.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ImageUse {
    /// Nothing worth keeping is in it.
    Undefined,
    /// Drawn to, blended, or resolved into.
    ColorTarget,
    /// Depth tested and written.
    DepthTarget,
    /// Copied from.
    TransferSource,
    /// Copied to.
    TransferDestination,
    /// Sampled by fragment shaders.
    ShaderRead,
}

/// What each image was last used for, in one recording.
#[derive(Default)]
pub(super) struct ImageUses(Vec<(vk::Image, ImageUse)>);

impl ImageUses {
    /// Notes that `image` is used for `to` from now on, and says what it was used for before.
    pub(super) fn next(&mut self, image: vk::Image, to: ImageUse) -> ImageUse {
        if let Some((_, known)) = self.0.iter_mut().find(|(known, _)| *known == image) {
            return std::mem::replace(known, to);
        }
        self.0.push((image, to));
        ImageUse::Undefined
    }
}

/// The half of a barrier that one use gives: where it happens, what it touches, in which layout.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Half {
    stage: vk::PipelineStageFlags2,
    access: vk::AccessFlags2,
    layout: vk::ImageLayout,
}

impl ImageUse {
    fn half(self) -> Half {
        match self {
            Self::Undefined => Half {
                stage: vk::PipelineStageFlags2::NONE,
                access: vk::AccessFlags2::NONE,
                layout: vk::ImageLayout::UNDEFINED,
            },
            // A resolve is a write of this stage too, whatever the format.
            Self::ColorTarget => Half {
                stage: vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT,
                access: vk::AccessFlags2::COLOR_ATTACHMENT_READ
                    | vk::AccessFlags2::COLOR_ATTACHMENT_WRITE,
                layout: vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
            },
            Self::DepthTarget => Half {
                stage: vk::PipelineStageFlags2::EARLY_FRAGMENT_TESTS
                    | vk::PipelineStageFlags2::LATE_FRAGMENT_TESTS,
                access: vk::AccessFlags2::DEPTH_STENCIL_ATTACHMENT_READ
                    | vk::AccessFlags2::DEPTH_STENCIL_ATTACHMENT_WRITE,
                layout: vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL,
            },
            Self::TransferSource => Half {
                stage: vk::PipelineStageFlags2::COPY,
                access: vk::AccessFlags2::TRANSFER_READ,
                layout: vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
            },
            Self::TransferDestination => Half {
                stage: vk::PipelineStageFlags2::COPY,
                access: vk::AccessFlags2::TRANSFER_WRITE,
                layout: vk::ImageLayout::TRANSFER_DST_OPTIMAL,
            },
            // No other stage sees a texture: `SetLayout` shows it to none.
            Self::ShaderRead => Half {
                stage: vk::PipelineStageFlags2::FRAGMENT_SHADER,
                access: vk::AccessFlags2::SHADER_SAMPLED_READ,
                layout: vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL,
            },
        }
    }
}

/// The writes among `access`: only writes need to be made available; a read before it needs order
/// alone.
fn writes(access: vk::AccessFlags2) -> vk::AccessFlags2 {
    access
        & (vk::AccessFlags2::COLOR_ATTACHMENT_WRITE
            | vk::AccessFlags2::DEPTH_STENCIL_ATTACHMENT_WRITE
            | vk::AccessFlags2::TRANSFER_WRITE)
}

/// The barrier on the whole of `image` between two uses.
pub(super) fn image_barrier(
    image: vk::Image,
    range: vk::ImageSubresourceRange,
    from: ImageUse,
    to: ImageUse,
) -> vk::ImageMemoryBarrier2<'static> {
    let (from, to) = (from.half(), to.half());
    vk::ImageMemoryBarrier2::default()
        .src_stage_mask(from.stage)
        .src_access_mask(writes(from.access))
        .old_layout(from.layout)
        .dst_stage_mask(to.stage)
        .dst_access_mask(to.access)
        .new_layout(to.layout)
        .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
        .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
        .image(image)
        .subresource_range(range)
}

/// The barrier before a copy into a buffer: whatever read or wrote it has ended.
pub(super) fn before_copy(buffer: vk::Buffer) -> vk::BufferMemoryBarrier2<'static> {
    buffer_barrier(buffer)
        .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
        .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
        .dst_stage_mask(vk::PipelineStageFlags2::COPY)
        .dst_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
}

/// The barrier after a copy into a buffer: to the host that reads it, or to the shaders and
/// fixed functions that fetch from it.
pub(super) fn after_copy(
    buffer: vk::Buffer,
    read_by_host: bool,
) -> vk::BufferMemoryBarrier2<'static> {
    let (stage, access) = if read_by_host {
        (vk::PipelineStageFlags2::HOST, vk::AccessFlags2::HOST_READ)
    } else {
        (
            vk::PipelineStageFlags2::ALL_COMMANDS,
            vk::AccessFlags2::MEMORY_READ,
        )
    };
    buffer_barrier(buffer)
        .src_stage_mask(vk::PipelineStageFlags2::COPY)
        .src_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
        .dst_stage_mask(stage)
        .dst_access_mask(access)
}

/// The barrier before a dispatch: what it reads was written, and whatever used what it writes has ended.
pub(super) fn before_dispatch() -> vk::MemoryBarrier2<'static> {
    vk::MemoryBarrier2::default()
        .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
        .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
        .dst_stage_mask(vk::PipelineStageFlags2::COMPUTE_SHADER)
        .dst_access_mask(
            vk::AccessFlags2::SHADER_STORAGE_READ | vk::AccessFlags2::SHADER_STORAGE_WRITE,
        )
}

/// The barrier before a copy out of a buffer that a dispatch wrote.
pub(super) fn before_read_back(buffer: vk::Buffer) -> vk::BufferMemoryBarrier2<'static> {
    buffer_barrier(buffer)
        .src_stage_mask(vk::PipelineStageFlags2::COMPUTE_SHADER)
        .src_access_mask(vk::AccessFlags2::SHADER_STORAGE_WRITE)
        .dst_stage_mask(vk::PipelineStageFlags2::COPY)
        .dst_access_mask(vk::AccessFlags2::TRANSFER_READ)
}

fn buffer_barrier(buffer: vk::Buffer) -> vk::BufferMemoryBarrier2<'static> {
    vk::BufferMemoryBarrier2::default()
        .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
        .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
        .buffer(buffer)
        .size(vk::WHOLE_SIZE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ImageUse::{
        ColorTarget, DepthTarget, ShaderRead, TransferDestination, TransferSource, Undefined,
    };
    use vk::AccessFlags2 as Access;
    use vk::ImageLayout as Layout;
    use vk::PipelineStageFlags2 as Stage;

    /// Each pair of uses that a frame contains, with the whole barrier written out by hand from the
    /// specification's table of stages and accesses.
    #[test]
    fn every_pair_has_its_barrier() {
        let fragment_tests = Stage::EARLY_FRAGMENT_TESTS | Stage::LATE_FRAGMENT_TESTS;
        let color = Access::COLOR_ATTACHMENT_READ | Access::COLOR_ATTACHMENT_WRITE;
        let depth = Access::DEPTH_STENCIL_ATTACHMENT_READ | Access::DEPTH_STENCIL_ATTACHMENT_WRITE;
        let table = [
            (
                (Undefined, ColorTarget),
                (Stage::NONE, Access::NONE, Layout::UNDEFINED),
                (
                    Stage::COLOR_ATTACHMENT_OUTPUT,
                    color,
                    Layout::COLOR_ATTACHMENT_OPTIMAL,
                ),
            ),
            (
                (Undefined, DepthTarget),
                (Stage::NONE, Access::NONE, Layout::UNDEFINED),
                (fragment_tests, depth, Layout::DEPTH_ATTACHMENT_OPTIMAL),
            ),
            (
                (ColorTarget, TransferSource),
                (
                    Stage::COLOR_ATTACHMENT_OUTPUT,
                    Access::COLOR_ATTACHMENT_WRITE,
                    Layout::COLOR_ATTACHMENT_OPTIMAL,
                ),
                (
                    Stage::COPY,
                    Access::TRANSFER_READ,
                    Layout::TRANSFER_SRC_OPTIMAL,
                ),
            ),
            (
                (ColorTarget, ColorTarget),
                (
                    Stage::COLOR_ATTACHMENT_OUTPUT,
                    Access::COLOR_ATTACHMENT_WRITE,
                    Layout::COLOR_ATTACHMENT_OPTIMAL,
                ),
                (
                    Stage::COLOR_ATTACHMENT_OUTPUT,
                    color,
                    Layout::COLOR_ATTACHMENT_OPTIMAL,
                ),
            ),
            (
                (TransferSource, ColorTarget),
                (Stage::COPY, Access::NONE, Layout::TRANSFER_SRC_OPTIMAL),
                (
                    Stage::COLOR_ATTACHMENT_OUTPUT,
                    color,
                    Layout::COLOR_ATTACHMENT_OPTIMAL,
                ),
            ),
        ];
        for row in table {
            check(row);
        }
    }

    /// The same for the images that shaders sample.
    #[test]
    fn every_pair_of_a_sampled_image_has_its_barrier() {
        let fragment_tests = Stage::EARLY_FRAGMENT_TESTS | Stage::LATE_FRAGMENT_TESTS;
        let depth = Access::DEPTH_STENCIL_ATTACHMENT_READ | Access::DEPTH_STENCIL_ATTACHMENT_WRITE;
        let depth_layout = Layout::DEPTH_ATTACHMENT_OPTIMAL;
        let depth_written = Access::DEPTH_STENCIL_ATTACHMENT_WRITE;
        let to_depth = (fragment_tests, depth, depth_layout);
        let from_depth = (fragment_tests, depth_written, depth_layout);
        let nothing = (Stage::NONE, Access::NONE, Layout::UNDEFINED);
        let copied = (
            Stage::COPY,
            Access::TRANSFER_WRITE,
            Layout::TRANSFER_DST_OPTIMAL,
        );
        let sampled = |access| {
            (
                Stage::FRAGMENT_SHADER,
                access,
                Layout::SHADER_READ_ONLY_OPTIMAL,
            )
        };
        let to_shader = sampled(Access::SHADER_SAMPLED_READ);
        // A read leaves nothing to make available: the next use only waits for it.
        let from_shader = sampled(Access::NONE);
        let table = [
            ((DepthTarget, DepthTarget), from_depth, to_depth),
            ((DepthTarget, ShaderRead), from_depth, to_shader),
            ((ShaderRead, DepthTarget), from_shader, to_depth),
            ((ShaderRead, ShaderRead), from_shader, to_shader),
            ((Undefined, ShaderRead), nothing, to_shader),
            ((Undefined, TransferDestination), nothing, copied),
            ((TransferDestination, TransferDestination), copied, copied),
            ((TransferDestination, ShaderRead), copied, to_shader),
        ];
        for row in table {
            check(row);
        }
    }

    type Side = (Stage, Access, Layout);

    fn check(((from, to), source, destination): ((ImageUse, ImageUse), Side, Side)) {
        let b = image_barrier(
            vk::Image::null(),
            vk::ImageSubresourceRange::default(),
            from,
            to,
        );
        let got = (b.src_stage_mask, b.src_access_mask, b.old_layout);
        assert_eq!(got, source, "{from:?} -> {to:?}: source");
        let got = (b.dst_stage_mask, b.dst_access_mask, b.new_layout);
        assert_eq!(got, destination, "{from:?} -> {to:?}: destination");
    }

    #[test]
    fn each_image_remembers_its_own_last_use() {
        use vk::Handle;
        let (a, b) = (vk::Image::from_raw(1), vk::Image::from_raw(2));
        let mut uses = ImageUses::default();
        assert_eq!(uses.next(a, ColorTarget), Undefined);
        assert_eq!(uses.next(b, DepthTarget), Undefined);
        assert_eq!(uses.next(a, TransferSource), ColorTarget);
        assert_eq!(uses.next(a, ColorTarget), TransferSource);
        assert_eq!(uses.next(b, DepthTarget), DepthTarget);
    }

    #[test]
    fn a_readback_is_made_visible_to_the_host() {
        let b = after_copy(vk::Buffer::null(), true);
        assert_eq!(b.src_stage_mask, Stage::COPY);
        assert_eq!(b.src_access_mask, Access::TRANSFER_WRITE);
        assert_eq!(
            (b.dst_stage_mask, b.dst_access_mask),
            (Stage::HOST, Access::HOST_READ)
        );
        let b = after_copy(vk::Buffer::null(), false);
        assert_eq!(b.dst_access_mask, Access::MEMORY_READ);
    }

    #[test]
    fn a_dispatch_waits_for_what_wrote_and_a_copy_for_what_it_wrote() {
        let b = before_dispatch();
        assert_eq!(
            (b.src_stage_mask, b.src_access_mask),
            (Stage::ALL_COMMANDS, Access::MEMORY_WRITE)
        );
        assert_eq!(b.dst_stage_mask, Stage::COMPUTE_SHADER);
        let both = Access::SHADER_STORAGE_READ | Access::SHADER_STORAGE_WRITE;
        assert_eq!(b.dst_access_mask, both);
        let b = before_read_back(vk::Buffer::null());
        assert_eq!(
            (b.src_stage_mask, b.src_access_mask),
            (Stage::COMPUTE_SHADER, Access::SHADER_STORAGE_WRITE)
        );
        assert_eq!(
            (b.dst_stage_mask, b.dst_access_mask),
            (Stage::COPY, Access::TRANSFER_READ)
        );
    }

    #[test]
    fn a_copy_waits_for_what_used_its_destination() {
        let b = before_copy(vk::Buffer::null());
        assert_eq!(
            (b.src_stage_mask, b.src_access_mask),
            (Stage::ALL_COMMANDS, Access::MEMORY_WRITE)
        );
        assert_eq!(
            (b.dst_stage_mask, b.dst_access_mask),
            (Stage::COPY, Access::TRANSFER_WRITE)
        );
    }
}
