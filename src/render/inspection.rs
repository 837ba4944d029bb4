//! What was a pixel shaded from?
//!
//! The shading pass writes it in place of light: the same stages, the same numbers.

use std::fmt;

use crate::gpu::{Constant, Output};
use crate::interface::reflected::{constants, values};

/// What is written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Inspection {
    /// Light: the picture.
    #[default]
    Nothing,
    /// N, and the number of the material.
    NormalAndMaterial,
    /// E, and the roughness.
    EyeAndRoughness,
    /// L of the lamp of this number, and the largest channel of f0; -1 where nothing arrives from it.
    LightAndF0(u32),
    /// Where it is, and how open the place is to its surroundings, 0..1.
    PositionAndOpening,
    /// Diffuse reflectance.
    Albedo,
    /// Specular reflectance at normal incidence, as the pipeline's Fresnel term takes it.
    F0,
    /// Radiance given off.
    Emission,
    /// How much of the light of the lamp of this number comes through, 0..1.
    Shadow(u32),
}

impl Inspection {
    /// The specialization constants.
    pub(super) fn constants(self) -> [Constant; 2] {
        let (what, light) = match self {
            Self::Nothing => (values::INSPECT_NOTHING, 0),
            Self::NormalAndMaterial => (values::INSPECT_NORMAL, 0),
            Self::EyeAndRoughness => (values::INSPECT_EYE, 0),
            Self::LightAndF0(light) => (values::INSPECT_LIGHT, light),
            Self::PositionAndOpening => (values::INSPECT_POSITION, 0),
            Self::Albedo => (values::INSPECT_ALBEDO, 0),
            Self::F0 => (values::INSPECT_F0, 0),
            Self::Emission => (values::INSPECT_EMISSION, 0),
            Self::Shadow(light) => (values::INSPECT_SHADOW, light),
        };
        [
            (constants::INSPECTED, what),
            (constants::INSPECTED_LIGHT, light.cast_signed()),
        ]
        .map(|(id, value)| Constant { id, value })
    }

    /// Numbers are not blended.
    pub(super) fn output(self) -> Output {
        match self {
            Self::Nothing => Output::Blended,
            _ => Output::Replacing,
        }
    }
}

impl fmt::Display for Inspection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => Ok(()),
            _ => write!(f, "; {self:?}"),
        }
    }
}
