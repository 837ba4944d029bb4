//! Does Oren and Nayar's model, on the slides and corrected, hold its physics and its known figures?

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use umber::math::frame::spherical;
use umber::math::quadrature::{GaussLegendre, hemisphere};
use umber::reference::oren_nayar::{
    CONSERVES_FROM, conserving_lobe, largest_albedo, lobe, weights,
};
use umber::reference::slides;
use umber::reference::slides::readings::{self, Reading};

use crate::samples::{assert_close, pairs, view_angles};
use crate::tolerances::{
    CONTINUOUS, FIVE_DECIMALS, FOUR_DECIMALS, QUADRATURE_SMOOTH, SAME_FORMULA, THREE_DECIMALS,
};

const N: DVec3 = DVec3::Z;
const SIGMAS: [f64; 7] = [0.0, 0.05, 0.1985, 0.326, 0.5, 0.8, 1.0];

fn albedo(theta_e: f64, sigma: f64) -> f64 {
    let e = spherical(theta_e, 0.4);
    hemisphere(&GaussLegendre::new(16), N, e, |l| lobe(N, l, e, sigma)) / PI
}

#[test]
fn smooth_is_lambert() {
    for (l, e) in pairs() {
        assert_close(lobe(N, l, e, 0.0), N.dot(l), SAME_FORMULA, "sigma 0");
    }
}

#[test]
fn light_and_eye_may_change_places() {
    for (l, e) in pairs() {
        for sigma in SIGMAS {
            let there = lobe(N, l, e, sigma) * N.dot(e);
            assert_close(
                lobe(N, e, l, sigma) * N.dot(l),
                there,
                SAME_FORMULA,
                "reciprocity",
            );
        }
    }
}

/// The shader's form: L.E - (N.L)(N.E) holds both sines and the azimuth.
#[test]
fn needs_no_trigonometry() {
    for (l, e) in pairs() {
        let (nol, noe) = (N.dot(l), N.dot(e));
        let (a, b) = weights(0.7);
        let s = (l.dot(e) - nol * noe).max(0.0);
        let expected = nol * (a + b * s / nol.max(noe));
        assert_close(lobe(N, l, e, 0.7), expected, SAME_FORMULA, "trigonometry");
    }
}

#[test]
fn the_listing_is_the_papers_model() {
    for (l, e) in pairs() {
        for sigma in SIGMAS {
            let listing = slides::oren_nayar::oren_nayar(N, l, e, sigma);
            assert_close(listing, lobe(N, l, e, sigma), SAME_FORMULA, "listing");
        }
    }
}

#[test]
fn the_listing_is_undefined_where_light_or_eye_is_the_normal() {
    let tilted = spherical(0.5, 0.0);
    let undefined = slides::oren_nayar::oren_nayar;
    // (N - N) / |N - N| is NaN; max(0, NaN) is 0 by GLSL's text, so the listing hides it here ...
    assert_close(
        undefined(N, N, tilted, 0.5),
        weights(0.5).0,
        SAME_FORMULA,
        "hidden",
    );
    // ... but not where rounding leaves a normal longer than 1: the arc cosine of more than 1.
    let long = DVec3::new(0.6, 0.0, 0.8) * (1.0 + 1.0e-7);
    assert!(undefined(long, long, long, 0.5).is_nan());
    assert!(lobe(long, long, long, 0.5).is_finite());
}

#[test]
fn an_eye_behind_a_smooth_normal_still_sees_the_lit_base() {
    let behind = DVec3::new(0.995, 0.0, -0.1).normalize();
    let just_above = DVec3::new(1.0, 0.0, 1.0e-9).normalize();
    let just_below = DVec3::new(1.0, 0.0, -1.0e-9).normalize();
    let l = spherical(0.7, 0.2);
    assert!(lobe(N, l, behind, 0.5) > 0.0);
    assert_close(
        lobe(N, l, just_below, 0.5),
        lobe(N, l, just_above, 0.5),
        CONTINUOUS,
        "continuous",
    );
    assert_eq!(lobe(N, behind, l, 0.5), 0.0);
}

