//! How do shaders become the pipeline that draws every material, or depth alone?

use std::sync::Arc;

use ash::vk;

use super::device::Device;
use super::error::{Error, Named};
use super::format::{Samples, TargetFormat, VertexFormat};
use super::pipeline_cache::PipelineCache;
use super::pipeline_layout::PipelineLayout;
use super::specialize::specialized;
use super::spirv;

/// One vertex attribute, in a buffer of its own.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Attribute {
    /// The shader's location.
    pub location: u32,
    /// Its format; the buffer is tightly packed.
    pub format: VertexFormat,
    /// Which element of the buffer a vertex gets.
    pub rate: Rate,
}

/// How an attribute advances from vertex to vertex.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Rate {
    /// Each vertex has its own element.
    PerVertex,
    /// All have the first: a buffer of one element stands for what a mesh lacks.
    Constant,
}

/// A specialization constant and its value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Constant {
    /// The shader's `constant_id`.
    pub id: u32,
    /// Its value.
    pub value: i32,
}

/// Words that the shader builder made, and validated with both of its compilers. Only this crate
/// makes one: a driver may do anything with words that are no SPIR-V.
#[derive(Clone, Copy, Debug)]
pub struct Spirv(pub(crate) &'static [u32]);

/// What a pipeline draws to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Targets {
    /// Colour; none where depth is all that is drawn.
    pub color: Option<TargetFormat>,
    /// Depth.
    pub depth: TargetFormat,
    /// Samples a pixel of both.
    pub samples: Samples,
}

/// Everything that makes a graphics pipeline; what is not here is the same for all of them.
#[derive(Clone, Copy, Debug)]
pub struct PipelineInfo<'a> {
    /// Shader and variant, for captures and messages: `surface[lighting=slides]`.
    pub name: &'a str,
    /// SPIR-V of the vertex stage.
    pub vertex: Spirv,
    /// SPIR-V of the fragment stage; without one, depth alone can be drawn.
    pub fragment: Option<Spirv>,
    /// Vertex attributes; attribute `i` comes from vertex buffer `i`.
    pub attributes: &'a [Attribute],
    /// Values for both stages.
    pub constants: &'a [Constant],
    /// What it draws to.
    pub targets: Targets,
    /// What becomes of its fragments.
    pub output: Output,
}

/// What becomes of a pipeline's fragments.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Output {
    /// They lie over what is there: premultiplied (ONE, ONE_MINUS_SRC_ALPHA), so that one pipeline serves opaque
    /// materials and glass.
    #[default]
    Blended,
    /// They take its place.
    Replacing,
    /// There are none: triangles end before the rasteriser.
    Discarded,
}

/// A graphics pipeline; it holds the layout that it was made for.
///
/// Triangle list; counter-clockwise faces are front; depth tested with GREATER and written, since
/// depth is reversed.
pub struct Pipeline {
    pub(super) raw: vk::Pipeline,
    pub(super) layout: Arc<PipelineLayout>,
    attributes: usize,
    has_fragments: bool,
    targets: Targets,
    device: Arc<Device>,
}

impl Pipeline {
    /// Makes the pipeline. On some drivers (lavapipe) this only takes note, and the first draw
    /// compiles.
    ///
    /// # Panics
    /// It would draw colour without a fragment stage, or reads more attributes than the device can.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(
        device: &Arc<Device>,
        layout: &Arc<PipelineLayout>,
        cache: &PipelineCache,
        info: &PipelineInfo,
    ) -> Result<Self, Error> {
        assert!(
            layout.is_of(device) && cache.is_of(device),
            "{}: device",
            info.name
        );
        let limit = device.limits.max_vertex_input_bindings as usize;
        assert!(info.attributes.len() <= limit, "{}: attributes", info.name);
        assert!(
            info.fragment.is_some() || info.targets.color.is_none(),
            "{}: colour comes from a fragment stage",
            info.name
        );
        let vertex = Module::new(device, info.vertex, info.constants, info.name)?;
        let fragment = info
            .fragment
            .map(|fragment| Module::new(device, fragment, info.constants, info.name))
            .transpose()?;
        let raw = create(device, layout, cache, info, &vertex, fragment.as_ref())?;
        device.name(raw, info.name);
        device.count_pipeline();
        Ok(Self {
            raw,
            layout: Arc::clone(layout),
            attributes: info.attributes.len(),
            has_fragments: info.fragment.is_some(),
            targets: info.targets,
            device: Arc::clone(device),
        })
    }

    pub(super) fn is_of(&self, device: &Arc<Device>) -> bool {
        Arc::ptr_eq(&self.device, device)
    }

    pub(super) fn targets(&self) -> Targets {
        self.targets
    }

    pub(super) fn has_fragments(&self) -> bool {
        self.has_fragments
    }

    /// How many vertex buffers it reads.
    pub(super) fn vertex_buffers(&self) -> usize {
        self.attributes
    }
}

impl Drop for Pipeline {
    fn drop(&mut self) {
        // SAFETY: recorders borrow the pipeline until the device is done with it.
        unsafe { self.device.raw.destroy_pipeline(self.raw, None) };
    }
}

/// A shader module, needed only while its pipeline is made.
pub(super) struct Module<'a> {
    device: &'a Device,
    raw: vk::ShaderModule,
}

impl<'a> Module<'a> {
    /// A module in which `constants` are frozen.
    pub(super) fn new(
        device: &'a Device,
        Spirv(words): Spirv,
        constants: &[Constant],
        name: &str,
    ) -> Result<Self, Error> {
        let words = specialized(words, constants);
        let words = spirv::module_words(&words, device.preserves_nan);
        let info = vk::ShaderModuleCreateInfo::default().code(&words);
        // SAFETY: the words come from the project's own compiler, which validated them.
        let raw = unsafe { device.raw.create_shader_module(&info, None) }
            .named("vkCreateShaderModule")?;
        device.name(raw, name);
        Ok(Self { device, raw })
    }
}

