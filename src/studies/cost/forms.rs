//! Which forms of the lighting code have a price?

use crate::reference::ladders::{Diffuse, Fresnel, Mix, Specular};
use crate::reference::shade::{Lighting, Terms};
use crate::render::Variant;

/// A tier of a term by itself, or a whole model.
#[derive(Clone, PartialEq, Debug)]
pub struct Form {
    /// `diffuse`, `specular`, `fresnel` or `model`.
    pub term: &'static str,
    /// Its name.
    pub tier: String,
    /// What a pipeline is made of it.
    pub variant: Variant,
    /// The best model with this tier in its place; the model itself.
    pub lighting: Lighting,
}

/// The terms, in the order of tables.
pub const TERMS: [&str; 4] = ["diffuse", "specular", "fresnel", "model"];

const BASE: Terms = Terms {
    diffuse: true,
    ..Terms::NONE
};
const INTERFACE: Terms = Terms {
    specular: true,
    ..Terms::NONE
};

/// Every tier of every term: a base without an interface; facets under Schlick's Fresnel term (a listing has its own); a
/// Fresnel term on GGX.
pub fn tiers() -> Vec<Form> {
    let alone = |mix, terms| Variant {
        lighting: Lighting::Mixed(mix),
        terms,
    };
    let form = |term, tier: &str, variant, mix| Form {
        term,
        tier: tier.to_owned(),
        variant,
        lighting: Lighting::Mixed(mix),
    };
    let diffuse = Diffuse::ALL.into_iter().map(|diffuse| {
        let mix = Mix {
            diffuse,
            ..Mix::BEST
        };
        form("diffuse", diffuse.name(), alone(mix, BASE), mix)
    });
    let specular = Specular::ALL.into_iter().map(|specular| {
        let with = |fresnel| Mix {
            specular,
            fresnel: of_listing(specular, fresnel),
            ..Mix::BEST
        };
        let variant = alone(with(Fresnel::Schlick), INTERFACE);
        form(
            "specular",
            specular.name(),
            variant,
            with(Mix::BEST.fresnel),
        )
    });
    let fresnel = Fresnel::ALL.into_iter().map(|fresnel| {
        let mix = Mix {
            fresnel,
            ..Mix::BEST
        };
        let on_ggx = Mix {
            specular: Specular::Ggx,
            ..mix
        };
        form("fresnel", fresnel.name(), alone(on_ggx, INTERFACE), mix)
    });
    diffuse.chain(specular).chain(fresnel).collect()
}

/// A listing brings its Fresnel term.
fn of_listing(specular: Specular, fresnel: Fresnel) -> Fresnel {
    match specular {
        Specular::Slides => Fresnel::Scale,
        _ => fresnel,
    }
}

/// A whole model as a form.
pub fn model(lighting: Lighting) -> Form {
    Form {
        term: "model",
        tier: name(lighting),
        variant: Variant {
            lighting,
            terms: Terms::ALL,
        },
        lighting,
    }
}

/// What tables call a model.
pub fn name(lighting: Lighting) -> String {
    match lighting {
        Lighting::Phong => "phong".to_owned(),
        Lighting::Slides => "slides".to_owned(),
        Lighting::Mixed(mix) => mix.to_string(),
    }
}

/// All mixes.
pub fn mixes() -> Vec<Mix> {
    let mut all = Vec::new();
    for diffuse in Diffuse::ALL {
        for specular in Specular::ALL {
            let of = |fresnel| Mix {
                diffuse,
                specular,
                fresnel,
            };
            match specular {
                Specular::Slides => all.push(of(Fresnel::Scale)),
                _ => all.extend(Fresnel::ALL.map(of)),
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tier_is_a_form_and_every_mix_is_there_once() {
        assert_eq!(tiers().len(), 6 + 7 + 6);
        let mixes = mixes();
        assert_eq!(mixes.len(), 6 * (6 * 6 + 1));
        for (i, mix) in mixes.iter().enumerate() {
            assert!(!mixes[..i].contains(mix), "{mix}");
        }
        for form in tiers() {
            let Lighting::Mixed(mix) = form.lighting else {
                panic!("{form:?}");
            };
            assert!(mixes.contains(&mix), "{mix}");
        }
        assert_eq!(
            model(Lighting::Mixed(Mix::BEST)).tier,
            "eon + ggx-multi + spectral"
        );
    }
}
