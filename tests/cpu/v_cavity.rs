//! Does the V-cavity's attenuation stay between none and all, alike for light and eye?

use std::f64::consts::PI;

use glam::DVec3;
use umber::math::frame::spherical;
use umber::reference::v_cavity::g;

use crate::samples::{above, assert_close, pairs};
use crate::tolerances::SAME_FORMULA;

const N: DVec3 = DVec3::Z;

#[test]
fn attenuation_is_a_share_and_reciprocal() {
    for (l, e) in pairs() {
        let share = g(N, l, e);
        assert!((0.0..=1.0).contains(&share), "{share} at {l} {e}");
        assert_close(g(N, e, l), share, SAME_FORMULA, "reciprocity");
    }
}

/// H = N, E.H = N.E: the shares of light and eye are both 2, so nothing is hidden, at grazing neither.
#[test]
fn facets_that_lie_flat_are_free() {
    for degrees in [0.0_f64, 30.0, 60.0, 85.0, 89.9] {
        let theta = degrees.to_radians();
        let (l, e) = (spherical(theta, 0.0), spherical(theta, PI));
        assert_eq!(g(N, l, e), 1.0, "{degrees} degrees");
    }
}

/// E = L: half the facet is hidden where 2 cos^2 = 1/2.
#[test]
fn facets_that_face_a_tilted_eye_are_hidden_as_it_sinks() {
    for degrees in [0.0_f64, 30.0, 45.0, 60.0, 89.0] {
        let cos = degrees.to_radians().cos();
        let e = spherical(degrees.to_radians(), 0.3);
        assert_close(
            g(N, e, e),
            (2.0 * cos * cos).min(1.0),
            SAME_FORMULA,
            "head light",
        );
    }
}

/// The shader's form, with the half vector not normalised.
#[test]
fn needs_no_normalised_half_vector() {
    for (l, e) in pairs() {
        let (nol, noe, hh) = (N.dot(l), N.dot(e), (l + e).length_squared());
        let expected = (4.0 * (nol + noe) * nol.min(noe) / hh).min(1.0);
        assert_close(g(N, l, e), expected, SAME_FORMULA, "half vector");
    }
}

#[test]
fn nothing_reaches_below_the_surface() {
    for l in above() {
        assert_eq!(g(N, l, -l), 0.0);
        assert_eq!(g(N, -l, l), 0.0);
    }
}