impl Drop for Module<'_> {
    fn drop(&mut self) {
        // SAFETY: pipelines do not need their modules once they exist.
        unsafe { self.device.raw.destroy_shader_module(self.raw, None) };
    }
}

fn create(
    device: &Device,
    layout: &PipelineLayout,
    cache: &PipelineCache,
    info: &PipelineInfo,
    vertex: &Module,
    fragment: Option<&Module>,
) -> Result<vk::Pipeline, Error> {
    let stages: Vec<_> = [
        (vk::ShaderStageFlags::VERTEX, Some(vertex)),
        (vk::ShaderStageFlags::FRAGMENT, fragment),
    ]
    .into_iter()
    .filter_map(|(stage, module)| Some(stage_info(stage, module?)))
    .collect();
    let (bindings, attributes) = vertex_layout(info.attributes);
    let vertex_input = vk::PipelineVertexInputStateCreateInfo::default()
        .vertex_binding_descriptions(&bindings)
        .vertex_attribute_descriptions(&attributes);
    let assembly = vk::PipelineInputAssemblyStateCreateInfo::default()
        .topology(vk::PrimitiveTopology::TRIANGLE_LIST);
    let viewport = vk::PipelineViewportStateCreateInfo::default()
        .viewport_count(1)
        .scissor_count(1);
    let raster = rasterization(info.output);
    let multisample = vk::PipelineMultisampleStateCreateInfo::default()
        .rasterization_samples(info.targets.samples.vulkan());
    let depth = reversed_depth();
    let colors: Vec<_> = info.targets.color.iter().map(|c| c.vulkan()).collect();
    let attachments = vec![blending(info.output); colors.len()];
    let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments);
    let dynamic_states = [
        vk::DynamicState::VIEWPORT,
        vk::DynamicState::SCISSOR,
        vk::DynamicState::CULL_MODE,
    ];
    let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&dynamic_states);
    let mut rendering = vk::PipelineRenderingCreateInfo::default()
        .color_attachment_formats(&colors)
        .depth_attachment_format(info.targets.depth.vulkan());
    let pipeline = vk::GraphicsPipelineCreateInfo::default()
        .stages(&stages)
        .vertex_input_state(&vertex_input)
        .input_assembly_state(&assembly)
        .viewport_state(&viewport)
        .rasterization_state(&raster)
        .multisample_state(&multisample)
        .depth_stencil_state(&depth)
        .color_blend_state(&blend)
        .dynamic_state(&dynamic)
        .layout(layout.raw)
        .push_next(&mut rendering);
    // SAFETY: every pointer lives until the call returns; the driver synchronises the cache.
    let made = unsafe {
        device
            .raw
            .create_graphics_pipelines(cache.raw, &[pipeline], None)
    };
    match made {
        Ok(pipelines) => Ok(pipelines[0]),
        Err((_, result)) => Err(result).named("vkCreateGraphicsPipelines"),
    }
}

pub(super) fn stage_info(
    stage: vk::ShaderStageFlags,
    module: &Module,
) -> vk::PipelineShaderStageCreateInfo<'static> {
    vk::PipelineShaderStageCreateInfo::default()
        .stage(stage)
        .module(module.raw)
        .name(c"main")
}

fn vertex_layout(
    attributes: &[Attribute],
) -> (
    Vec<vk::VertexInputBindingDescription>,
    Vec<vk::VertexInputAttributeDescription>,
) {
    (0..)
        .zip(attributes)
        .map(|(binding, attribute)| {
            (
                vk::VertexInputBindingDescription::default()
                    .binding(binding)
                    .stride(match attribute.rate {
                        Rate::PerVertex => attribute.format.bytes(),
                        Rate::Constant => 0,
                    })
                    .input_rate(vk::VertexInputRate::VERTEX),
                vk::VertexInputAttributeDescription::default()
                    .location(attribute.location)
                    .binding(binding)
                    .format(attribute.format.vulkan()),
            )
        })
        .unzip()
}

/// Which faces are culled, each pass says.
fn rasterization(output: Output) -> vk::PipelineRasterizationStateCreateInfo<'static> {
    vk::PipelineRasterizationStateCreateInfo::default()
        .polygon_mode(vk::PolygonMode::FILL)
        .front_face(vk::FrontFace::COUNTER_CLOCKWISE)
        .rasterizer_discard_enable(output == Output::Discarded)
        .line_width(1.0)
}

fn reversed_depth() -> vk::PipelineDepthStencilStateCreateInfo<'static> {
    vk::PipelineDepthStencilStateCreateInfo::default()
        .depth_test_enable(true)
        .depth_write_enable(true)
        .depth_compare_op(vk::CompareOp::GREATER)
}

fn blending(output: Output) -> vk::PipelineColorBlendAttachmentState {
    vk::PipelineColorBlendAttachmentState::default()
        .blend_enable(output == Output::Blended)
        .src_color_blend_factor(vk::BlendFactor::ONE)
        .dst_color_blend_factor(vk::BlendFactor::ONE_MINUS_SRC_ALPHA)
        .color_blend_op(vk::BlendOp::ADD)
        .src_alpha_blend_factor(vk::BlendFactor::ONE)
        .dst_alpha_blend_factor(vk::BlendFactor::ONE_MINUS_SRC_ALPHA)
        .alpha_blend_op(vk::BlendOp::ADD)
        .color_write_mask(vk::ColorComponentFlags::RGBA)
}
