//! Which lighting functions does the library have, and what do they take and give?

use std::fmt;

use crate::interface::reflected::values;
use crate::interface::{ProbeInput, spirv};
use crate::reference::ladders::{Diffuse, Fresnel, Specular};
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
#[derive(Clone, Copy)]
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
    /// What it takes beside roughness and f0: at most four.
    pub extra: &'static [Extra],
    /// Where it is promised to be accurate.
    pub shape: Shape,
    pub(super) shader: &'static [u32],
    pub(super) constant: i32,
}

/// A name is one function's.
impl PartialEq for Function {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Function {}

impl fmt::Debug for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// What every function is given.
const COLUMNS: [&str; 11] = [
    "nx",
    "ny",
    "nz",
    "lx",
    "ly",
    "lz",
    "ex",
    "ey",
    "ez",
    "roughness",
    "f0",
];

/// A number that a function takes beside roughness and f0.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Extra {
    /// Its name.
    pub name: &'static str,
    /// What it may be, both ends included.
    pub range: (f32, f32),
}

/// Where a function is promised to be accurate.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Shape {
    /// Whatever the angles.
    Flat,
    /// With light and eye above the surface.
    Cosines,
    /// The same, and where a lobe of that roughness is at least 1e-6 of its peak.
    Lobe,
    /// The same, of a roughness of at least `M_MIN`.
    Clamped,
}