#[test]
fn directional_albedo_has_its_known_figures() {
    let angles = [0.0_f64, 45.0, 60.0, 75.0, 85.0, 89.0].map(f64::to_radians);
    let table = [
        (0.1, [0.985, 0.994, 0.999, 1.004, 1.007, 1.008]),
        (0.2, [0.946, 0.974, 0.987, 1.002, 1.011, 1.014]),
        (0.3, [0.893, 0.938, 0.960, 0.984, 0.999, 1.004]),
        (0.5, [0.785, 0.851, 0.883, 0.918, 0.940, 0.948]),
        (1.0, [0.624, 0.707, 0.747, 0.791, 0.818, 0.828]),
    ];
    for (sigma, row) in table {
        for (theta, expected) in angles.into_iter().zip(row) {
            let actual = albedo(theta, sigma);
            assert!(
                (actual - expected).abs() <= THREE_DECIMALS,
                "sigma {sigma}: {actual}, not {expected}"
            );
        }
    }
}

#[test]
fn albedo_is_largest_at_grazing_for_every_sigma() {
    for step in 0..=50 {
        let sigma = f64::from(step) / 50.0;
        let mut before = 0.0;
        for theta in view_angles() {
            let now = albedo(theta, sigma);
            assert!(
                now >= before - QUADRATURE_SMOOTH,
                "sigma {sigma}: falls towards {theta}"
            );
            assert!(
                now <= largest_albedo(sigma) + QUADRATURE_SMOOTH,
                "sigma {sigma} at {theta}: {now}"
            );
            before = now;
        }
    }
}

#[test]
fn the_slides_give_back_up_to_1_01518_of_the_light() {
    let (sigma, most) = (0..=10_000)
        .map(|step| f64::from(step) / 10_000.0)
        .map(|sigma| (sigma, largest_albedo(sigma)))
        .fold(
            (0.0, 0.0),
            |best, next| if next.1 > best.1 { next } else { best },
        );
    assert!((most - 1.01518).abs() <= FIVE_DECIMALS, "{most}");
    assert!((sigma - 0.1985).abs() <= FOUR_DECIMALS, "{sigma}");
    let (below, above) = (CONSERVES_FROM - 1.0e-9, CONSERVES_FROM + 1.0e-9);
    assert!(largest_albedo(below) > 1.0 && largest_albedo(above) < 1.0);
}

#[test]
fn the_corrected_lobe_gives_back_no_more_than_it_gets() {
    for step in 0..=20 {
        let sigma = f64::from(step) / 20.0;
        let e = spherical(89.9_f64.to_radians(), 0.4);
        let rule = GaussLegendre::new(16);
        let albedo = hemisphere(&rule, N, e, |l| conserving_lobe(N, l, e, sigma)) / PI;
        assert!(albedo <= 1.0 + QUADRATURE_SMOOTH, "sigma {sigma}: {albedo}");
    }
    let (l, e) = (spherical(0.5, 0.0), spherical(1.0, 0.3));
    assert_eq!(conserving_lobe(N, l, e, 0.3262), lobe(N, l, e, 0.3262));
    assert!(conserving_lobe(N, l, e, 0.2) < lobe(N, l, e, 0.2));
}

#[test]
fn three_readings_agree_where_nothing_is_undefined_and_part_where_it_is() {
    for (l, e) in pairs() {
        let [n, l, e] = [N, l, e].map(|v| v.as_vec3());
        let values = Reading::ALL.map(|reading| readings::oren_nayar(reading, n, l, e, 0.5));
        if values.iter().all(|value| value.is_finite()) {
            assert!(values.iter().all(|value| *value == values[0]), "{l} {e}");
        }
    }
    // L has the bits of N, which is longer than 1: acos is NaN.
    let normals = (1..1000).map(|i| Vec3::new(1.7, 2.9, i as f32).normalize());
    let n = normals
        .into_iter()
        .find(|n| n.dot(*n) > 1.0)
        .expect("a quarter are");
    let e = n.any_orthonormal_vector();
    let [dropped, _, kept] =
        Reading::ALL.map(|reading| readings::oren_nayar(reading, n, n, (n + e).normalize(), 0.5));
    assert!(dropped.is_finite() && kept.is_nan(), "{dropped} {kept}");
}
