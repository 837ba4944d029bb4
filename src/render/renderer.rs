//! How does a scene become a picture, and what did that take?

use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use super::draw_list::{Draw, TooMany, draw_list};
use super::picture::Picture;
use super::scene_buffers::{BINDINGS, SceneBuffers};
use super::shading_pass::Shading;
use super::targets::Targets;
use super::variant::Variant;
use crate::gpu::{
    self, Attribute, Buffer, Cull, Device, PassCounts, Pipeline, PipelineCache, PipelineInfo, Rate,
    Recorder, Samples, SetLayout, Spirv, Timestamps, VertexFormat, requirements,
};
use crate::interface::reflected::vertex_inputs;
use crate::interface::spirv;
use crate::scene::Scene;

const ATTRIBUTES: [Attribute; 2] = [
    Attribute {
        location: vertex_inputs::in_position,
        format: VertexFormat::Rgb32Float,
        rate: Rate::PerVertex,
    },
    Attribute {
        location: vertex_inputs::in_normal,
        format: VertexFormat::Rgb32Float,
        rate: Rate::PerVertex,
    },
];

/// How large, how smooth, and by which published model.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Settings {
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Samples a pixel.
    pub samples: Samples,
    /// Lighting model and terms.
    pub variant: Variant,
}

/// What a frame took. Times in milliseconds, by the host's monotonic clock; `gpu_ms` by the device's.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct FrameReport {
    /// Each pass, as the recorder counted it.
    pub passes: Vec<PassCounts>,
    /// Pipelines made for this frame.
    pub pipelines_created: u64,
    /// Making the pipeline and drawing one triangle with it, which is when some drivers compile; 0 for
    /// a pipeline that was there.
    pub first_draw_ms: f64,
    /// Recording the frame.
    pub record_ms: f64,
    /// From its submission until the device is idle; the copy to the host included.
    pub submit_to_idle_ms: f64,
    /// Between the device's timestamps around its passes; absent where the queue has no clock.
    pub gpu_ms: Option<f64>,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device cannot, or cannot at this size.
    #[error(transparent)]
    Gpu(#[from] gpu::Error),
    /// The scene is beyond the device.
    #[error("the scene is too large: {0}")]
    Scene(gpu::Error),
    /// The scene is beyond any device.
    #[error(transparent)]
    TooMany(#[from] TooMany),
}

impl RenderError {
    /// What went wrong while the scene was uploaded: a limit that it passes is the scene's own fault.
    fn of_scene(error: gpu::Error) -> Self {
        match error {
            gpu::Error::BeyondLimit { .. } | gpu::Error::Memory { .. } => Self::Scene(error),
            error => Self::Gpu(error),
        }
    }
}

/// The device, the layout that all its pipelines share, and the pipelines made so far.
pub struct Renderer {
    device: Arc<Device>,
    layout: Arc<SetLayout>,
    cache: PipelineCache,
    pipelines: Mutex<Vec<(PipelineKey, Arc<Pipeline>)>>,
}

/// What tells one pipeline from another; never a material.
type PipelineKey = (Variant, Samples);

impl Renderer {
    /// A renderer on `device`. Compiled pipelines are kept in `cache_folder`, if there is one.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(device: &Arc<Device>, cache_folder: Option<&Path>) -> Result<Self, gpu::Error> {
        Ok(Self {
            layout: SetLayout::new(device, "the set", &BINDINGS)?,
            cache: PipelineCache::open(device, cache_folder)?,
            pipelines: Mutex::default(),
            device: Arc::clone(device),
        })
    }

    /// The device.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Renders one frame.
    ///
    /// # Errors
    /// Size, sample count or scene are beyond the device, there is no memory, or the driver fails.
    pub fn render(
        &self,
        scene: &Scene,
        settings: &Settings,
    ) -> Result<(Picture, FrameReport), RenderError> {
        let Settings {
            width,
            height,
            samples,
            variant,
        } = *settings;
        let list = draw_list(scene)?;
        let targets = Targets::new(&self.device, width, height, samples)?;
        let mut readback = targets.readback(&self.device)?;
        let aspect = width as f32 / height as f32;
        let buffers =
            SceneBuffers::new(&self.device, scene, &list, aspect).map_err(RenderError::of_scene)?;
        let set = buffers.set(&self.layout)?;
        let before = Instant::now();
        let pipelines_before = self.device.pipelines_created();
        let (pipeline, is_new) = self.pipeline(variant, samples)?;
        let shading = Shading {
            targets: &targets,
            pipeline: &pipeline,
            set: &set,
            scene: &buffers,
        };
        if is_new {
            self.first_draw(&shading, &list.draws)?;
        }
        let first_draw_ms = milliseconds_since(before);
        if is_new {
            self.cache.save();
        }
        let report = FrameReport {
            pipelines_created: self.device.pipelines_created() - pipelines_before,
            first_draw_ms,
            ..self.frame(&shading, &list.draws, &mut readback)?
        };
        Ok((targets.picture(&readback)?, report))
    }

    /// The pipeline of a variant, and whether it was made just now.
    fn pipeline(
        &self,
        variant: Variant,
        samples: Samples,
    ) -> Result<(Arc<Pipeline>, bool), gpu::Error> {
        let key = (variant, samples);
        let mut pipelines = self
            .pipelines
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        if let Some((_, pipeline)) = pipelines.iter().find(|(known, _)| *known == key) {
            return Ok((Arc::clone(pipeline), false));
        }
        let info = PipelineInfo {
            name: &format!("surface[{variant}]"),
            vertex: Spirv(spirv::SURFACE_VERT),
            fragment: Some(Spirv(spirv::SURFACE_FRAG)),
            attributes: &ATTRIBUTES,
            constants: &variant.constants(),
            targets: gpu::Targets {
                color: Some(requirements::COLOR),
                depth: requirements::DEPTH,
                samples,
            },
            cull: Cull::None,
        };
        let pipeline = Pipeline::new(&self.device, &self.layout, &self.cache, &info)?;
        let pipeline = Arc::new(pipeline);
        pipelines.push((key, Arc::clone(&pipeline)));
        Ok((pipeline, true))
    }

    /// Draws one triangle, so that a driver which compiles at the first draw does it here and not in
    /// the frame that is timed.
    fn first_draw(&self, shading: &Shading, draws: &[Draw]) -> Result<(), gpu::Error> {
        let Some(draw) = draws.iter().find(|draw| draw.indices.len() >= 3) else {
            return Ok(());
        };
        let mut triangle = draw.clone();
        triangle.indices.end = triangle.indices.start + 3;
        let mut recorder = Recorder::new(&self.device, "first draw")?;
        shading.record(&mut recorder, &[triangle]);
        recorder.submit()?;
        Ok(())
    }

    fn frame(
        &self,
        shading: &Shading,
        draws: &[Draw],
        readback: &mut Buffer,
    ) -> Result<FrameReport, gpu::Error> {
        let timestamps = Timestamps::new(&self.device)?;
        let before = Instant::now();
        let mut recorder = Recorder::new(&self.device, "frame")?;
        match &timestamps {
            Some(stamps) => recorder.timed(stamps, |recorder| shading.record(recorder, draws)),
            None => shading.record(&mut recorder, draws),
        }
        shading.targets.record_readback(&mut recorder, readback);
        let recorded = recorder.finish()?;
        let record_ms = milliseconds_since(before);
        let before = Instant::now();
        let passes = recorded.submit()?;
        let submit_to_idle_ms = milliseconds_since(before);
        Ok(FrameReport {
            passes,
            pipelines_created: 0,
            first_draw_ms: 0.0,
            record_ms,
            submit_to_idle_ms,
            gpu_ms: timestamps.map(|stamps| stamps.elapsed_ms()).transpose()?,
        })
    }
}

fn milliseconds_since(before: Instant) -> f64 {
    before.elapsed().as_secs_f64() * 1e3
}
