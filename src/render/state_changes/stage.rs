//! What do all modes share that draw one scene?

use super::super::draw_list::Draw;
use super::super::effects::{EffectSet, Effects};
use super::super::renderer::{RenderError, Renderer};
use super::super::scene_buffers::{Look, SceneBuffers};
use super::super::shadow_maps::ShadowMaps;
use super::super::uploaded::Uploaded;
use crate::gpu::DescriptorSet;
use crate::interface;
use crate::interface::reflected::constants;
use crate::reference::ladders::Mix;
use crate::scene::Scene;

/// A scene on the device, in the order in which it is drawn.
pub struct Stage<'s> {
    pub(super) renderer: &'s Renderer,
    pub(super) uploaded: Uploaded<'s>,
    /// The draws, each with its material's number.
    pub(super) draws: Vec<(Draw, u32)>,
    plain: Records,
    pictured: Option<Records>,
}

/// The one set, and the materials' records in it.
pub(super) struct Records {
    pub set: DescriptorSet,
    pub materials: Vec<interface::Material>,
}

impl<'s> Stage<'s> {
    /// Uploads a scene that is seen in a picture of this size.
    ///
    /// # Errors
    /// The scene is beyond the device, there is no memory, or the driver fails.
    pub fn new(
        renderer: &'s Renderer,
        scene: &'s Scene,
        (width, height): (u32, u32),
    ) -> Result<Self, RenderError> {
        let uploaded = Uploaded::new(renderer, scene, EffectSet::ALL)?;
        let aspect = width as f32 / height as f32;
        let material = |draw: &Draw| scene.objects[draw.instance as usize].material;
        let draws = uploaded.list.draws.iter();
        // A scene has fewer materials than objects, and those are counted in u32.
        let draws = draws.map(|draw| (draw.clone(), material(draw) as u32));
        let pictured = (!scene.textures.is_empty())
            .then(|| Records::new(renderer, &uploaded, aspect, EffectSet::ALL))
            .transpose()?;
        Ok(Self {
            renderer,
            draws: draws.collect(),
            plain: Records::new(renderer, &uploaded, aspect, without_pictures())?,
            pictured,
            uploaded,
        })
    }

    /// The records for modes in which materials have pictures, or in which they have none.
    pub(super) fn records(&self, pictures: bool) -> &Records {
        match &self.pictured {
            Some(pictured) if pictures => pictured,
            _ => &self.plain,
        }
    }

    /// Whether materials have pictures.
    pub fn has_pictures(&self) -> bool {
        self.pictured.is_some()
    }

    /// Whether something lets light through.
    pub fn has_glass(&self) -> bool {
        let mut materials = self.uploaded.scene.materials.iter();
        materials.any(|material| material.opacity < 1.0)
    }
}

impl Records {
    fn new(
        renderer: &Renderer,
        uploaded: &Uploaded,
        aspect: f32,
        allowed: EffectSet,
    ) -> Result<Self, RenderError> {
        let look = Look {
            effects: Effects {
                allowed,
                ..Effects::default()
            },
            mix: Mix::CORRECTED,
        };
        let shadows = ShadowMaps::new(uploaded.scene, &uploaded.list, aspect, |_| false)?;
        let buffers = SceneBuffers::new(renderer, uploaded, aspect, &look, &shadows)
            .map_err(RenderError::of_scene)?;
        let materials = uploaded.scene.materials.iter();
        let record = |material| look.record(material, &uploaded.maps);
        Ok(Self {
            set: buffers.set(renderer, None, &uploaded.maps)?,
            materials: materials.map(record).collect(),
        })
    }
}

/// All effects but the pictures of the modes that are about them.
pub(super) fn without_pictures() -> EffectSet {
    EffectSet::ALL.without_constant(constants::EFFECT_BASE_COLOR_MAP)
}
