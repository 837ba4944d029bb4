//! What is each effect's constant in one pipeline?

use std::fmt;

use super::list::ALL;
use crate::gpu::Constant;

/// The value of an effect's specialization constant.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[repr(i32)]
pub enum State {
    /// Compiled in; each record says whether it calls for it.
    FromData = -1,
    /// Compiled out.
    Off = 0,
    /// Compiled in for every record.
    On = 1,
}

/// The state of every effect, in the order of [`ALL`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct States(pub(super) [State; ALL.len()]);

impl States {
    /// The specialization constants.
    pub(in crate::render) fn constants(&self) -> impl Iterator<Item = Constant> {
        ALL.iter().zip(self.0).map(|(effect, state)| Constant {
            id: effect.constant,
            value: state as i32,
        })
    }

    /// The same with every effect off but the one of this constant.
    pub(in crate::render) fn only(&self, constant: u32) -> Self {
        let mut states = self.0;
        for (effect, state) in ALL.iter().zip(&mut states) {
            if effect.constant != constant {
                *state = State::Off;
            }
        }
        Self(states)
    }

    /// Whether the effect of this constant is compiled out.
    pub(in crate::render) fn is_off(&self, constant: u32) -> bool {
        let states = ALL.iter().zip(self.0);
        let mut own = states.filter(|(effect, _)| effect.constant == constant);
        own.all(|(_, state)| state == State::Off)
    }
}

impl fmt::Display for States {
    /// The names of what is compiled in, with a question mark where the record decides.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<_> = ALL
            .iter()
            .zip(self.0)
            .filter_map(|(effect, state)| match state {
                State::Off => None,
                State::On => Some(effect.name.to_owned()),
                State::FromData => Some(format!("{}?", effect.name)),
            })
            .collect();
        f.write_str(&names.join(" "))
    }
}