impl Shape {
    /// The shaders' constant.
    pub(super) fn constant(self) -> i32 {
        match self {
            Self::Flat => values::SHAPE_FLAT,
            Self::Cosines => values::SHAPE_COSINES,
            Self::Lobe => values::SHAPE_LOBE,
            Self::Clamped => values::SHAPE_CLAMPED,
        }
    }
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
        extra: &[],
        shape: Shape::Cosines,
        shader: spirv::PROBE_COMP,
        constant: values::FUNCTION_OREN_NAYAR,
    },
    Function {
        name: "cook-torrance",
        takes: "roughness: m, 1e-4 to 1 (below: 1e-4); f0, 0 to 1",
        gives: "f (N.L) = D F G / (4 N.E), 1/sr: the cosine and 1/pi are included",
        source: "Cook and Torrance 1982, normalised; Beckmann, Schlick, V-cavities",
        tiers: BOTH,
        is_listing: false,
        extra: &[],
        shape: Shape::Lobe,
        shader: spirv::PROBE_COMP,
        constant: values::FUNCTION_COOK_TORRANCE,
    },
    Function {
        name: "beckmann-d",
        takes: "roughness: m, 1e-4 to 1 (below: 1e-4)",
        gives: "D of the half vector of L and E, 1/sr: its integral against the cosine is 1",
        source: "Beckmann and Spizzichino 1963",
        tiers: BOTH,
        is_listing: false,
        extra: &[],
        shape: Shape::Lobe,
        shader: spirv::PROBE_COMP,
        constant: values::FUNCTION_BECKMANN_D,
    },
    Function {
        name: "schlick-f",
        takes: "f0, 0 to 1; N is not used",
        gives: "the reflectance at the half vector of L and E, 0 to 1",
        source: "Schlick 1994; f90 = min(1, 50 f0)",
        tiers: &[Tier::F16, Tier::F32],
        is_listing: false,
        extra: &[],
        shape: Shape::Flat,
        shader: spirv::PROBE_COMP,
        constant: values::FUNCTION_SCHLICK_F,
    },
    Function {
        name: "v-cavity-g",
        takes: "nothing else",
        gives: "the share of a facet that is neither shadowed nor masked, 0 to 1",
        source: "Torrance and Sparrow 1967",
        tiers: BOTH,
        is_listing: false,
        extra: &[],
        shape: Shape::Cosines,
        shader: spirv::PROBE_COMP,
        constant: values::FUNCTION_V_CAVITY_G,
    },
    Function {
        name: "corrected",
        takes: "roughness: sigma and m, 0 to 1 (m: at least 1e-3); f0, 0 to 1",
        gives: "f (N.L) of a surface of albedo 1, base and interface, 1/sr: what a frame is shaded with",
        source: "oren-nayar under cook-torrance, coupled as Ashikhmin and Shirley 2000",
        tiers: BOTH,
        is_listing: false,
        extra: &[],
        shape: Shape::Clamped,
        shader: spirv::PROBE_COMP,
        constant: values::FUNCTION_CORRECTED,
    },
    Function {
        name: "lambert",
        takes: "nothing else",
        gives: "pi f (N.L) for albedo 1: the cosine is included, 1/pi is not",
        source: "Lambert 1760",
        tiers: BOTH,
        is_listing: false,
        extra: &[],
        shape: Shape::Cosines,
        shader: spirv::PROBE_DIFFUSE_COMP,
        constant: values::FUNCTION_LAMBERT,
    },
    Function {
        name: "fon",
        takes: "roughness: r, 0 to 1",
        gives: "pi f (N.L) for albedo 1: the cosine is included, 1/pi is not",
        source: "Fujii, improvement of Oren and Nayar's qualitative model",
        tiers: BOTH,
        is_listing: false,
        extra: &[],
        shape: Shape::Cosines,
        shader: spirv::PROBE_DIFFUSE_COMP,
        constant: values::FUNCTION_FON,
    },
    Function {
        name: "eon",
        takes: "roughness: r, 0 to 1; albedo, 0 to 1",
        gives: "pi f (N.L): the cosine and the albedo are included, 1/pi is not",
        source: "Portsmouth, Kutz and Hill 2025",
        tiers: BOTH,
        is_listing: false,
        extra: &[Extra {
            name: "albedo",
            range: (0.0, 1.0),
        }],
        shape: Shape::Cosines,
        shader: spirv::PROBE_DIFFUSE_COMP,
        constant: values::FUNCTION_EON,
    },
    Function {
        name: "full-oren-nayar",
        takes: "roughness: sigma, radians, 0 to 1; albedo, 0 to 1",
        gives: "pi f (N.L): the cosine and the albedo are included, 1/pi is not",
        source: "Oren and Nayar 1994, eq. 27 and 28; 0 where the model falls below it",
        tiers: PLAIN,
        is_listing: false,
        extra: &[Extra {
            name: "albedo",
            range: (0.0, 1.0),
        }],
        shape: Shape::Cosines,
        shader: spirv::PROBE_DIFFUSE_COMP,
        constant: values::FUNCTION_FULL_OREN_NAYAR,
    },
    Function {
        name: "blinn-phong",
        takes: "roughness: m, 1e-4 to 1 (below: 1e-4); f0, 0 to 1",
        gives: "f (N.L) under Schlick's F, 1/sr: the cosine and 1/pi are included",
        source: "Blinn 1977, exponent 2/m^2 - 2, times (n + 8) / (8 pi)",
        tiers: BOTH,
        is_listing: false,
        extra: &[],
        shape: Shape::Lobe,
        shader: spirv::PROBE_SPECULAR_COMP,
        constant: values::FUNCTION_BLINN_PHONG,
    },
    Function {
        name: "beckmann-smith",
        takes: "roughness: m, 1e-4 to 1 (below: 1e-4); f0, 0 to 1",
        gives: "f (N.L) under Schlick's F, 1/sr: the cosine and 1/pi are included",
        source: "Walter et al. 2007, Smith's function by its rational form; correlated by height, Heitz 2014",
        tiers: BOTH,
        is_listing: false,
        extra: &[],
        shape: Shape::Lobe,
        shader: spirv::PROBE_SPECULAR_COMP,
        constant: values::FUNCTION_BECKMANN_SMITH,
    },
    Function {
        name: "beckmann-smith-exact",
        takes: "roughness: m, 1e-4 to 1 (below: 1e-4); f0, 0 to 1",
        gives: "f (N.L) under Schlick's F, 1/sr: the cosine and 1/pi are included",
        source: "the same, Smith's function itself",
        tiers: BOTH,
        is_listing: false,
        extra: &[],
        shape: Shape::Lobe,
        shader: spirv::PROBE_SPECULAR_COMP,
        constant: values::FUNCTION_BECKMANN_SMITH_EXACT,
    },
    Function {
        name: "ggx",
        takes: "roughness: alpha, 1e-4 to 1 (below: 1e-4); f0, 0 to 1",
        gives: "f (N.L) under Schlick's F, 1/sr: the cosine and 1/pi are included",
        source: "Walter et al. 2007; correlated by height, Heitz 2014",
        tiers: BOTH,
        is_listing: false,
        extra: &[],
        shape: Shape::Lobe,
        shader: spirv::PROBE_SPECULAR_COMP,
        constant: values::FUNCTION_GGX,
    },
    Function {
        name: "ggx-multi",
        takes: "roughness: alpha, 1e-4 to 1 (below: 1e-4); f0, 0 to 1",
        gives: "f (N.L) under Schlick's F, 1/sr: the cosine and 1/pi are included",
        source: "the same, and Kulla and Conty 2017",
        tiers: BOTH,
        is_listing: false,
        extra: &[],
        shape: Shape::Lobe,
        shader: spirv::PROBE_SPECULAR_COMP,
        constant: values::FUNCTION_GGX_MULTI,
    },
    Function {
        name: "f82-f",
        takes: "f0, 0 to 1; the tint at 82 degrees, 0 to 1; N is not used",
        gives: "the reflectance at the half vector of L and E, 0 to 1",
        source: "Kutz, Hasan and Edmondson 2021; 0 where the curve falls below it",
        tiers: PLAIN,
        is_listing: false,
        extra: &[Extra {
            name: "tint",
            range: (0.0, 1.0),
        }],
        shape: Shape::Flat,
        shader: spirv::PROBE_FRESNEL_COMP,
        constant: values::FUNCTION_F82,
    },
    Function {
        name: "dielectric-f",
        takes: "f0, 0 to 1; N is not used",
        gives: "the reflectance at the half vector of L and E of a clear interface with that f0, 0 to 1",
        source: "Fresnel 1823",
        tiers: PLAIN,
        is_listing: false,
        extra: &[],
        shape: Shape::Flat,
        shader: spirv::PROBE_FRESNEL_COMP,
        constant: values::FUNCTION_DIELECTRIC,
    },
    Function {
        name: "conductor-f",
        takes: "n, 0.01 to 10; k, 0 to 10; N is not used",
        gives: "the reflectance at the half vector of L and E of a metal at one wavelength, 0 to 1",
        source: "Born and Wolf, section 14.4",
        tiers: PLAIN,
        is_listing: false,
        extra: &[
            Extra {
                name: "n",
                range: (0.01, 10.0),
            },
            Extra {
                name: "k",
                range: (0.0, 10.0),
            },
        ],
        shape: Shape::Flat,
        shader: spirv::PROBE_FRESNEL_COMP,
        constant: values::FUNCTION_CONDUCTOR,
    },
    Function {
        name: "spectral-f",
        takes: "f0, 0 to 1; c1 to c4, -1 to 1; N is not used",
        gives: "the reflectance at the half vector of L and E, at least 0",
        source: "a fit per metal to Fresnel's equations integrated over wavelength",
        tiers: PLAIN,
        is_listing: false,
        extra: &[
            Extra {
                name: "c1",
                range: (-1.0, 1.0),
            },
            Extra {
                name: "c2",
                range: (-1.0, 1.0),
            },
            Extra {
                name: "c3",
                range: (-1.0, 1.0),
            },
            Extra {
                name: "c4",
                range: (-1.0, 1.0),
            },
        ],
        shape: Shape::Flat,
        shader: spirv::PROBE_FRESNEL_COMP,
        constant: values::FUNCTION_SPECTRAL,
    },
    Function {
        name: "slides-oren-nayar",
        takes: "roughness, 0 to 1",
        gives: "the listing's OrenNayar: the cosine is included, 1/pi is not",
        source: "the slides, to the letter",
        tiers: PLAIN,
        is_listing: true,
        extra: &[],
        shape: Shape::Cosines,
        shader: spirv::PROBE_COMP,
        constant: values::FUNCTION_SLIDES_OREN_NAYAR,
    },
    Function {
        name: "slides-cook-torrance",
        takes: "roughness, 0 to 1; f0: FresnelScale, 0 to 1",
        gives: "the listing's CookTorrance = D F G / (pi N.E): the cosine is included",
        source: "the slides, to the letter",
        tiers: PLAIN,
        is_listing: true,
        extra: &[],
        shape: Shape::Lobe,
        shader: spirv::PROBE_COMP,
        constant: values::FUNCTION_SLIDES_COOK_TORRANCE,
    },
];

