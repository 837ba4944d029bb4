//! How far is a model's picture of a scene from the reference picture, to a person, and how long does its frame take?

use super::reference_picture::reference_picture;
use crate::gpu::Samples;
use crate::reference::ladders::Mix;
use crate::reference::shade::{Lighting, Terms};
use crate::render::effects::Effects;
use crate::render::{
    Frame, FrameReport, Inspection, Picture, RenderError, Renderer, Settings, ToneMapping,
    Uploaded, Variant,
};
use crate::scene::Scene;
use crate::studies::difference::{Compared, Display, NoDifference, Seen, difference};

/// Nothing lets light through: then each pixel has one surface, and its reference one value. Panes and glasses look dark.
pub fn made_opaque(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    for material in &mut scene.materials {
        material.opacity = 1.0;
    }
    scene
}

/// A scene, ready to be looked at under any model.
pub struct Sight<'u> {
    /// Whose shadow maps the others keep.
    first: Frame<'u>,
    settings: Settings,
    display: Display,
    reference: Picture,
}

/// What was seen of a model.
#[derive(Clone, Debug)]
pub struct Look {
    /// Mean of FLIP over the picture.
    pub flip_mean: f64,
    /// The least that 95 % of the pixels do not exceed.
    pub flip_p95: f64,
    /// The largest difference of an sRGB code.
    pub code_max: f64,
    /// The mean absolute difference of linear radiance, over the mean radiance.
    pub radiance_error: f64,
    /// Making the pipeline and the first triangle.
    pub first_draw_ms: f64,
    /// The picture.
    pub picture: Picture,
}

/// Why a scene cannot be looked at.
#[derive(Debug, thiserror::Error)]
pub enum SightError {
    /// It cannot be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// A picture holds what is no number.
    #[error(transparent)]
    Difference(#[from] NoDifference),
}

impl From<crate::gpu::Error> for SightError {
    fn from(error: crate::gpu::Error) -> Self {
        Self::Render(error.into())
    }
}

impl<'u> Sight<'u> {
    /// A sight of a scene that `made_opaque` gave, at one sample a pixel; the reference picture is shaded.
    ///
    /// # Errors
    /// The scene is beyond the device, there is no memory, or the driver fails.
    pub fn new(
        renderer: &'u Renderer,
        uploaded: &'u Uploaded<'u>,
        scene: &Scene,
        (width, height): (u32, u32),
    ) -> Result<Self, RenderError> {
        let settings = Settings {
            width,
            height,
            samples: Samples::One,
            variant: Variant {
                lighting: Lighting::Mixed(Mix::BEST),
                terms: Terms::ALL,
            },
            effects: Effects::default(),
        };
        let mut first = Frame::new(renderer, uploaded, &settings)?;
        first.draw()?;
        let reference = reference_picture(&first, scene, &settings)?;
        Ok(Self {
            first,
            settings,
            display: Display {
                ev100: scene.camera.exposure_ev100,
                tone_mapping: ToneMapping::Neutral,
            },
            reference,
        })
    }

    /// The picture that all are held against.
    pub fn reference(&self) -> &Picture {
        &self.reference
    }

    /// How a picture is shown.
    pub fn display(&self) -> Display {
        self.display
    }

    /// A frame of a model, on shadow maps that were drawn before.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn frame(&self, lighting: Lighting) -> Result<Frame<'u>, RenderError> {
        let variant = Variant {
            lighting,
            terms: Terms::ALL,
        };
        let settings = Settings {
            variant,
            ..self.settings
        };
        Frame::after(&self.first, &settings, Inspection::Nothing)
    }

    /// Looks at what a frame drew last. Pixels that are no number are looked at as black.
    ///
    /// # Errors
    /// There is no memory for the picture.
    pub fn look(&self, frame: &Frame, report: &FrameReport) -> Result<Look, SightError> {
        let picture = without_holes(frame.picture()?);
        let seen = [&picture, &self.reference].map(|picture| Seen::Linear(picture.clone()));
        let [ours, truth] = &seen;
        let Compared { row, .. } = difference(ours, truth, self.display)?;
        let mean = mean(&self.reference);
        Ok(Look {
            flip_mean: row.flip.mean,
            flip_p95: row.flip.p95,
            code_max: row.codes.gap.largest,
            radiance_error: row
                .linear
                .map_or(f64::NAN, |gap| gap.mean / mean.max(f64::MIN_POSITIVE)),
            first_draw_ms: report.first_draw_ms,
            picture,
        })
    }
}

/// The slides' listings leave holes; a screen shows them black.
fn without_holes(mut picture: Picture) -> Picture {
    for pixel in &mut picture.pixels {
        if pixel.iter().any(|value| !value.is_finite()) {
            *pixel = [0.0, 0.0, 0.0, 1.0];
        }
    }
    picture
}

/// Of all three channels.
fn mean(picture: &Picture) -> f64 {
    let sum: f64 = picture
        .pixels
        .iter()
        .flat_map(|[r, g, b, _]| [r, g, b])
        .map(|value| f64::from(*value))
        .sum();
    sum / (3 * picture.pixels.len()).max(1) as f64
}
