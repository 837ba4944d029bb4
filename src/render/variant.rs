//! Which published model does a pipeline hold, and which of its terms?

use std::fmt;

use crate::gpu::Constant;
use crate::interface::reflected::{constants, values};
use crate::reference::ladders::{Diffuse, Fresnel, Mix, Specular};
use crate::reference::shade::{Lighting, Terms};

/// What is fixed when a pipeline is made. All variants share source, layout and set.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Variant {
    /// The whole model.
    pub lighting: Lighting,
    /// The terms that count.
    pub terms: Terms,
}

impl Default for Variant {
    fn default() -> Self {
        Self {
            lighting: Lighting::CORRECTED,
            terms: Terms::ALL,
        }
    }
}

impl Variant {
    /// The tiers; a whole model has none, and those of the default serve.
    pub fn mix(&self) -> Mix {
        match self.lighting {
            Lighting::Mixed(mix) => mix,
            Lighting::Phong | Lighting::Slides => Mix::CORRECTED,
        }
    }

    /// The effects that lobes are, by the id of their constant, and whether a term counts them.
    pub fn lobes(&self) -> [(u32, bool); 3] {
        let Terms {
            diffuse, specular, ..
        } = self.terms;
        [
            (constants::EFFECT_DIFFUSE_LOBE, diffuse),
            (constants::EFFECT_ROUGH_DIFFUSE, diffuse),
            (constants::EFFECT_SPECULAR_LOBE, specular),
        ]
    }

    /// The specialization constants.
    pub fn constants(&self) -> [Constant; 7] {
        let lighting = match self.lighting {
            Lighting::Phong => values::LIGHTING_PHONG,
            Lighting::Slides => values::LIGHTING_SLIDES,
            Lighting::Mixed(_) => values::LIGHTING_MIXED,
        };
        let mix = self.mix();
        let Terms {
            ambient,
            diffuse,
            specular,
        } = self.terms;
        [
            (constants::LIGHTING, lighting),
            (constants::DIFFUSE, diffuse_value(mix.diffuse)),
            (constants::SPECULAR, specular_value(mix.specular)),
            (constants::FRESNEL, fresnel_value(mix.fresnel)),
            (constants::TERM_AMBIENT, i32::from(ambient)),
            (constants::TERM_DIFFUSE, i32::from(diffuse)),
            (constants::TERM_SPECULAR, i32::from(specular)),
        ]
        .map(|(id, value)| Constant { id, value })
    }
}

fn diffuse_value(tier: Diffuse) -> i32 {
    match tier {
        Diffuse::Slides => values::DIFFUSE_SLIDES,
        Diffuse::Lambert => values::DIFFUSE_LAMBERT,
        Diffuse::Qon => values::DIFFUSE_QON,
        Diffuse::Fon => values::DIFFUSE_FON,
        Diffuse::FullOrenNayar => values::DIFFUSE_FULL_OREN_NAYAR,
        Diffuse::Eon => values::DIFFUSE_EON,
    }
}

fn specular_value(tier: Specular) -> i32 {
    match tier {
        Specular::Slides => values::SPECULAR_SLIDES,
        Specular::BlinnPhong => values::SPECULAR_BLINN_PHONG,
        Specular::CookTorrance => values::SPECULAR_COOK_TORRANCE,
        Specular::BeckmannSmith => values::SPECULAR_BECKMANN_SMITH,
        Specular::BeckmannSmithExact => values::SPECULAR_BECKMANN_SMITH_EXACT,
        Specular::Ggx => values::SPECULAR_GGX,
        Specular::GgxMulti => values::SPECULAR_GGX_MULTI,
    }
}

fn fresnel_value(tier: Fresnel) -> i32 {
    match tier {
        Fresnel::Scale => values::FRESNEL_SCALE,
        Fresnel::Schlick => values::FRESNEL_SCHLICK,
        Fresnel::F82 => values::FRESNEL_F82,
        Fresnel::Dielectric => values::FRESNEL_DIELECTRIC,
        Fresnel::Conductor => values::FRESNEL_CONDUCTOR,
        Fresnel::Spectral => values::FRESNEL_SPECTRAL,
    }
}

impl fmt::Display for Variant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.lighting {
            Lighting::Mixed(mix) => write!(f, "{mix}")?,
            whole => write!(f, "{whole:?}")?,
        }
        let Terms {
            ambient,
            diffuse,
            specular,
        } = self.terms;
        for (name, on) in [
            ("ambient", ambient),
            ("diffuse", diffuse),
            ("specular", specular),
        ] {
            if !on {
                write!(f, ", no {name}")?;
            }
        }
        Ok(())
    }
}
