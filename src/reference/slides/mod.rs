//! What do the slides' listings compute, in f64?
//!
//! Transcribed line by line with the listings' names and no guard, as GLSL's text defines its functions: where the
//! listing is undefined, so is the result (NaN or infinity).

pub mod cook_torrance;
pub mod oren_nayar;
pub mod phong;
pub mod readings;

/// GLSL's `max`, by its text: a NaN in `y` gives `x`, one in `x` gives NaN.
fn max(x: f64, y: f64) -> f64 {
    if x < y { y } else { x }
}

/// GLSL's `min`, by its text.
fn min(x: f64, y: f64) -> f64 {
    if y < x { y } else { x }
}

/// GLSL's `mix`.
fn mix(x: f64, y: f64, a: f64) -> f64 {
    x * (1.0 - a) + y * a
}
