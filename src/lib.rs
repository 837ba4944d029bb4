//! What is Umber made of? Floors, each of which uses only those below it.
//!
//! ```text
//! 4  cli                    parse, call one function, print
//! 3  studies  report        ask a question, return a table; a table -> terminal, JSON, CSV, a page
//! 2  render   scene         scene -> frame; what a user can describe, and the loaders
//! 1  gpu                    Vulkan, safely: the only floor with ash and unsafe
//! 0  math  reference        f64: quadrature, statistics; the lighting models as the papers state them
//!    interface              what host and shaders share, compared by the compiler
//! beside: shader_build      GLSL -> SPIR-V and reflection, part of the build script
//! ```
//!
//! Absent on purpose, and held by a test (`tests/cpu/tidy.rs`): `unsafe` above `gpu`; any word of
//! `interface` in `reference`, so that the truth cannot inherit a shader's mistake; a pipeline or a
//! descriptor set for one material (but in the build `material` and in `render::state_changes`, which are there to be
//! measured against).
//!
//! Units: metres, +y up, right-handed; linear sRGB; photometric (lx, cd, cd/m^2).

pub mod cli;
pub mod gpu;
pub mod interface;
pub mod math;
pub mod reference;
pub mod render;
pub mod report;
pub mod scene;
pub mod studies;
