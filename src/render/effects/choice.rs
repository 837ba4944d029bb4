//! Which effects may a frame have, and how are they compiled into its pipelines?

use super::census::{Census, Share};
use super::list::{ALL, Rule};
use super::set::EffectSet;
use super::states::{State, States};
use crate::interface::reflected::{constants, values};
use crate::scene::{Light, LightKind, Material};

/// How the same source becomes pipelines.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Build {
    /// One pipeline for any scene: every effect is compiled in, and the records say who calls for it.
    Dynamic,
    /// One pipeline for this scene: what nobody calls for is compiled out, what everybody calls for is
    /// not asked about.
    Scene,
    /// A pipeline for each kind of material: nothing is asked. Draws of a kind follow each other, so where opaque faces of
    /// two kinds stand in one place another of them is seen.
    Material,
}

impl Build {
    /// Every build.
    pub const ALL: [Self; 3] = [Self::Dynamic, Self::Scene, Self::Material];

    /// One lower-case word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dynamic => "dynamic",
            Self::Scene => "scene",
            Self::Material => "material",
        }
    }
}

/// The effects of a frame.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Effects {
    /// What the frame has where the scene calls for it; the rest is off, whoever calls.
    pub allowed: EffectSet,
    /// What is compiled in although no record may call for it: the price of having it at hand.
    pub idle: EffectSet,
    /// How it is compiled.
    pub build: Build,
}

impl Default for Effects {
    /// What the scene calls for, compiled for the scene.
    fn default() -> Self {
        Self {
            allowed: EffectSet::ALL,
            idle: EffectSet::NONE,
            build: Build::Scene,
        }
    }
}

impl Effects {
    /// The states of the one pipeline that serves the scene.
    pub(in crate::render) fn states(&self, census: &Census) -> States {
        // Lamps that may not stand somewhere have no beam and no shadow either, whatever they call for.
        let far_away = !self.allowed.has_constant(constants::EFFECT_POINT_LIGHT);
        self.resolve(|place| {
            let asked = matches!(ALL[place].rule, Rule::Light(..)) && far_away;
            match census.shares[place] {
                Share::None => State::Off,
                Share::All if !asked => State::On,
                Share::Some if ALL[place].harmless => State::On,
                Share::Some | Share::All => State::FromData,
            }
        })
    }

    /// The states of the pipeline that serves one material of it.
    pub(in crate::render) fn material_states(
        &self,
        census: &Census,
        material: &Material,
    ) -> States {
        let of_scene = self.states(census);
        self.resolve(|place| match ALL[place].rule {
            Rule::Material(_, by) if by(material) => State::On,
            Rule::Material(..) => State::Off,
            Rule::Light(..) => of_scene.0[place],
        })
    }

    fn resolve(&self, asked: impl Fn(usize) -> State) -> States {
        States(std::array::from_fn(|place| {
            let compiled_in = self.idle.has_place(place)
                || self.allowed.has_place(place) && self.build == Build::Dynamic;
            match (compiled_in, self.allowed.has_place(place)) {
                (true, _) => State::FromData,
                (false, true) => asked(place),
                (false, false) => State::Off,
            }
        }))
    }

    /// The word `effects` of a material's record.
    pub(in crate::render) fn material_bits(&self, material: &Material) -> u32 {
        self.bits(|rule| match rule {
            Rule::Material(bit, by) if by(material) => bit,
            _ => 0,
        })
    }

    /// The word `effects` of a light's record. Where a lamp may not stand somewhere it has no beam and throws no shadow
    /// either: it is far away, and shines on all alike.
    pub(in crate::render) fn light_bits(&self, light: &Light) -> u32 {
        let bits = self.bits(|rule| match rule {
            Rule::Light(bit, by) if by(light) => bit,
            _ => 0,
        });
        let stands = !matches!(light.kind, LightKind::Directional { .. });
        if stands && bits & values::BIT_POINT_LIGHT == 0 {
            return 0;
        }
        bits
    }

    fn bits(&self, of: impl Fn(Rule) -> u32) -> u32 {
        let rules = self.allowed.iter().map(|effect| effect.rule);
        rules.fold(0, |bits, rule| bits | of(rule))
    }
}
