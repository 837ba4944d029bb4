//! What does a pass draw to, and what does it read?

use std::sync::Arc;

use ash::vk;

use super::depth_array::DepthArray;
use super::device::Device;
use super::format::{Samples, TargetFormat};
use super::image::Image;
use super::pipeline::Targets;
use super::requirements::DEPTH;

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
    /// The depth that its shaders sample, drawn by earlier passes of the same recording: what was
    /// not is undefined.
    pub reads: &'a [&'a DepthArray],
}

/// Where a pass draws that leaves nothing but depth: a layer, cleared to 0 (far) and kept.
#[derive(Clone, Copy)]
pub struct DepthPassInfo<'a> {
    /// The pass's label.
    pub name: &'a str,
    /// The array of the layer.
    pub target: &'a DepthArray,
    /// The layer; the others keep what they have.
    pub layer: u32,
}

/// A pass as dynamic rendering begins it.
pub(super) struct Rendering<'a> {
    pub name: &'a str,
    pub targets: Targets,
    pub reads: &'a [&'a DepthArray],
    pub extent: vk::Extent2D,
    pub color: Option<vk::RenderingAttachmentInfo<'a>>,
    pub depth: vk::RenderingAttachmentInfo<'a>,
}

impl<'a> PassInfo<'a> {
    /// Asserts that the targets fit each other.
    pub(super) fn check(&self, device: &Arc<Device>) {
        let Self {
            name,
            color,
            resolve,
            depth,
            reads,
        } = self;
        for image in [*color, *depth].into_iter().chain(*resolve) {
            assert!(image.is_of(device), "{name}: targets of this device");
            assert_eq!(image.size(), color.size(), "{name}: targets of one size");
        }
        for array in *reads {
            assert!(array.is_of(device), "{name}: reads from this device");
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

    pub(super) fn rendering(&self) -> Rendering<'a> {
        let mut color = cleared()
            .image_view(self.color.view)
            .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
            .store_op(vk::AttachmentStoreOp::STORE);
        if let Some(resolve) = self.resolve {
            color = color
                .resolve_mode(vk::ResolveModeFlags::AVERAGE)
                .resolve_image_view(resolve.view)
                .resolve_image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
                .store_op(vk::AttachmentStoreOp::DONT_CARE);
        }
        Rendering {
            name: self.name,
            targets: Targets {
                color: Some(self.color.format()),
                depth: self.depth.format(),
                samples: self.color.samples(),
            },
            reads: self.reads,
            extent: self.color.extent(),
            color: Some(color),
            depth: depth(self.depth.view).store_op(vk::AttachmentStoreOp::DONT_CARE),
        }
    }
}

impl<'a> DepthPassInfo<'a> {
    /// The pass, if its target is this device's and has the layer; else it panics.
    pub(super) fn rendering(&self, device: &Arc<Device>) -> Rendering<'a> {
        let Self {
            name,
            target,
            layer,
        } = *self;
        assert!(target.is_of(device), "{name}: a target of this device");
        let Some(view) = target.layer_view(layer) else {
            panic!("{name}: layer {layer} of {}", target.layers());
        };
        Rendering {
            name,
            targets: Targets {
                color: None,
                depth: DEPTH,
                samples: Samples::One,
            },
            reads: &[],
            extent: target.extent(),
            color: None,
            depth: depth(view).store_op(vk::AttachmentStoreOp::STORE),
        }
    }
}

fn depth<'a>(view: vk::ImageView) -> vk::RenderingAttachmentInfo<'a> {
    cleared()
        .image_view(view)
        .image_layout(vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL)
}

/// The clear values of both are all zero bits: transparent black, and far in reversed depth.
fn cleared<'a>() -> vk::RenderingAttachmentInfo<'a> {
    vk::RenderingAttachmentInfo::default().load_op(vk::AttachmentLoadOp::CLEAR)
}
