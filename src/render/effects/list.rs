//! Which effects are there, and by what rule does a scene call for each?

use crate::interface::reflected::{constants, values};
use crate::scene::{Light, LightKind, Material, Slot};

/// Something that a frame can do, and that costs nothing where nobody calls for it.
#[derive(Clone, Copy)]
pub struct Effect {
    /// What `--effects` and tables call it; its file is `shaders-glsl/effects/NAME.glsl`, with `_` for `-`.
    pub name: &'static str,
    /// Id of its specialization constant.
    pub constant: u32,
    /// Whose records carry its bit, and the rule by which they call for it.
    pub(super) rule: Rule,
    /// Whether it is the identity for a record that does not call for it, and cheaper to do than to ask about: with
    /// one caller, all have it.
    pub(super) harmless: bool,
    /// What it needs beside its code.
    pub needs: &'static [Need],
}

/// The records that call for an effect, each by a bit in its word `effects`.
#[derive(Clone, Copy)]
pub(super) enum Rule {
    /// Materials for which the function is true.
    Material(u32, fn(&Material) -> bool),
    /// Lights for which it is.
    Light(u32, fn(&Light) -> bool),
}

/// What is made only for effects that need it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Need {
    /// Texture coordinates, and the sampler of maps.
    Coordinates,
    /// Tangents.
    Tangents,
    /// The arrays that hold the maps of a slot.
    Maps(Slot),
    /// The pass `shadow` and what it draws to.
    ShadowMaps,
}

/// Every effect, in the order of their constants.
pub const ALL: [Effect; 17] = [
    Effect::of_material(
        "diffuse-lobe",
        constants::EFFECT_DIFFUSE_LOBE,
        values::BIT_DIFFUSE_LOBE,
        |material| reflects(material.albedo),
    ),
    Effect::of_material(
        "specular-lobe",
        constants::EFFECT_SPECULAR_LOBE,
        values::BIT_SPECULAR_LOBE,
        |material| reflects(material.f0) || may_be_metal(material),
    ),
    Effect {
        harmless: true,
        ..Effect::of_material(
            "rough-diffuse",
            constants::EFFECT_ROUGH_DIFFUSE,
            values::BIT_ROUGH_DIFFUSE,
            |material| reflects(material.albedo) && material.roughness > 0.0,
        )
    },
    Effect {
        harmless: true,
        ..Effect::of_material(
            "colored-f0",
            constants::EFFECT_COLORED_F0,
            values::BIT_COLORED_F0,
            |material| {
                let [r, g, b] = material.f0;
                r != g || g != b
            },
        )
    },
    Effect {
        harmless: true,
        ..Effect::of_material(
            "emission",
            constants::EFFECT_EMISSION,
            values::BIT_EMISSION,
            |material| reflects(material.emission),
        )
    },
    Effect {
        harmless: true,
        ..Effect::of_material(
            "transparency",
            constants::EFFECT_TRANSPARENCY,
            values::BIT_TRANSPARENCY,
            |material| material.opacity < 1.0,
        )
    },
    // One-sided faces are never seen from behind: the rasteriser drops them, draw by draw.
    Effect {
        harmless: true,
        ..Effect::of_material(
            "two-sided",
            constants::EFFECT_TWO_SIDED,
            values::BIT_TWO_SIDED,
            |material| material.two_sided,
        )
    },
    Effect::of_light(
        "point-light",
        constants::EFFECT_POINT_LIGHT,
        values::BIT_POINT_LIGHT,
        |light| !matches!(light.kind, LightKind::Directional { .. }),
    ),
    Effect::of_light(
        "spot-light",
        constants::EFFECT_SPOT_LIGHT,
        values::BIT_SPOT_LIGHT,
        |light| matches!(light.kind, LightKind::Spot { .. }),
    ),
    Effect {
        needs: &[Need::Coordinates, Need::Maps(Slot::BaseColor)],
        ..Effect::of_material(
            "base-color-map",
            constants::EFFECT_BASE_COLOR_MAP,
            values::BIT_BASE_COLOR_MAP,
            |material| material.maps.base_color.is_some() && reflects(material.albedo),
        )
    },
    Effect {
        needs: &[Need::Coordinates, Need::Maps(Slot::Roughness)],
        ..Effect::of_material(
            "roughness-map",
            constants::EFFECT_ROUGHNESS_MAP,
            values::BIT_ROUGHNESS_MAP,
            |material| material.maps.roughness.is_some() && material.roughness > 0.0,
        )
    },
    Effect {
        needs: &[Need::Coordinates, Need::Maps(Slot::Metalness)],
        ..Effect::of_material(
            "metalness-map",
            constants::EFFECT_METALNESS_MAP,
            values::BIT_METALNESS_MAP,
            may_be_metal,
        )
    },
    Effect {
        needs: &[Need::Coordinates, Need::Tangents, Need::Maps(Slot::Normal)],
        ..Effect::of_material(
            "normal-map",
            constants::EFFECT_NORMAL_MAP,
            values::BIT_NORMAL_MAP,
            |material| material.maps.normal.is_some() && material.normal_scale > 0.0,
        )
    },
    Effect {
        needs: &[Need::Coordinates, Need::Maps(Slot::Emission)],
        ..Effect::of_material(
            "emission-map",
            constants::EFFECT_EMISSION_MAP,
            values::BIT_EMISSION_MAP,
            |material| material.maps.emission.is_some() && reflects(material.emission),
        )
    },
    Effect {
        needs: &[Need::Coordinates, Need::Maps(Slot::Occlusion)],
        ..Effect::of_material(
            "occlusion-map",
            constants::EFFECT_OCCLUSION_MAP,
            values::BIT_OCCLUSION_MAP,
            |material| material.maps.occlusion.is_some(),
        )
    },
    Effect {
        needs: &[Need::Coordinates, Need::Maps(Slot::AlphaMask)],
        ..Effect::of_material(
            "alpha-mask",
            constants::EFFECT_ALPHA_MASK,
            values::BIT_ALPHA_MASK,
            |material| material.maps.alpha_mask.is_some() && material.alpha_cutoff > 0.0,
        )
    },
    Effect {
        needs: &[Need::ShadowMaps],
        ..Effect::of_light(
            "shadow",
            constants::EFFECT_SHADOW,
            values::BIT_SHADOW,
            |light| light.shadow && shines(light),
        )
    },
];

impl Effect {
    const fn of_material(
        name: &'static str,
        constant: u32,
        bit: u32,
        by: fn(&Material) -> bool,
    ) -> Self {
        Self::new(name, constant, Rule::Material(bit, by))
    }

    const fn of_light(name: &'static str, constant: u32, bit: u32, by: fn(&Light) -> bool) -> Self {
        Self::new(name, constant, Rule::Light(bit, by))
    }

    const fn new(name: &'static str, constant: u32, rule: Rule) -> Self {
        Self {
            name,
            constant,
            rule,
            harmless: false,
            needs: &[],
        }
    }
}

/// Whether a reflectance or radiance is more than nothing.
fn reflects(color: [f32; 3]) -> bool {
    color.iter().any(|channel| *channel > 0.0)
}

fn shines(light: &Light) -> bool {
    let strength = match light.kind {
        LightKind::Directional { illuminance, .. } => illuminance,
        LightKind::Point { intensity, .. } | LightKind::Spot { intensity, .. } => intensity,
    };
    strength > 0.0 && reflects(light.color)
}

fn may_be_metal(material: &Material) -> bool {
    material.maps.metalness.is_some() && material.metalness > 0.0
}
