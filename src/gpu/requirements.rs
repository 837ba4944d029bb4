//! What must a device have to run Umber?
//!
//! Little, so that both CPU drivers and any desktop GPU of the last ten years fit: Vulkan 1.3 with
//! dynamic rendering and synchronization2, a graphics queue, a 32-bit float target that blends, and a
//! depth target that can be sampled. Every device samples the texture formats.

use ash::vk;

use super::format::{Samples, TargetFormat};

/// The colour target of the physics: 16-bit floats overflow at a mirror's peak.
pub const COLOR: TargetFormat = TargetFormat::Rgba32Float;
/// The depth target; a float keeps its precision where reversed depth puts the far plane.
pub const DEPTH: TargetFormat = TargetFormat::Depth32Float;

/// What `device` lacks, in Vulkan's words; empty for a suitable device.
pub(super) fn missing(
    instance: &ash::Instance,
    device: vk::PhysicalDevice,
    api_version: u32,
) -> Vec<String> {
    if api_version < super::instance::API_VERSION {
        return vec!["Vulkan 1.3".into()];
    }
    let mut missing = missing_features(instance, device);
    if graphics_queue(instance, device).is_none() {
        missing.push("a graphics queue".into());
    }
    let blend =
        vk::FormatFeatureFlags::COLOR_ATTACHMENT_BLEND | vk::FormatFeatureFlags::TRANSFER_SRC;
    if !has_format(instance, device, COLOR.vulkan(), blend) {
        missing.push("a blended R32G32B32A32_SFLOAT target".into());
    }
    let depth =
        vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT | vk::FormatFeatureFlags::SAMPLED_IMAGE;
    if !has_format(instance, device, DEPTH.vulkan(), depth) {
        missing.push("a sampled D32_SFLOAT target".into());
    }
    missing
}

fn missing_features(instance: &ash::Instance, device: vk::PhysicalDevice) -> Vec<String> {
    let mut core_13 = vk::PhysicalDeviceVulkan13Features::default();
    let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut core_13);
    // SAFETY: `device` comes from `instance`; the chain lives until the call returns.
    unsafe { instance.get_physical_device_features2(device, &mut features) };
    let core = features.features;
    [
        (core_13.dynamic_rendering, "dynamicRendering"),
        (core_13.synchronization2, "synchronization2"),
        // What `discard` is in SPIR-V 1.6; every Vulkan 1.3 device promises it.
        (
            core_13.shader_demote_to_helper_invocation,
            "shaderDemoteToHelperInvocation",
        ),
        (core.robust_buffer_access, "robustBufferAccess"),
        // Ten million triangles have more vertices than 2^24 - 1, all that is promised without it.
        (core.full_draw_index_uint32, "fullDrawIndexUint32"),
    ]
    .into_iter()
    .filter(|(present, _)| *present == vk::FALSE)
    .map(|(_, name)| name.to_string())
    .collect()
}

/// Whether one command can draw many objects, each of its own instance. No frame needs it.
pub(super) fn draws_indirect(instance: &ash::Instance, device: vk::PhysicalDevice) -> bool {
    // SAFETY: `device` comes from `instance`.
    let core = unsafe { instance.get_physical_device_features(device) };
    core.multi_draw_indirect == vk::TRUE && core.draw_indirect_first_instance == vk::TRUE
}

/// The first queue family that draws; it also computes and copies, as Vulkan promises.
pub(super) fn graphics_queue(
    instance: &ash::Instance,
    device: vk::PhysicalDevice,
) -> Option<(u32, vk::QueueFamilyProperties)> {
    // SAFETY: `device` comes from `instance`.
    let families = unsafe { instance.get_physical_device_queue_family_properties(device) };
    (0..)
        .zip(families)
        .find(|(_, family)| family.queue_flags.contains(vk::QueueFlags::GRAPHICS))
}

fn has_format(
    instance: &ash::Instance,
    device: vk::PhysicalDevice,
    format: vk::Format,
    wanted: vk::FormatFeatureFlags,
) -> bool {
    // SAFETY: `device` comes from `instance`.
    let properties = unsafe { instance.get_physical_device_format_properties(device, format) };
    properties.optimal_tiling_features.contains(wanted)
}

/// The sample counts that colour and depth targets both have.
pub(super) fn sample_counts(instance: &ash::Instance, device: vk::PhysicalDevice) -> Vec<Samples> {
    let of = |format: TargetFormat, usage| {
        // SAFETY: `device` comes from `instance`.
        unsafe {
            instance.get_physical_device_image_format_properties(
                device,
                format.vulkan(),
                vk::ImageType::TYPE_2D,
                vk::ImageTiling::OPTIMAL,
                usage,
                vk::ImageCreateFlags::empty(),
            )
        }
        .map_or(vk::SampleCountFlags::empty(), |found| found.sample_counts)
    };
    let both = of(COLOR, vk::ImageUsageFlags::COLOR_ATTACHMENT)
        & of(DEPTH, vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT);
    Samples::ALL
        .iter()
        .copied()
        .filter(|samples| both.contains(samples.vulkan()))
        .collect()
}
