//! Does EON give back all light, at every roughness and angle, and only as much as its albedo says?

use std::f64::consts::PI;

use glam::DVec3;
use umber::math::frame::spherical;
use umber::math::quadrature::{GaussLegendre, hemisphere};
use umber::reference::eon::{C2, lobe, missing};
use umber::reference::fujii;

use crate::samples::{assert_close, pairs, view_angles};
use crate::tolerances::{QUADRATURE_SMOOTH, SAME_FORMULA, SAME_FORMULA_CANCELLING};

const N: DVec3 = DVec3::Z;
const ROUGHNESSES: [f64; 4] = [0.0, 0.2, 0.6, 1.0];

#[test]
fn what_is_missing_is_what_fujiis_albedo_lacks() {
    for theta in view_angles() {
        for roughness in ROUGHNESSES {
            let lacks = 1.0 - fujii::albedo(roughness, theta);
            let off = (missing(roughness, theta.cos()) - lacks).abs();
            // The difference of two numbers near 1 is known to 1e-16 of 1.
            assert!(
                off <= 1.0e-2 * SAME_FORMULA,
                "{theta}, {roughness}: {off:e}"
            );
        }
    }
}

#[test]
fn near_grazing_it_is_missing_in_proportion_to_the_cosine() {
    // pi K = S asin(mu) + ... = mu (1 + S^2 - 2 q S / 3) to first order, and q = 3/2 there: mu.
    for mu in [1.0e-6, 1.0e-9, 1.0e-12] {
        let slope = missing(1.0, mu) * PI * (1.0 + fujii::C1) / mu;
        assert!(
            (slope - 1.0).abs() <= mu.sqrt() + SAME_FORMULA,
            "{mu}: {slope}"
        );
    }
    assert_eq!(missing(1.0, 0.0), 0.0);
}

#[test]
fn the_mean_albedo_is_the_mean() {
    let rule = GaussLegendre::new(32);
    for roughness in ROUGHNESSES {
        let mean = rule.integrate(&[0.0, 0.5 * PI], |theta| {
            2.0 * theta.sin() * theta.cos() * fujii::albedo(roughness, theta)
        });
        let closed = (1.0 + C2 * roughness) / (1.0 + fujii::C1 * roughness);
        assert_close(mean, closed, SAME_FORMULA_CANCELLING, "mean");
    }
}

#[test]
fn white_loses_no_light() {
    let rule = GaussLegendre::new(16);
    for theta in view_angles() {
        let e = spherical(theta, 0.4);
        for roughness in ROUGHNESSES {
            let back = hemisphere(&rule, N, e, |l| lobe(N, l, e, roughness, 1.0)) / PI;
            assert_close(back, 1.0, SAME_FORMULA_CANCELLING, "furnace");
            let grey = hemisphere(&rule, N, e, |l| lobe(N, l, e, roughness, 0.5)) / PI;
            assert!(grey <= 0.5 + QUADRATURE_SMOOTH, "{grey}");
        }
    }
}

#[test]
fn light_and_eye_may_change_places() {
    for (l, e) in pairs() {
        let there = lobe(N, l, e, 0.7, 0.8) * N.dot(e);
        let back = lobe(N, e, l, 0.7, 0.8) * N.dot(l);
        assert_close(back, there, SAME_FORMULA, "reciprocity");
    }
}
