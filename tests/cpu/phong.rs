//! Is Phong's model the classic one, and free of undefined powers?

use std::f64::consts::PI;

use glam::DVec3;
use umber::math::frame::spherical;
use umber::reference::slides::phong::{diffuse, specular};

use crate::samples::{assert_close, pairs};
use crate::tolerances::SAME_FORMULA_PEAKED;

const N: DVec3 = DVec3::Z;

#[test]
fn diffuse_is_the_cosine_above_the_surface() {
    for (l, _) in pairs() {
        assert_eq!(diffuse(N, l), N.dot(l));
        assert_eq!(diffuse(N, -l), 0.0);
    }
}

#[test]
fn the_highlight_is_one_in_the_mirror_direction_and_falls_with_the_power() {
    let l = spherical(0.6, 0.0);
    assert_close(
        specular(N, l, spherical(0.6, PI), 40.0),
        1.0,
        SAME_FORMULA_PEAKED,
        "peak",
    );
    let aside = specular(N, l, spherical(0.8, PI), 40.0);
    assert_close(
        aside,
        0.2_f64.cos().powi(40),
        SAME_FORMULA_PEAKED,
        "0.2 rad aside",
    );
}

#[test]
fn no_power_is_undefined() {
    let edges = [
        N,
        -N,
        DVec3::X,
        -DVec3::X,
        spherical(0.5, 0.0),
        -spherical(0.5, 0.0),
    ];
    for shininess in [0.0, 1.0, 1.0e30] {
        for l in edges {
            for e in edges {
                let highlight = specular(N, l, e, shininess);
                assert!(
                    (0.0..=1.0).contains(&highlight),
                    "{l} {e} {shininess}: {highlight}"
                );
            }
        }
    }
    // 0^0: the eye at right angles to the mirrored light sees no highlight.
    assert_eq!(specular(N, N, DVec3::X, 0.0), 0.0);
}

#[test]
fn no_highlight_where_the_light_is_behind() {
    assert_eq!(
        specular(N, -spherical(0.2, 0.0), spherical(0.2, 0.0), 1.0),
        0.0
    );
}
