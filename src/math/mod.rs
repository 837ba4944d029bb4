//! What do the references and the measurements compute with, in f64?

pub mod double;
pub mod flip;
pub mod fnv;
pub mod frame;
pub mod quadrature;
pub mod statistics;
