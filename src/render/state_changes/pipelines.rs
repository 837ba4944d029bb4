//! Which pipelines does a mode draw with?

use super::super::effects::{Build, EffectSet, Effects, States};
use super::super::geometry::Attributes;
use super::super::inspection::Inspection;
use super::super::maps::SIZE_CLASSES;
use super::super::pipelines::{PassKey, PipelineKey};
use super::super::uploaded::attributes;
use super::super::variant::Variant;
use super::mode::{Mode, Source};
use super::own::Own;
use super::stage::{Stage, without_pictures};
use crate::gpu::{Constant, Error, Output, Pipeline, PipelineCache, PipelineInfo, Samples, Spirv};
use crate::interface::reflected::constants;
use crate::interface::{Material, spirv};

/// The pipelines of a mode.
pub(super) struct ModePipelines {
    /// One, or one for each material.
    pub pipelines: Vec<Pipeline>,
    /// What they read of a vertex.
    pub attributes: Attributes,
    /// Whether faces may be seen from behind.
    pub two_sided: bool,
}

impl ModePipelines {
    /// Makes them.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(
        stage: &Stage,
        mode: &Mode,
        own: &Own,
        output: Output,
        cache: &PipelineCache,
    ) -> Result<Self, Error> {
        let effects = effects(mode.source);
        let attributes = Attributes {
            // The image that a draw has of its own lies on coordinates as well.
            coordinates: mode.source.has_pictures(),
            ..attributes(&stage.uploaded.census, effects.allowed)
        };
        let layout = own.pipeline_layout(stage)?;
        let make = |states: States, baked: &[Constant]| {
            let key = PipelineKey {
                pass: PassKey::Surface {
                    variant: Variant::default(),
                    inspection: Inspection::Nothing,
                    attributes,
                    samples: Samples::One,
                },
                states,
                map_classes: map_classes(stage, mode.source),
            };
            let device = &stage.renderer.device;
            let constants = key.constants(device.subpixel_bits());
            let info = PipelineInfo {
                name: &format!("{} {key}", mode.name),
                vertex: Spirv(spirv::SURFACE_VERT),
                fragment: Some(fragment(mode.source)),
                attributes: &key.inputs(),
                constants: &[&constants, baked].concat(),
                targets: key.targets(),
                output,
            };
            Pipeline::new(device, &layout, cache, &info)
        };
        let census = &stage.uploaded.census;
        let pipelines = match mode.source.is_baked() {
            false => vec![make(effects.states(census), &[])?],
            true => {
                let materials = stage.uploaded.scene.materials.iter();
                let records = stage.records(false).materials.iter();
                let states = materials.map(|m| effects.material_states(census, m));
                states
                    .zip(records)
                    .map(|(states, record)| make(states, &baked(record)))
                    .collect::<Result<_, _>>()?
            }
        };
        Ok(Self {
            pipelines,
            attributes,
            two_sided: effects.allowed.has_constant(constants::EFFECT_TWO_SIDED),
        })
    }
}

fn effects(source: Source) -> Effects {
    let (allowed, build) = match source {
        Source::RecordWithArray => (EffectSet::ALL, Build::Scene),
        Source::RecordOfAnyScene => (EffectSet::ALL, Build::Dynamic),
        Source::Baked | Source::BakedWithOwnSet => (without_pictures(), Build::Material),
        _ => (without_pictures(), Build::Scene),
    };
    Effects {
        allowed,
        build,
        ..Effects::default()
    }
}

fn map_classes(stage: &Stage, source: Source) -> i32 {
    match source {
        Source::RecordOfAnyScene => SIZE_CLASSES as i32,
        _ => stage.uploaded.maps.classes(),
    }
}

fn fragment(source: Source) -> Spirv {
    Spirv(match source {
        Source::Record | Source::RecordOfAnyScene | Source::RecordWithArray => spirv::SURFACE_FRAG,
        Source::RecordWithOwnImage => spirv::OWN_TEXTURE_FRAG,
        Source::Pushed => spirv::PUSHED_MATERIAL_FRAG,
        Source::Window | Source::OwnSet => spirv::BOUND_MATERIAL_FRAG,
        Source::Baked => spirv::BAKED_MATERIAL_FRAG,
        Source::BakedWithOwnSet => spirv::BAKED_BOUND_MATERIAL_FRAG,
    })
}

/// A material's numbers as constants.
fn baked(material: &Material) -> [Constant; 13] {
    let Material {
        albedo,
        opacity,
        f0,
        roughness,
        emission,
        shininess,
        effects,
        ..
    } = *material;
    let bits = |number: f32| number.to_bits().cast_signed();
    [
        (constants::BAKED_ALBEDO_R, bits(albedo[0])),
        (constants::BAKED_ALBEDO_G, bits(albedo[1])),
        (constants::BAKED_ALBEDO_B, bits(albedo[2])),
        (constants::BAKED_OPACITY, bits(opacity)),
        (constants::BAKED_F0_R, bits(f0[0])),
        (constants::BAKED_F0_G, bits(f0[1])),
        (constants::BAKED_F0_B, bits(f0[2])),
        (constants::BAKED_ROUGHNESS, bits(roughness)),
        (constants::BAKED_EMISSION_R, bits(emission[0])),
        (constants::BAKED_EMISSION_G, bits(emission[1])),
        (constants::BAKED_EMISSION_B, bits(emission[2])),
        (constants::BAKED_SHININESS, bits(shininess)),
        (constants::BAKED_EFFECTS, effects.cast_signed()),
    ]
    .map(|(id, value)| Constant { id, value })
}
