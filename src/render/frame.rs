//! What is made for one kind of frame, and what does drawing it take?

use std::sync::Arc;
use std::time::Instant;

use super::draw_list::TooMany;
use super::effects::{EffectSet, Effects};
use super::geometry::Geometry;
use super::inspection::Inspection;
use super::picture::Picture;
use super::plan::Plan;
use super::renderer::{RenderError, Renderer, Settings};
use super::scene_buffers::{Look, SceneBuffers};
use super::shading_pass::{Batch, Shading};
use super::shadow_maps::ShadowMaps;
use super::shadow_pass::ShadowPass;
use super::targets::Targets;
use super::uploaded::Uploaded;
use crate::gpu::{self, Buffer, DepthArray, DescriptorSet, PassCounts, Recorder, Timestamps};
use crate::interface::reflected::values;

/// What a frame took. Times in milliseconds, by the host's monotonic clock; `gpu_ms` by the device's.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct FrameReport {
    /// The effects that the scene calls for and the frame has.
    pub effects: Vec<&'static str>,
    /// Each pass, as the recorder counted it; the layers of a pass together.
    pub passes: Vec<PassCounts>,
    /// Pipelines made for this frame.
    pub pipelines_created: u64,
    /// Images made for it: targets, shadow maps; maps are made with the scene.
    pub images_created: u64,
    /// Making its pipelines and drawing one triangle with each, which is when some drivers compile; 0 for
    /// pipelines that were there.
    pub first_draw_ms: f64,
    /// Recording the frame.
    pub record_ms: f64,
    /// From its submission until the device is idle; the copy to the host included.
    pub submit_to_idle_ms: f64,
    /// Between the device's timestamps around its passes; absent where the queue has no clock.
    pub gpu_ms: Option<f64>,
}

impl FrameReport {
    /// Its time: the device's own, or the host's where the device has no clock; ms.
    pub fn ms(&self) -> f64 {
        self.gpu_ms.unwrap_or(self.submit_to_idle_ms)
    }
}

/// A frame that can be drawn again and again.
pub struct Frame<'s> {
    renderer: &'s Renderer,
    content: Content<'s>,
    readback: Buffer,
    effects: EffectSet,
    made: Made,
}

/// What its passes read and draw to.
struct Content<'s> {
    uploaded: &'s Uploaded<'s>,
    targets: Targets,
    set: DescriptorSet,
    batches: Vec<Batch>,
    shadow: Option<Shadow>,
}

/// Where its shadow maps come from.
enum Shadow {
    /// It draws them.
    Drawn(ShadowPass),
    /// Another frame drew them.
    Kept(Arc<DepthArray>),
}

impl Shadow {
    fn depths(&self) -> &Arc<DepthArray> {
        match self {
            Self::Drawn(pass) => &pass.depths,
            Self::Kept(depths) => depths,
        }
    }

    fn one_triangle(&self) -> Self {
        match self {
            Self::Drawn(pass) => Self::Drawn(pass.one_triangle()),
            Self::Kept(depths) => Self::Kept(Arc::clone(depths)),
        }
    }

    fn record<'r>(&'r self, recorder: &mut Recorder<'r>, geometry: &'r Geometry) {
        match self {
            Self::Drawn(pass) => pass.record(recorder, geometry),
            Self::Kept(depths) => recorder.keep(depths),
        }
    }
}

/// What was made for the frame.
#[derive(Clone, Copy, Default)]
struct Made {
    pipelines: u64,
    images: u64,
    first_draw_ms: f64,
}

impl<'s> Frame<'s> {
    /// Makes targets, records, shadow maps and pipelines.
    ///
    /// # Errors
    /// Size, sample count or scene are beyond the device, there is no memory, or the driver fails.
    pub fn new(
        renderer: &'s Renderer,
        uploaded: &'s Uploaded<'s>,
        settings: &Settings,
    ) -> Result<Self, RenderError> {
        Self::build(renderer, uploaded, settings, Inspection::Nothing, None)
    }

