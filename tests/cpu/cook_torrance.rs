//! Does Cook and Torrance's model, on the slides and corrected, hold its physics and its known figures?

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;
use umber::math::frame::spherical;
use umber::math::quadrature::{GaussLegendre, half_vectors};
use umber::reference::beckmann::M_MIN;
use umber::reference::cook_torrance::lobe;
use umber::reference::slides;

use crate::samples::{above, assert_close, pairs, view_angles};
use crate::tolerances::{
    QUADRATURE_KINKED, SAME_FORMULA, SAME_FORMULA_CANCELLING, SAME_FORMULA_PEAKED, THREE_DECIMALS,
    TWO_DECIMALS,
};

const N: DVec3 = DVec3::Z;
const ROUGHNESSES: [f64; 5] = [0.1, 0.3, 0.5, 0.8, 1.0];

fn albedo(theta_e: f64, m: f64) -> f64 {
    let e = spherical(theta_e, 0.4);
    half_vectors(&GaussLegendre::new(16), N, e, m, |l| {
        lobe(N, l, e, m, DVec3::ONE).x
    })
}

/// The integral of the listing: its BRDF D F G / (pi e l) times the cosine, the deck's formula taken as it stands.
fn slides_albedo(degrees: f64, m: f64, scale: f64) -> f64 {
    let e = spherical(degrees.to_radians(), 0.4);
    let listing = |l| slides::cook_torrance::cook_torrance(N, l, e, m, scale);
    half_vectors(&GaussLegendre::new(16), N, e, m, listing)
}

#[test]
fn light_and_eye_may_change_places() {
    for (l, e) in pairs() {
        for m in ROUGHNESSES {
            let f0 = DVec3::new(0.04, 0.5, 1.0);
            let there = lobe(N, l, e, m, f0) * N.dot(e);
            let back = lobe(N, e, l, m, f0) * N.dot(l);
            for channel in 0..3 {
                assert_close(
                    back[channel],
                    there[channel],
                    SAME_FORMULA_PEAKED,
                    "reciprocity",
                );
            }
        }
    }
}

/// The shader's form (no normalised half vector, tangent by the cross product, 1 - E.H by |L - E|^2).
#[test]
fn needs_no_normalised_half_vector() {
    for (l, e) in pairs() {
        for m in ROUGHNESSES {
            let h = l + e;
            let (hh, noh) = (h.length_squared(), N.dot(l) + N.dot(e));
            let (tan2, sec2) = (N.cross(h).length_squared() / (noh * noh), hh / (noh * noh));
            let d = (-tan2 / (m * m)).exp() * sec2 * sec2 / (PI * m * m);
            let one_minus_cos = (l - e).length_squared() / (4.0 * (1.0 + 0.5 * hh.sqrt()));
            let f = 0.04 + 0.96 * one_minus_cos.powi(5);
            let g = (4.0 * noh * N.dot(l).min(N.dot(e)) / hh).min(1.0);
            let expected = d * f * g / (4.0 * N.dot(e));
            let actual = lobe(N, l, e, m, DVec3::splat(0.04)).x;
            assert_close(actual, expected, SAME_FORMULA_PEAKED, "half vector");
        }
    }
}

#[test]
fn the_listing_is_four_over_pi_too_bright() {
    for (l, e) in pairs() {
        for m in ROUGHNESSES {
            // What the deck's code adds for irradiance 1: CookTorrance / pi.
            let listing = slides::cook_torrance::cook_torrance(N, l, e, m, 0.04) / PI;
            let corrected = lobe(N, l, e, m, DVec3::splat(0.04)).x;
            assert_close(
                listing,
                corrected * 4.0 / PI,
                SAME_FORMULA_CANCELLING,
                "4 / pi",
            );
        }
    }
}

