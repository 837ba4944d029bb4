//! Which pipelines draw what?

use std::sync::Arc;

use super::draw_list::Draw;
use super::effects::{Build, States};
use super::geometry::Attributes;
use super::inspection::Inspection;
use super::maps::SIZE_CLASSES;
use super::pipelines::{PassKey, PipelineKey, Pipelines};
use super::renderer::Settings;
use super::shading_pass::Batch;
use super::shadow_pass::ShadowPass;
use super::uploaded::{Uploaded, attributes};
use crate::gpu::{DepthArray, DescriptorSet, Error};
use crate::interface::reflected::constants;

/// A frame whose pipelines are to be chosen.
pub struct Plan<'a> {
    /// Where they come from.
    pub pipelines: &'a Pipelines,
    /// What is drawn.
    pub uploaded: &'a Uploaded<'a>,
    /// How.
    pub settings: &'a Settings,
    /// What is written.
    pub inspection: Inspection,
}

impl Plan<'_> {
    /// The draws of the pass `shading`.
    ///
    /// # Errors
    /// The driver fails.
    pub fn batches(&self) -> Result<Vec<Batch>, Error> {
        let draws = &self.uploaded.list.draws;
        match self.settings.effects.build {
            Build::Dynamic | Build::Scene => {
                let states = self.settings.effects.states(&self.uploaded.census);
                Ok(vec![self.batch(states, draws.clone())?])
            }
            Build::Material => self
                .by_material(draws)
                .into_iter()
                .map(|(states, draws)| self.batch(states, draws))
                .collect(),
        }
    }

    fn batch(&self, states: States, draws: Vec<Draw>) -> Result<Batch, Error> {
        let Settings {
            variant,
            samples,
            effects,
            ..
        } = *self.settings;
        let attributes = attributes(&self.uploaded.census, effects.allowed);
        let pipeline = self.pipelines.get(PipelineKey {
            pass: PassKey::Surface {
                variant,
                inspection: self.inspection,
                attributes,
                samples,
            },
            states,
            map_classes: self.map_classes(),
        })?;
        Ok(Batch {
            pipeline,
            attributes,
            two_sided: effects.allowed.has_constant(constants::EFFECT_TWO_SIDED),
            draws,
        })
    }

    /// Any scene's, or this one's.
    fn map_classes(&self) -> i32 {
        match self.settings.effects.build {
            Build::Dynamic => SIZE_CLASSES as i32,
            Build::Scene | Build::Material => self.uploaded.maps.classes(),
        }
    }

    /// Opaque draws together where their materials call for the same; what lets light through keeps its
    /// order, far to near, and may have to switch.
    fn by_material(&self, draws: &[Draw]) -> Vec<(States, Vec<Draw>)> {
        let Uploaded { scene, census, .. } = self.uploaded;
        let material = |draw: &Draw| scene.objects[draw.instance as usize].material;
        let states: Vec<_> = scene
            .materials
            .iter()
            .map(|material| self.settings.effects.material_states(census, material))
            .collect();
        let mut groups: Vec<(States, Vec<Draw>)> = Vec::new();
        let (opaque, transparent): (Vec<_>, Vec<_>) = draws
            .iter()
            .partition(|draw| scene.materials[material(draw)].opacity >= 1.0);
        for draw in opaque {
            let states = states[material(draw)];
            match groups.iter_mut().find(|(known, _)| *known == states) {
                Some((_, draws)) => draws.push(draw.clone()),
                None => groups.push((states, vec![draw.clone()])),
            }
        }
        for draw in transparent {
            let states = states[material(draw)];
            match groups.last_mut() {
                Some((known, draws)) if *known == states => draws.push(draw.clone()),
                _ => groups.push((states, vec![draw.clone()])),
            }
        }
        groups
    }

    /// The pass `shadow`.
    ///
    /// # Errors
    /// The driver fails.
    pub fn shadow_pass(
        &self,
        depths: Arc<DepthArray>,
        set: Arc<DescriptorSet>,
        draws: Vec<Vec<Draw>>,
    ) -> Result<ShadowPass, Error> {
        let Settings { effects, .. } = self.settings;
        let states = effects.states(&self.uploaded.census);
        let masked = !states.is_off(constants::EFFECT_ALPHA_MASK);
        let attributes = Attributes {
            coordinates: masked && attributes(&self.uploaded.census, effects.allowed).coordinates,
            tangents: false,
        };
        let key = PipelineKey {
            pass: PassKey::Shadow { masked, attributes },
            states: states.only(constants::EFFECT_ALPHA_MASK),
            map_classes: self.map_classes(),
        };
        Ok(ShadowPass {
            depths,
            set,
            pipeline: self.pipelines.get(key)?,
            attributes,
            draws,
        })
    }
}