    /// A frame of the same scene and effects as `first`, under any model, that reads the shadow maps which `first` drew last: a
    /// still scene's next frame.
    ///
    /// # Errors
    /// As `new`.
    pub fn after(
        first: &Self,
        settings: &Settings,
        inspection: Inspection,
    ) -> Result<Self, RenderError> {
        let kept = first.content.shadow.as_ref().map(Shadow::depths);
        let uploaded = first.content.uploaded;
        Self::build(first.renderer, uploaded, settings, inspection, kept)
    }

    /// The same for a frame of numbers in place of light; one sample a pixel keeps them whole.
    ///
    /// # Errors
    /// As `new`.
    pub fn inspecting(
        renderer: &'s Renderer,
        uploaded: &'s Uploaded<'s>,
        settings: &Settings,
        inspection: Inspection,
    ) -> Result<Self, RenderError> {
        Self::build(renderer, uploaded, settings, inspection, None)
    }

    fn build(
        renderer: &'s Renderer,
        uploaded: &'s Uploaded<'s>,
        settings: &Settings,
        inspection: Inspection,
        kept: Option<&Arc<DepthArray>>,
    ) -> Result<Self, RenderError> {
        let device = &renderer.device;
        let images = device.images_created();
        let targets = Targets::new(device, settings.width, settings.height, settings.samples)?;
        let readback = targets.readback(device)?;
        let aspect = settings.width as f32 / settings.height as f32;
        let effects = &settings.effects;
        let shadows = shadow_maps(uploaded, effects, aspect)?;
        let look = Look {
            effects: *effects,
            mix: settings.variant.mix(),
        };
        let buffers = SceneBuffers::new(renderer, uploaded, aspect, &look, &shadows)
            .map_err(RenderError::of_scene)?;
        let depths = match (&shadows.maps[..], kept) {
            ([], _) => None,
            (_, Some(kept)) => Some(Arc::clone(kept)),
            (maps, None) => {
                let side = shadows.side();
                let depths = DepthArray::new(device, "shadow maps", side, maps.len() as u32);
                Some(Arc::new(depths.map_err(RenderError::of_scene)?))
            }
        };
        let set = buffers.set(renderer, depths.as_ref(), &uploaded.maps)?;
        let before = Instant::now();
        let pipelines = device.pipelines_created();
        let plan = Plan {
            pipelines: &renderer.pipelines,
            uploaded,
            settings,
            inspection,
        };
        let batches = plan.batches()?;
        let shadow = match (depths, kept) {
            (Some(depths), Some(_)) => Some(Shadow::Kept(depths)),
            (Some(depths), None) => {
                let set = Arc::new(buffers.set(renderer, None, &uploaded.maps)?);
                let pass = plan.shadow_pass(depths, set, shadows.draws)?;
                Some(Shadow::Drawn(pass))
            }
            (None, _) => None,
        };
        let mut frame = Self {
            renderer,
            content: Content {
                uploaded,
                targets,
                set,
                batches,
                shadow,
            },
            readback,
            effects: uploaded.census.called_for().and(effects.allowed),
            made: Made::default(),
        };
        frame.made.pipelines = device.pipelines_created() - pipelines;
        if frame.made.pipelines > 0 {
            frame.first_draws()?;
            frame.made.first_draw_ms = milliseconds_since(before);
            renderer.pipelines.save();
        }
        frame.made.images = device.images_created() - images;
        Ok(frame)
    }

