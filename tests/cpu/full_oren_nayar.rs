//! Does the full model of Oren and Nayar hold its limits, and where does it fall below 0?

use glam::DVec3;
use umber::math::frame::spherical;
use umber::reference::full_oren_nayar::lobe;

use crate::samples::{assert_close, pairs};
use crate::tolerances::{SAME_FORMULA, THREE_DECIMALS};

const N: DVec3 = DVec3::Z;

#[test]
fn smooth_is_lambert() {
    for (l, e) in pairs() {
        assert_close(
            lobe(N, l, e, 0.0, 0.6),
            0.6 * N.dot(l),
            SAME_FORMULA,
            "sigma 0",
        );
    }
}

#[test]
fn light_and_eye_may_change_places_and_nothing_is_negative() {
    for (l, e) in pairs() {
        for sigma in [0.2, 0.5, 1.0] {
            let there = lobe(N, l, e, sigma, 0.9) * N.dot(e);
            let back = lobe(N, e, l, sigma, 0.9) * N.dot(l);
            assert_close(back, there, SAME_FORMULA, "reciprocity");
            assert!(there >= 0.0);
        }
    }
}

/// The paper's functions by hand, sigma 0.5, light and eye at 60 degrees: C1 = 0.78448, C2 = 0.33088 sin(60) towards the light and
/// 0.33088 (sin(60) - 8/27) away from it, no C3 in the plane of the light, the second bounce 0.17 (0.25/0.38) (1 -+ 4/9).
#[test]
fn two_values_are_the_papers() {
    let at = |degrees: f64| spherical(60.0_f64.to_radians(), degrees.to_radians());
    let towards = 0.5 * (0.784_483 + 0.330_882 * 0.866_025 * 1.732_051 + 0.111_842 * (5.0 / 9.0));
    let away = 0.5 * (0.784_483 - 0.330_882 * 0.569_729 * 1.732_051 + 0.111_842 * (13.0 / 9.0));
    assert_close(
        lobe(N, at(0.0), at(0.0), 0.5, 1.0),
        towards,
        THREE_DECIMALS,
        "towards",
    );
    assert_close(
        lobe(N, at(180.0), at(0.0), 0.5, 1.0),
        away,
        THREE_DECIMALS,
        "away",
    );
}

#[test]
fn a_dark_rough_surface_would_give_less_than_nothing() {
    let grazing = 1.57;
    let (l, e) = (
        spherical(grazing, 0.0),
        spherical(grazing, std::f64::consts::PI),
    );
    assert_eq!(lobe(N, l, e, 1.0, 0.05), 0.0);
    assert!(lobe(N, l, e, 0.6, 0.05) > 0.0);
    assert!(lobe(N, l, e, 1.0, 1.0) > 0.0);
}
