//! Does Fujii's model have its albedo, its limits and no dark ring?

use std::f64::consts::PI;

use glam::DVec3;
use umber::math::frame::spherical;
use umber::math::quadrature::{GaussLegendre, hemisphere};
use umber::reference::fujii::{C1, albedo, lobe};

use crate::samples::{assert_close, pairs, view_angles};
use crate::tolerances::{CONTINUOUS, QUADRATURE_SMOOTH, SAME_FORMULA};

const N: DVec3 = DVec3::Z;
const ROUGHNESSES: [f64; 5] = [0.0, 0.1, 0.35, 0.7, 1.0];

#[test]
fn smooth_is_lambert() {
    for (l, e) in pairs() {
        assert_close(lobe(N, l, e, 0.0), N.dot(l), SAME_FORMULA, "roughness 0");
    }
}

#[test]
fn light_and_eye_may_change_places_and_nothing_is_negative() {
    for (l, e) in pairs() {
        for roughness in ROUGHNESSES {
            let there = lobe(N, l, e, roughness);
            let back = lobe(N, e, l, roughness) * N.dot(l) / N.dot(e);
            assert_close(back, there, SAME_FORMULA, "reciprocity");
            assert!(there >= 0.0);
        }
    }
}

/// The closed form of the paper against the integral of the lobe.
#[test]
fn the_albedo_is_the_lobes_integral() {
    let rule = GaussLegendre::new(16);
    for theta in view_angles() {
        let e = spherical(theta, 0.4);
        for roughness in ROUGHNESSES {
            let sum = hemisphere(&rule, N, e, |l| lobe(N, l, e, roughness)) / PI;
            assert_close(sum, albedo(roughness, theta), QUADRATURE_SMOOTH, "albedo");
            assert!(sum <= 1.0 + QUADRATURE_SMOOTH, "{sum}");
        }
    }
    // Seen straight on: s is 0 all around.
    assert_close(albedo(1.0, 0.0), 1.0 / (1.0 + C1), SAME_FORMULA, "normal");
}

/// Where s passes 0 the qualitative model has a kink and so a dark ring; here both sides are s cos(theta_l) long.
#[test]
fn there_is_no_jump_where_light_and_eye_stand_at_right_angles() {
    for degrees in [20.0_f64, 50.0, 80.0] {
        let e = spherical(degrees.to_radians(), 0.0);
        let at = |phi: f64| lobe(N, spherical(0.7, phi), e, 1.0);
        let right = PI / 2.0;
        assert_close(at(right - 1.0e-9), at(right + 1.0e-9), CONTINUOUS, "s = 0");
    }
}
