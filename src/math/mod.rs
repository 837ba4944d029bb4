//! What do the references compute with, in f64?

pub mod frame;
pub mod quadrature;
