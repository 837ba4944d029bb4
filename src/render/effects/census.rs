//! Who in a scene calls for which effect?

use std::fmt;

use super::list::{ALL, Effect, Need, Rule};
use super::set::EffectSet;
use crate::scene::Scene;

/// Who calls for an effect.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Caller {
    /// A material, by name.
    Material(String),
    /// A light, by name.
    Light(String),
}

impl fmt::Display for Caller {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Material(name) => write!(f, "material \"{name}\""),
            Self::Light(name) => write!(f, "light \"{name}\""),
        }
    }
}

/// How many of the records that could call for an effect do.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Share {
    None,
    Some,
    All,
}

/// What was found, effect by effect, in the order of [`ALL`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Census {
    pub(super) shares: [Share; ALL.len()],
}

impl Census {
    /// Asks everyone once.
    pub fn of(scene: &Scene) -> Self {
        Self {
            shares: ALL.map(|effect| match effect.rule {
                Rule::Material(_, by) => share(scene.materials.iter().map(by)),
                Rule::Light(_, by) => share(scene.lights.iter().map(by)),
            }),
        }
    }

    /// The effects that somebody calls for.
    pub fn called_for(&self) -> EffectSet {
        let effects = ALL.iter().enumerate();
        effects
            .filter(|(place, _)| self.shares[*place] != Share::None)
            .fold(EffectSet::NONE, |set, (_, effect)| set.with(effect))
    }

    /// Whether one of `allowed` is called for and needs something.
    pub(in crate::render) fn needs(&self, allowed: EffectSet, need: Need) -> bool {
        let called_for = self.called_for().and(allowed);
        called_for.iter().any(|effect| effect.needs.contains(&need))
    }
}

impl Effect {
    /// Everyone in the scene who calls for it, in the scene's order.
    pub fn callers(&self, scene: &Scene) -> Vec<Caller> {
        match self.rule {
            Rule::Material(_, by) => {
                let callers = scene.materials.iter().filter(|material| by(material));
                callers.map(|m| Caller::Material(m.name.clone())).collect()
            }
            Rule::Light(_, by) => {
                let callers = scene.lights.iter().filter(|light| by(light));
                callers.map(|l| Caller::Light(l.name.clone())).collect()
            }
        }
    }
}

fn share(calls: impl Iterator<Item = bool>) -> Share {
    let (mut some, mut all) = (false, true);
    for call in calls {
        some |= call;
        all &= call;
    }
    match (some, all) {
        (false, _) => Share::None,
        (true, false) => Share::Some,
        (true, true) => Share::All,
    }
}
