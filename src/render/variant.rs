//! Which published model does a pipeline hold, and which of its terms?

use std::fmt;

use crate::gpu::Constant;
use crate::interface::reflected::{constants, values};
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
            lighting: Lighting::Corrected,
            terms: Terms::ALL,
        }
    }
}

impl Variant {
    /// The specialization constants.
    pub fn constants(&self) -> [Constant; 4] {
        let lighting = match self.lighting {
            Lighting::Phong => values::LIGHTING_PHONG,
            Lighting::Slides => values::LIGHTING_SLIDES,
            Lighting::Corrected => values::LIGHTING_CORRECTED,
        };
        let Terms {
            ambient,
            diffuse,
            specular,
        } = self.terms;
        [
            (constants::LIGHTING, lighting),
            (constants::TERM_AMBIENT, i32::from(ambient)),
            (constants::TERM_DIFFUSE, i32::from(diffuse)),
            (constants::TERM_SPECULAR, i32::from(specular)),
        ]
        .map(|(id, value)| Constant { id, value })
    }
}

impl fmt::Display for Variant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "lighting={:?}", self.lighting)?;
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
