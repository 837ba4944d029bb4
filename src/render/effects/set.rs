//! Which of the effects are meant?

use std::fmt;

use super::list::{ALL, Effect};
use crate::scene::suggest;

/// Some of the effects of [`ALL`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct EffectSet(u32);

/// A name that no effect has; the text tells the nearest one, or all of them.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{0}")]
pub struct UnknownEffect(String);

impl EffectSet {
    /// No effect.
    pub const NONE: Self = Self(0);
    /// Every effect.
    pub const ALL: Self = Self((1 << ALL.len()) - 1);

    /// The effects of these names.
    ///
    /// # Errors
    /// A name that no effect has; the nearest one is told.
    pub fn of_names<'a>(names: impl IntoIterator<Item = &'a str>) -> Result<Self, UnknownEffect> {
        let mut set = Self::NONE;
        for name in names {
            match ALL.iter().position(|effect| effect.name == name) {
                Some(place) => set.0 |= 1 << place,
                None => return Err(unknown(name)),
            }
        }
        Ok(set)
    }

    /// Whether the effect is among them.
    pub fn has(self, effect: &Effect) -> bool {
        self.0 & bit_of(effect) != 0
    }

    /// Whether the effect of this constant is among them.
    pub(in crate::render) fn has_constant(self, constant: u32) -> bool {
        self.iter().any(|effect| effect.constant == constant)
    }

    /// Whether the effect at this place of [`ALL`] is among them.
    pub(super) fn has_place(self, place: usize) -> bool {
        self.0 >> place & 1 == 1
    }

    /// Those and this one.
    pub fn with(self, effect: &Effect) -> Self {
        Self(self.0 | bit_of(effect))
    }

    /// Those but this one.
    pub fn without(self, effect: &Effect) -> Self {
        Self(self.0 & !bit_of(effect))
    }

    /// Those but the one of this constant.
    pub(in crate::render) fn without_constant(self, constant: u32) -> Self {
        let rest = self.iter().filter(|effect| effect.constant != constant);
        rest.fold(Self::NONE, |set, effect| set.with(effect))
    }

    /// Those that are in both.
    pub fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// The effects, in the order of [`ALL`].
    pub fn iter(self) -> impl Iterator<Item = &'static Effect> {
        let places = ALL.iter().enumerate();
        places.filter_map(move |(place, effect)| self.has_place(place).then_some(effect))
    }
}

impl fmt::Display for EffectSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<_> = self.iter().map(|effect| effect.name).collect();
        f.write_str(&names.join(","))
    }
}

fn bit_of(effect: &Effect) -> u32 {
    let place = ALL.iter().position(|other| other.name == effect.name);
    place.map_or(0, |place| 1 << place)
}

fn unknown(name: &str) -> UnknownEffect {
    let known = ALL.iter().map(|effect| effect.name);
    UnknownEffect(suggest::unknown("effect", name, known))
}