#[test]
fn the_listing_is_undefined_at_its_dangerous_points() {
    let listing = slides::cook_torrance::cook_torrance;
    let e = spherical(0.5, 0.0);
    let mirrored = spherical(0.5, PI);
    assert!(!listing(N, e, N, 0.0, 0.04).is_finite(), "roughness 0");
    assert!(
        !listing(N, N, N, 0.0, 0.04).is_finite(),
        "roughness 0 at the mirror's peak"
    );
    assert!(
        listing(N, mirrored, DVec3::X, 0.5, 0.04).is_nan(),
        "eye on the horizon"
    );
    assert!(
        listing(N, e, -e, 0.5, 0.04).is_nan(),
        "light behind the eye"
    );
    assert!(
        listing(N, DVec3::new(0.1, 0.0, -1.0).normalize(), e, 0.5, 0.04).is_nan(),
        "light below"
    );
}

#[test]
fn nothing_is_reflected_below_the_surface() {
    for l in above() {
        assert_eq!(lobe(N, -l, l, 0.5, DVec3::ONE), DVec3::ZERO);
        assert_eq!(lobe(N, l, -l, 0.5, DVec3::ONE), DVec3::ZERO);
    }
    assert_eq!(lobe(N, DVec3::X, DVec3::X, 0.5, DVec3::ONE), DVec3::ZERO);
}

#[test]
fn a_furnace_gets_back_no_more_than_it_gives() {
    for m in [M_MIN, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.8, 1.0] {
        for theta in view_angles() {
            let albedo = albedo(theta, m);
            assert!(albedo <= 1.0 + SAME_FORMULA, "m {m} at {theta}: {albedo}");
        }
    }
}

#[test]
fn a_smooth_mirror_loses_nothing() {
    for degrees in [0.0_f64, 30.0, 60.0, 80.0] {
        assert_close(
            albedo(degrees.to_radians(), M_MIN),
            1.0,
            QUADRATURE_KINKED,
            "mirror",
        );
    }
    let rough = albedo(0.0, 1.0);
    assert!(
        (rough - 0.453).abs() <= THREE_DECIMALS,
        "V-cavities of m = 1 from above: {rough}"
    );
}

#[test]
fn the_slides_furnace_has_its_known_figures() {
    let figures = [
        (0.0, 0.05, 1.0, 4.00),
        (60.0, 0.1, 1.0, 4.00),
        (0.0, 0.5, 1.0, 3.57),
        (0.0, 1.0, 1.0, 1.81),
        (89.0, 1.0, 1.0, 3.98),
        (0.0, 0.05, 0.04, 0.16),
        (75.0, 0.05, 0.04, 1.01),
        (89.0, 0.05, 0.04, 3.11),
        (89.0, 0.05, 0.0, 3.08),
    ];
    for (degrees, m, scale, expected) in figures {
        let actual = slides_albedo(degrees, m, scale);
        let case = format!("{degrees} degrees, m {m}, FresnelScale {scale}");
        assert!(
            (actual - expected).abs() <= TWO_DECIMALS,
            "{case}: {actual}, not {expected}"
        );
    }
}

#[test]
fn the_slides_shader_gives_back_four_over_pi_of_the_light() {
    let most = slides_albedo(0.0, 0.05, 1.0) / PI;
    assert_close(most, 4.0 / PI, QUADRATURE_KINKED, "4 / pi");
    assert!((most - 1.2732).abs() <= QUADRATURE_KINKED);
}

#[test]
fn the_lobe_vanishes_smoothly_at_the_horizon() {
    let l = spherical(0.3, 0.0);
    // G is proportional to the small cosine, and here G D F / (4 N.E) to less than 10 times it.
    let cos = 1.0e-7;
    let near = lobe(N, spherical(FRAC_PI_2 - cos, 0.0), l, 0.5, DVec3::ONE).x;
    assert!((0.0..10.0 * cos).contains(&near), "{near}");
}

/// A pixel cannot show a guard away from N.E = 0, where N.E cancels against G: so the text is held.
#[test]
fn the_listing_has_no_guard() {
    let text = include_str!("../../shaders-glsl/slides/cook_torrance.glsl");
    for line in [
        "float NdL = max( 0.0f, dot( N, L ) );",
        "float NdE = max( 0.0f, dot( N, E ) );",
        "float R2 = Roughness * Roughness;",
        "float HdE = dot( H, E );",
        "float F = mix( pow( 1 - HdE, 5 ), 1, FresnelScale );",
        "float CookTorrance = max( (D*G*F) / (NdE * pi), 0.0f );",
    ] {
        assert!(text.contains(line), "{line}");
    }
}