/// What the library calls a base.
pub fn name_of_diffuse(tier: Diffuse) -> &'static str {
    match tier {
        Diffuse::Qon => "oren-nayar",
        Diffuse::Slides => "slides-oren-nayar",
        other => other.name(),
    }
}

/// What it calls facets.
pub fn name_of_specular(tier: Specular) -> &'static str {
    match tier {
        Specular::Slides => "slides-cook-torrance",
        other => other.name(),
    }
}

/// What it calls a Fresnel term.
pub fn name_of_fresnel(tier: Fresnel) -> &'static str {
    match tier {
        Fresnel::Scale | Fresnel::Schlick => "schlick-f",
        Fresnel::F82 => "f82-f",
        Fresnel::Dielectric => "dielectric-f",
        Fresnel::Conductor => "conductor-f",
        Fresnel::Spectral => "spectral-f",
    }
}

/// A sum of its inputs: what an evaluation costs without a function. Not among `FUNCTIONS`.
pub static NOTHING: Function = Function {
    name: "nothing",
    takes: "all",
    gives: "their sum",
    source: "the probe",
    tiers: PLAIN,
    is_listing: false,
    extra: &[],
    shape: Shape::Flat,
    shader: spirv::PROBE_COMP,
    constant: values::FUNCTION_NOTHING,
};

