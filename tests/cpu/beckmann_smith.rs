//! Does Smith's shadowing of Beckmann's facets hold its identity, and how far is its rational form from it?

use std::f64::consts::PI;

use glam::DVec3;
use umber::math::frame::spherical;
use umber::math::quadrature::{GaussLegendre, hemisphere};
use umber::reference::beckmann;
use umber::reference::beckmann_smith::{lambda, lambda_rational, lobe, rational_lobe};

use crate::samples::{assert_close, pairs};
use crate::tolerances::{QUADRATURE_KINKED, SAME_FORMULA_PEAKED, SMITH_RATIONAL};

const N: DVec3 = DVec3::Z;

/// What an eye sees of the facets, projected, is what it sees of the surface: int G1 D max(0, e.h) dh = cos(theta_e).
#[test]
fn visible_facets_fill_the_view() {
    let rule = GaussLegendre::new(48);
    for theta in [0.2_f64, 0.8, 1.3] {
        let e = spherical(theta, 0.0);
        let m = 0.6;
        let seen = hemisphere(&rule, N, e, |h| beckmann::d(N, h, m) * e.dot(h).max(0.0));
        let seen = seen / (1.0 + lambda(theta.cos(), m));
        assert!(
            (seen - theta.cos()).abs() <= QUADRATURE_KINKED,
            "{theta}: {seen}"
        );
    }
}

#[test]
fn the_rational_form_is_near() {
    let mut worst = 0.0_f64;
    for i in 1..1000 {
        let cosine = f64::from(i) / 1000.0;
        let shares = [lambda, lambda_rational].map(|f| 1.0 / (1.0 + f(cosine, 0.7)));
        worst = worst.max((shares[1] / shares[0] - 1.0).abs());
    }
    println!("rational: {worst:.2e} of the visible share");
    assert!(worst <= SMITH_RATIONAL, "{worst}");
}

#[test]
fn light_and_eye_may_change_places() {
    for (l, e) in pairs() {
        for form in [lobe, rational_lobe] {
            let there = form(N, l, e, 0.4) * N.dot(e);
            let back = form(N, e, l, 0.4) * N.dot(l);
            assert_close(back, there, SAME_FORMULA_PEAKED, "reciprocity");
        }
    }
}

#[test]
fn shadows_are_whole_at_the_horizon_and_none_straight_on() {
    assert_eq!((lambda(1.0, 0.5), lambda_rational(1.0, 0.5)), (0.0, 0.0));
    // Lambda tends to m tan(theta) / (2 sqrt(pi)).
    let slope = lambda(1.0e-9, 1.0) * 1.0e-9;
    assert_close(slope, 0.5 / PI.sqrt(), 1e-6, "grazing");
}
