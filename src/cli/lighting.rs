//! Which lighting model is asked for: a whole one, or a tier of each ladder?

use clap::ValueEnum;

use crate::cli::exit::{Exit, Failure};
use crate::reference::ladders::{Diffuse, Fresnel, Mix, Specular};
use crate::reference::shade::Lighting;
use crate::scene::suggest;

/// `--lighting`, and a tier in place of the preset's.
#[derive(clap::Args)]
pub struct LightingArguments {
    /// The lighting model
    #[arg(long, default_value = "best")]
    lighting: Preset,
    /// The base: lambert, qon, fon, eon, full-oren-nayar, slides [default: the model's]
    #[arg(long, value_name = "TIER", value_parser = diffuse)]
    diffuse: Option<Diffuse>,
    /// The facets: blinn-phong, cook-torrance, beckmann-smith, beckmann-smith-exact, ggx, ggx-multi, slides [default:
    /// the model's]
    #[arg(long, value_name = "TIER", value_parser = specular)]
    specular: Option<Specular>,
    /// The Fresnel term: scale, schlick, f82, dielectric, conductor, spectral [default: the model's]
    #[arg(long, value_name = "TIER", value_parser = fresnel)]
    fresnel: Option<Fresnel>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Preset {
    /// Ambient, Lambert, Phong's highlight
    Phong,
    /// Oren-Nayar and Cook-Torrance as the slides' listings have them, to the letter
    Slides,
    /// The same models, rightly normalised and numerically safe, f0 per channel
    Corrected,
    /// What comes nearest to the truth: eon, ggx-multi, spectral
    Best,
}

impl LightingArguments {
    /// The model that is meant.
    ///
    /// # Errors
    /// The options contradict each other.
    pub fn model(&self) -> Result<Lighting, Failure> {
        let mix = match self.lighting {
            Preset::Phong => return self.whole("phong", Lighting::Phong),
            Preset::Slides => return self.whole("slides", Lighting::Slides),
            Preset::Corrected => Mix::CORRECTED,
            Preset::Best => Mix::BEST,
        };
        let mix = Mix {
            diffuse: self.diffuse.unwrap_or(mix.diffuse),
            specular: self.specular.unwrap_or(mix.specular),
            fresnel: self.fresnel.unwrap_or(self.fresnel_of(mix)),
        };
        if mix.specular == Specular::Slides && mix.fresnel != Fresnel::Scale {
            let message = format!(
                "--specular slides has a Fresnel term of its own, scale: leave out --fresnel {}",
                mix.fresnel.name()
            );
            return Err(Failure::new(Exit::Usage, message));
        }
        Ok(Lighting::Mixed(mix))
    }

    /// The listing brings its own.
    fn fresnel_of(&self, mix: Mix) -> Fresnel {
        match self.specular {
            Some(Specular::Slides) => Fresnel::Scale,
            _ => mix.fresnel,
        }
    }

    /// A model that has no tiers.
    fn whole(&self, name: &str, lighting: Lighting) -> Result<Lighting, Failure> {
        let tiers = [
            ("diffuse", self.diffuse.map(Diffuse::name)),
            ("specular", self.specular.map(Specular::name)),
            ("fresnel", self.fresnel.map(Fresnel::name)),
        ];
        let given = tiers
            .into_iter()
            .find_map(|(term, tier)| Some((term, tier?)));
        match given {
            None => Ok(lighting),
            Some((term, tier)) => {
                let message = format!(
                    "--lighting {name} is one whole model: leave out --{term} {tier}, or start from --lighting corrected"
                );
                Err(Failure::new(Exit::Usage, message))
            }
        }
    }

    /// The same on a command line.
    pub fn repeated(&self) -> Vec<String> {
        let lighting = self.lighting.to_possible_value();
        let lighting = lighting.map(|value| value.get_name().to_owned());
        let tiers = [
            ("--lighting", lighting),
            ("--diffuse", self.diffuse.map(|tier| tier.name().to_owned())),
            (
                "--specular",
                self.specular.map(|tier| tier.name().to_owned()),
            ),
            ("--fresnel", self.fresnel.map(|tier| tier.name().to_owned())),
        ];
        let given = tiers
            .into_iter()
            .filter_map(|(key, value)| Some([key.to_owned(), value?]));
        given.flatten().collect()
    }
}

fn diffuse(name: &str) -> Result<Diffuse, String> {
    tier("diffuse tier", name, &Diffuse::ALL, Diffuse::name)
}

fn specular(name: &str) -> Result<Specular, String> {
    tier("specular tier", name, &Specular::ALL, Specular::name)
}

fn fresnel(name: &str) -> Result<Fresnel, String> {
    tier("Fresnel tier", name, &Fresnel::ALL, Fresnel::name)
}

/// The tier of that name; else the nearest name is told.
fn tier<T: Copy>(
    what: &str,
    name: &str,
    all: &[T],
    name_of: fn(T) -> &'static str,
) -> Result<T, String> {
    let found = all.iter().copied().find(|tier| name_of(*tier) == name);
    found.ok_or_else(|| suggest::unknown(what, name, all.iter().map(|tier| name_of(*tier))))
}
