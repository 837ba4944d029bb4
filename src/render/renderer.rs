//! How does a scene become a picture?

use std::path::Path;
use std::sync::Arc;

use super::draw_list::TooMany;
use super::effects::Effects;
use super::frame::{Frame, FrameReport};
use super::picture::Picture;
use super::pipelines::Pipelines;
use super::placeholders::Placeholders;
use super::scene_buffers::BINDINGS;
use super::uploaded::Uploaded;
use super::variant::Variant;
use crate::gpu::{self, Device, PipelineLayout, Samples, SetLayout};
use crate::scene::Scene;

/// How large, how smooth, by which published model, with which effects.
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
    /// What the frame may contain.
    pub effects: Effects,
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
    pub(super) fn of_scene(error: gpu::Error) -> Self {
        match error {
            gpu::Error::BeyondLimit { .. } | gpu::Error::Memory { .. } => Self::Scene(error),
            error => Self::Gpu(error),
        }
    }
}

/// The device, the layout of the one set, and what is made once for all scenes.
pub struct Renderer {
    pub(super) device: Arc<Device>,
    pub(super) layout: Arc<SetLayout>,
    pub(super) pipelines: Pipelines,
    pub(super) placeholders: Placeholders,
}

impl Renderer {
    /// A renderer on `device`. Compiled pipelines are kept in `cache_folder`, if there is one.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(device: &Arc<Device>, cache_folder: Option<&Path>) -> Result<Self, gpu::Error> {
        let layout = SetLayout::new(device, "the set", &BINDINGS)?;
        let pipeline_layout = PipelineLayout::new(device, "one set", &[&layout], 0)?;
        Ok(Self {
            pipelines: Pipelines::new(device, &pipeline_layout, cache_folder)?,
            placeholders: Placeholders::new(device)?,
            layout,
            device: Arc::clone(device),
        })
    }

    /// The device.
    pub fn device(&self) -> &Arc<Device> {
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
        // Before the scene is uploaded: a size that the device cannot have is not the scene's fault.
        self.device
            .check_target_size(settings.width, settings.height)?;
        let uploaded = Uploaded::new(self, scene, settings.effects.allowed)?;
        let mut frame = Frame::new(self, &uploaded, settings)?;
        let report = frame.draw()?;
        Ok((frame.picture()?, report))
    }
}