    /// Draws the frame once and waits for it.
    ///
    /// # Errors
    /// The driver fails.
    pub fn draw(&mut self) -> Result<FrameReport, gpu::Error> {
        let device = &self.renderer.device;
        let timestamps = Timestamps::new(device)?;
        let passes = self.content.all();
        let before = Instant::now();
        let mut recorder = Recorder::new(device, "frame")?;
        match &timestamps {
            Some(stamps) => recorder.timed(stamps, |recorder| passes.record(recorder)),
            None => passes.record(&mut recorder),
        }
        self.content
            .targets
            .record_readback(&mut recorder, &mut self.readback);
        let recorded = recorder.finish()?;
        let record_ms = milliseconds_since(before);
        let before = Instant::now();
        let passes = recorded.submit()?;
        let submit_to_idle_ms = milliseconds_since(before);
        Ok(FrameReport {
            effects: self.effects.iter().map(|effect| effect.name).collect(),
            passes: by_name(passes),
            pipelines_created: self.made.pipelines,
            images_created: self.made.images,
            first_draw_ms: self.made.first_draw_ms,
            record_ms,
            submit_to_idle_ms,
            gpu_ms: timestamps.map(|stamps| stamps.elapsed_ms()).transpose()?,
        })
    }

    /// How many pipelines its pass `shading` binds.
    pub fn surface_pipelines(&self) -> usize {
        self.content.batches.len()
    }

    /// What the last `draw` left.
    ///
    /// # Errors
    /// The driver gave memory that the host cannot see, or there is none left for the picture.
    pub fn picture(&self) -> Result<Picture, gpu::Error> {
        self.content.targets.picture(&self.readback)
    }

    /// Draws one triangle with each pipeline, so that a driver which compiles at the first draw does it
    /// here and not in a frame that is timed.
    fn first_draws(&self) -> Result<(), gpu::Error> {
        let content = &self.content;
        let batches: Vec<_> = content.batches.iter().map(Batch::one_triangle).collect();
        let shadow = content.shadow.as_ref().map(Shadow::one_triangle);
        let passes = content.passes(&batches, shadow.as_ref());
        let mut recorder = Recorder::new(&self.renderer.device, "first draw")?;
        passes.record(&mut recorder);
        recorder.submit()?;
        Ok(())
    }
}

impl Content<'_> {
    fn all(&self) -> Passes<'_> {
        self.passes(&self.batches, self.shadow.as_ref())
    }

    fn passes<'a>(&'a self, batches: &'a [Batch], shadow: Option<&'a Shadow>) -> Passes<'a> {
        let shading = Shading {
            targets: &self.targets,
            batches,
            set: &self.set,
            geometry: &self.uploaded.geometry,
            reads: shadow
                .map(|shadow| &**shadow.depths())
                .into_iter()
                .collect(),
        };
        Passes { shadow, shading }
    }
}

/// The passes of a frame, in their order.
struct Passes<'a> {
    shadow: Option<&'a Shadow>,
    shading: Shading<'a>,
}

impl Passes<'_> {
    fn record<'r>(&'r self, recorder: &mut Recorder<'r>) {
        if let Some(shadow) = self.shadow {
            shadow.record(recorder, self.shading.geometry);
        }
        self.shading.record(recorder);
    }
}

fn shadow_maps(uploaded: &Uploaded, effects: &Effects, aspect: f32) -> Result<ShadowMaps, TooMany> {
    ShadowMaps::new(uploaded.scene, &uploaded.list, aspect, |light| {
        effects.light_bits(light) & values::BIT_SHADOW != 0
    })
}

/// The layers of a pass as one row.
fn by_name(passes: Vec<PassCounts>) -> Vec<PassCounts> {
    let mut rows: Vec<PassCounts> = Vec::new();
    for pass in passes {
        match rows.last_mut() {
            Some(row) if row.name == pass.name => {
                row.draws += pass.draws;
                row.pipeline_binds += pass.pipeline_binds;
                row.descriptor_set_binds += pass.descriptor_set_binds;
                row.push_constants += pass.push_constants;
                row.cull_changes += pass.cull_changes;
            }
            _ => rows.push(pass),
        }
    }
    rows
}

fn milliseconds_since(before: Instant) -> f64 {
    before.elapsed().as_secs_f64() * 1e3
}
