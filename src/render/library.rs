//! Which lighting functions does the library have, and what do they take and give?

use crate::interface::reflected::values;
use crate::scene::suggest;

/// With how much arithmetic a function is evaluated.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Tier {
    /// 16-bit floats, for what survives them. Emulated: every operation is rounded to a half float, which shows what is
    /// left and not what is saved.
    F16,
    /// 32-bit floats, as every frame is shaded.
    F32,
    /// The same, but dot and cross products of the directions keep the digits that 32 bits round away.
    F32Compensated,
}

impl Tier {
    /// All, the cheapest first.
    pub const ALL: [Self; 3] = [Self::F16, Self::F32, Self::F32Compensated];

    /// What rows and the command line call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::F16 => "f16",
            Self::F32 => "f32",
            Self::F32Compensated => "f32-compensated",
        }
    }

    /// The tier of that name.
    ///
    /// # Errors
    /// There is none; the text tells the nearest, or all.
    pub fn of_name(name: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|tier| tier.name() == name);
        found.ok_or_else(|| suggest::unknown("tier", name, Self::ALL.map(Self::name)))
    }

    /// The shader's constant.
    pub(super) fn constant(self) -> i32 {
        match self {
            Self::F16 => values::TIER_HALF,
            Self::F32 => values::TIER_F32,
            Self::F32Compensated => values::TIER_COMPENSATED,
        }
    }
}

/// One function.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Function {
    /// Its name.
    pub name: &'static str,
    /// What it takes beside directions, and in which range.
    pub takes: &'static str,
    /// What it gives, and what that includes.
    pub gives: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// The tiers that there are.
    pub tiers: &'static [Tier],
    /// Whether it is the slides' listing, with its faults.
    pub is_listing: bool,
    pub(super) constant: i32,
}

const BOTH: &[Tier] = &[Tier::F32, Tier::F32Compensated];
const PLAIN: &[Tier] = &[Tier::F32];

/// All of them. Directions N, L, E are unit vectors: normal, to the light, to the eye.
pub const FUNCTIONS: &[Function] = &[
    Function {
        name: "oren-nayar",
        takes: "roughness: sigma, radians, 0 to 1",
        gives: "pi f (N.L) for albedo 1: the cosine is included, 1/pi is not",
        source: "Oren and Nayar 1994, qualitative model; no more than 1 comes back",
        tiers: &Tier::ALL,
        is_listing: false,
        constant: values::FUNCTION_OREN_NAYAR,
    },
    Function {
        name: "cook-torrance",
        takes: "roughness: m, 1e-4 to 1 (below: 1e-4); f0, 0 to 1",
        gives: "f (N.L) = D F G / (4 N.E), 1/sr: the cosine and 1/pi are included",
        source: "Cook and Torrance 1982, normalised; Beckmann, Schlick, V-cavities",
        tiers: BOTH,
        is_listing: false,
        constant: values::FUNCTION_COOK_TORRANCE,
    },
    Function {
        name: "beckmann-d",
        takes: "roughness: m, 1e-4 to 1 (below: 1e-4)",
        gives: "D of the half vector of L and E, 1/sr: its integral against the cosine is 1",
        source: "Beckmann and Spizzichino 1963",
        tiers: BOTH,
        is_listing: false,
        constant: values::FUNCTION_BECKMANN_D,
    },
    Function {
        name: "schlick-f",
        takes: "f0, 0 to 1; N is not used",
        gives: "the reflectance at the half vector of L and E, 0 to 1",
        source: "Schlick 1994; f90 = min(1, 50 f0)",
        tiers: &[Tier::F16, Tier::F32],
        is_listing: false,
        constant: values::FUNCTION_SCHLICK_F,
    },
    Function {
        name: "v-cavity-g",
        takes: "nothing else",
        gives: "the share of a facet that is neither shadowed nor masked, 0 to 1",
        source: "Torrance and Sparrow 1967",
        tiers: BOTH,
        is_listing: false,
        constant: values::FUNCTION_V_CAVITY_G,
    },
    Function {
        name: "corrected",
        takes: "roughness: sigma and m, 0 to 1 (m: at least 1e-3); f0, 0 to 1",
        gives: "f (N.L) of a surface of albedo 1, base and interface, 1/sr: what a frame is shaded with",
        source: "oren-nayar under cook-torrance, coupled as Ashikhmin and Shirley 2000",
        tiers: BOTH,
        is_listing: false,
        constant: values::FUNCTION_CORRECTED,
    },
    Function {
        name: "slides-oren-nayar",
        takes: "roughness, 0 to 1",
        gives: "the listing's OrenNayar: the cosine is included, 1/pi is not",
        source: "the slides, to the letter",
        tiers: PLAIN,
        is_listing: true,
        constant: values::FUNCTION_SLIDES_OREN_NAYAR,
    },
    Function {
        name: "slides-cook-torrance",
        takes: "roughness, 0 to 1; f0: FresnelScale, 0 to 1",
        gives: "the listing's CookTorrance = D F G / (pi N.E): the cosine is included",
        source: "the slides, to the letter",
        tiers: PLAIN,
        is_listing: true,
        constant: values::FUNCTION_SLIDES_COOK_TORRANCE,
    },
];

/// A sum of its inputs: what an evaluation costs without a function. Not among `FUNCTIONS`.
pub static NOTHING: Function = Function {
    name: "nothing",
    takes: "all",
    gives: "their sum",
    source: "the probe",
    tiers: PLAIN,
    is_listing: false,
    constant: values::FUNCTION_NOTHING,
};

impl Function {
    /// The function of that name.
    ///
    /// # Errors
    /// There is none; the text tells the nearest, or all.
    pub fn of_name(name: &str) -> Result<&'static Self, String> {
        let found = FUNCTIONS.iter().find(|function| function.name == name);
        found.ok_or_else(|| suggest::unknown("function", name, FUNCTIONS.iter().map(|f| f.name)))
    }
}

impl Function {
    /// Why it is not to be had in a tier; none where it is.
    pub fn why_not(&self, tier: Tier) -> Option<&'static str> {
        if self.tiers.contains(&tier) {
            return None;
        }
        Some(match tier {
            _ if self.is_listing => "the slides' listing is what it is: f32",
            Tier::F16 => {
                "in 16 bits the half vector's sine and cosine are lost where the lobe is narrow or low (half of D below a \
                 roughness of 0.05, and 0/0 near the surface): f32"
            }
            Tier::F32 | Tier::F32Compensated => "no dot product of directions cancels in it: f32",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_back_and_a_misspelt_one_to_the_nearest() {
        for function in FUNCTIONS {
            assert_eq!(Function::of_name(function.name), Ok(function));
        }
        let error = Function::of_name("orennayar").unwrap_err();
        assert!(error.contains("'oren-nayar'"), "{error}");
        let error = Tier::of_name("f33").unwrap_err();
        assert!(error.contains("'f32'"), "{error}");
    }
}
