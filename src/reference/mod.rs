//! What do the lighting models say, in f64, as their papers state them?
//!
//! Written apart from the shaders, in the papers' angles and with normalised half vectors, so that a slip in the
//! shaders' algebra shows. Vectors named `n`, `l`, `e` are unit vectors: normal, to the light, to the eye.

pub mod beckmann;
pub mod cook_torrance;
pub mod coupled;
pub mod given;
pub mod hemisphere;
pub mod oren_nayar;
pub mod punctual;
pub mod schlick;
pub mod shade;
pub mod slides;
pub mod v_cavity;