/// A whole model under one lamp, all channels. Not among `FUNCTIONS`: it is timed, and judged in pictures.
pub static MODEL: Function = Function {
    name: "model",
    takes: "roughness, f0, 0 to 1; four numbers that albedo, colour and Fresnel terms are made of, 0.1 to 0.9",
    gives: "radiance of the three channels together under 1 lx",
    source: "shading/models.glsl",
    tiers: PLAIN,
    is_listing: false,
    extra: &[PART, PART, PART, PART],
    shape: Shape::Flat,
    shader: spirv::PROBE_MODEL_COMP,
    constant: 0,
};

const PART: Extra = Extra {
    name: "part",
    range: (0.1, 0.9),
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

    /// What its inputs are called, number by number.
    pub fn columns(&self) -> Vec<&'static str> {
        let extra = self.extra.iter().map(|extra| extra.name);
        COLUMNS.into_iter().chain(extra).collect()
    }

    /// An input of so many numbers as there are columns; those that are missing are 0.
    pub fn input(&self, numbers: &[f32]) -> ProbeInput {
        let at = |i: usize| numbers.get(i).copied().unwrap_or(0.0);
        let vector = |i| [at(i), at(i + 1), at(i + 2)];
        ProbeInput {
            extra: std::array::from_fn(|i| at(COLUMNS.len() + i)),
            ..ProbeInput::new([vector(0), vector(3), vector(6)], at(9), at(10))
        }
    }

    /// The numbers of an input, column by column.
    pub fn numbers(&self, input: &ProbeInput) -> Vec<f32> {
        let vectors = [input.normal, input.light, input.eye];
        let all = vectors.into_iter().flatten();
        let all = all.chain([input.roughness, input.f0]);
        all.chain(input.extra).take(self.columns().len()).collect()
    }

    /// What it takes beside, at these shares of the ranges, 0..1.
    pub fn extra_at(&self, shares: [f32; 4]) -> [f32; 4] {
        std::array::from_fn(|i| {
            let range = self.extra.get(i).map_or((0.0, 0.0), |extra| extra.range);
            range.0 + (range.1 - range.0) * shares[i]
        })
    }

    /// An input whose extra numbers are shares of the ranges, with the numbers themselves.
    pub fn ranged(&self, input: ProbeInput) -> ProbeInput {
        ProbeInput {
            extra: self.extra_at(input.extra),
            ..input
        }
    }

    /// Whether an input has what it takes beside.
    pub fn takes_extra_of(&self, input: &ProbeInput) -> bool {
        let pairs = self.extra.iter().zip(input.extra);
        pairs
            .into_iter()
            .all(|(extra, x)| (extra.range.0..=extra.range.1).contains(&x))
    }

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
            Tier::F32 | Tier::F32Compensated if self.shape == Shape::Flat => {
                "no dot product of directions cancels in it: f32"
            }
            Tier::F32 | Tier::F32Compensated => {
                "near grazing its azimuth is lost before its products are: f32"
            }
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
