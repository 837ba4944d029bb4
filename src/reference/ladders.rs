//! Which tiers has each term of the lighting equation, the cheapest first?
//!
//! The slides' own forms are tiers too. Names are those of the command line.

use std::fmt;

/// How the matte base scatters.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Diffuse {
    /// Lambert 1760: smooth.
    Lambert,
    /// Oren and Nayar 1994, the qualitative model, dimmed where it would make light.
    Qon,
    /// Fujii's improvement of it.
    Fon,
    /// Portsmouth, Kutz and Hill 2025: Fujii's, and the light that it loses.
    Eon,
    /// Oren and Nayar 1994, the full model, with one interreflection.
    FullOrenNayar,
    /// The slides' listing of the qualitative model, to the letter.
    Slides,
}

impl Diffuse {
    /// All.
    pub const ALL: [Self; 6] = [
        Self::Lambert,
        Self::Qon,
        Self::Fon,
        Self::Eon,
        Self::FullOrenNayar,
        Self::Slides,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lambert => "lambert",
            Self::Qon => "qon",
            Self::Fon => "fon",
            Self::Eon => "eon",
            Self::FullOrenNayar => "full-oren-nayar",
            Self::Slides => "slides",
        }
    }
}

/// How the interface's facets reflect.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Specular {
    /// Blinn 1977, normalised; the exponent is that of a highlight as wide as Beckmann's.
    BlinnPhong,
    /// Cook and Torrance 1982: Beckmann's facets in V-cavities.
    CookTorrance,
    /// Beckmann's facets under Smith's shadowing, by its rational form.
    BeckmannSmith,
    /// The same by Smith's function itself.
    BeckmannSmithExact,
    /// Walter et al. 2007: GGX under Smith's shadowing.
    Ggx,
    /// The same, and what bounces between facets (Kulla and Conty 2017).
    GgxMulti,
    /// The slides' listing of Cook and Torrance, to the letter, its Fresnel term included.
    Slides,
}

impl Specular {
    /// All.
    pub const ALL: [Self; 7] = [
        Self::BlinnPhong,
        Self::CookTorrance,
        Self::BeckmannSmith,
        Self::BeckmannSmithExact,
        Self::Ggx,
        Self::GgxMulti,
        Self::Slides,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::BlinnPhong => "blinn-phong",
            Self::CookTorrance => "cook-torrance",
            Self::BeckmannSmith => "beckmann-smith",
            Self::BeckmannSmithExact => "beckmann-smith-exact",
            Self::Ggx => "ggx",
            Self::GgxMulti => "ggx-multi",
            Self::Slides => "slides",
        }
    }
}

/// How much a facet reflects, by the angle of the light on it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Fresnel {
    /// Schlick's curve for one number; a colour scales it, as the slides do.
    Scale,
    /// Schlick 1994 per channel.
    Schlick,
    /// The same, dipped by the colour at 82 degrees.
    F82,
    /// Fresnel's equations for a clear interface of that f0.
    Dielectric,
    /// Fresnel's equations for a metal at three wavelengths.
    Conductor,
    /// A fit per metal to Fresnel's equations integrated over wavelength.
    Spectral,
}

impl Fresnel {
    /// All.
    pub const ALL: [Self; 6] = [
        Self::Scale,
        Self::Schlick,
        Self::F82,
        Self::Dielectric,
        Self::Conductor,
        Self::Spectral,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Scale => "scale",
            Self::Schlick => "schlick",
            Self::F82 => "f82",
            Self::Dielectric => "dielectric",
            Self::Conductor => "conductor",
            Self::Spectral => "spectral",
        }
    }
}

/// A tier of each term. Base and interface share the light as `coupled` has it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Mix {
    /// The base.
    pub diffuse: Diffuse,
    /// The interface's facets.
    pub specular: Specular,
    /// What they reflect.
    pub fresnel: Fresnel,
}

impl Mix {
    /// The slides' models, rightly normalised.
    pub const CORRECTED: Self = Self {
        diffuse: Diffuse::Qon,
        specular: Specular::CookTorrance,
        fresnel: Fresnel::Schlick,
    };
    /// What comes nearest to the truths: no light is lost, and metals have their colour at every angle.
    pub const BEST: Self = Self {
        diffuse: Diffuse::Eon,
        specular: Specular::GgxMulti,
        fresnel: Fresnel::Spectral,
    };
}

impl fmt::Display for Mix {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            diffuse,
            specular,
            fresnel,
        } = self;
        let names = [diffuse.name(), specular.name(), fresnel.name()];
        f.write_str(&names.join(" + "))
    }
}
