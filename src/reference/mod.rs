//! What do the lighting models say, in f64, as their papers state them?
//!
//! Written apart from the shaders, in the papers' angles and with normalised half vectors, so that a slip in the
//! shaders' algebra shows. Vectors named `n`, `l`, `e` are unit vectors: normal, to the light, to the eye.

pub mod beckmann;
pub mod beckmann_smith;
pub mod blinn_phong;
pub mod conductor;
pub mod cook_torrance;
pub mod coupled;
pub mod dielectric;
pub mod eon;
pub mod f82;
pub mod fujii;
pub mod full_oren_nayar;
pub mod ggx;
pub mod ggx_missing;
pub mod given;
pub mod hemisphere;
pub mod kulla_conty;
pub mod ladders;
pub mod lambert;
pub mod metal;
pub mod oren_nayar;
pub mod punctual;
pub mod reflectance;
pub mod schlick;
pub mod shade;
pub mod slides;
pub mod spectral;
pub mod truth;
pub mod v_cavity;
pub mod wavelengths;
