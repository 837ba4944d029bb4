//! Do the shaders' constants say what they stand for?

use umber::reference::beckmann::M_MIN;
use umber::reference::punctual::{DISTANCE_MAX, DISTANCE_MIN};

const CONSTANTS: &str = include_str!("../../shaders-glsl/math/constants.glsl");
const DIRECTION: &str = include_str!("../../shaders-glsl/math/direction.glsl");
const BECKMANN: &str = include_str!("../../shaders-glsl/brdf/beckmann.glsl");
const INCIDENT: &str = include_str!("../../shaders-glsl/light/incident.glsl");
const POINT_LIGHT: &str = include_str!("../../shaders-glsl/effects/point_light.glsl");
const SHADOW: &str = include_str!("../../shaders-glsl/effects/shadow.glsl");

/// The 32 bits that a shader reads from `const float NAME = VALUE;`.
#[track_caller]
fn constant(source: &str, name: &str) -> f32 {
    let opening = format!("const float {name} = ");
    let value = source
        .lines()
        .find_map(|line| line.strip_prefix(opening.as_str()))
        .and_then(|rest| rest.split(';').next())
        .and_then(|value| value.parse().ok());
    value.unwrap_or_else(|| panic!("no line `{opening}VALUE;` in the shader"))
}

#[test]
fn pi_is_pi() {
    assert_eq!(constant(CONSTANTS, "INV_PI"), std::f32::consts::FRAC_1_PI);
}

#[test]
fn thresholds_are_the_powers_of_two_that_their_comments_derive() {
    assert_eq!(constant(CONSTANTS, "COS_MIN"), 2.0_f32.powi(-22));
    assert_eq!(constant(DIRECTION, "LENGTH_MIN"), f32::MIN_POSITIVE);
    assert_eq!(constant(DIRECTION, "LENGTH_MAX"), 2.0_f32.powi(126));
    assert_eq!(constant(INCIDENT, "ILLUMINANCE_MAX"), 2.0_f32.powi(64));
    assert_eq!(constant(POINT_LIGHT, "CAPPED2_MAX"), 2.0_f32.powi(60));
    assert_eq!(constant(SHADOW, "DEPTH_ROUNDING"), 2.0_f32.powi(-20));
    assert_eq!(constant(SHADOW, "POSITION_ROUNDING"), 2.0_f32.powi(-22));
}

#[test]
fn shader_and_reference_have_the_same_limits() {
    assert_eq!(constant(BECKMANN, "M_MIN"), M_MIN as f32);
    assert_eq!(
        constant(POINT_LIGHT, "DISTANCE2_MIN"),
        (DISTANCE_MIN * DISTANCE_MIN) as f32
    );
    assert_eq!(
        constant(POINT_LIGHT, "DISTANCE2_MAX"),
        (DISTANCE_MAX * DISTANCE_MAX) as f32
    );
}
