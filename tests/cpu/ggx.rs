//! Does GGX hold its normalisation, Smith's identity and its known loss of light?

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;
use umber::math::frame::spherical;
use umber::math::quadrature::GaussLegendre;
use umber::reference::ggx::{d, lambda, lobe};
use umber::reference::ggx_missing::albedo;

use crate::samples::{assert_close, pairs};
use crate::tolerances::{QUADRATURE_SMOOTH, SAME_FORMULA_PEAKED, THREE_DECIMALS};

const N: DVec3 = DVec3::Z;

#[test]
fn the_facets_cover_the_surface_once() {
    let rule = GaussLegendre::new(32);
    for alpha in [0.1, 0.3, 1.0] {
        let breaks = [0.0, alpha, 3.0 * alpha, 10.0 * alpha].map(f64::atan);
        let breaks = [&breaks[..], &[FRAC_PI_2]].concat();
        let covered = rule.integrate(&breaks, |theta| {
            2.0 * PI * theta.sin() * theta.cos() * d(N, spherical(theta, 0.0), alpha)
        });
        assert_close(covered, 1.0, QUADRATURE_SMOOTH, "D");
    }
}

#[test]
fn light_and_eye_may_change_places() {
    for (l, e) in pairs() {
        for alpha in [0.1, 0.4, 1.0] {
            let there = lobe(N, l, e, alpha) * N.dot(e);
            let back = lobe(N, e, l, alpha) * N.dot(l);
            assert_close(back, there, SAME_FORMULA_PEAKED, "reciprocity");
        }
    }
}

/// Of alpha 1 Smith's function is (1/cos - 1) / 2, and the visible share 2 cos / (1 + cos).
#[test]
fn the_roughest_has_a_plain_shadow() {
    for cosine in [0.01, 0.3, 0.9, 1.0] {
        assert_close(
            lambda(cosine, 1.0),
            0.5 * (1.0 / cosine - 1.0),
            1e-12,
            "lambda",
        );
    }
}

/// MODELS: from 0.307 at alpha 1, straight on.
#[test]
fn one_bounce_loses_what_is_known() {
    assert!(
        (albedo(1.0, 1.0) - 0.307).abs() < THREE_DECIMALS,
        "{}",
        albedo(1.0, 1.0)
    );
    assert!(albedo(0.5, 0.05) > 0.99);
}
