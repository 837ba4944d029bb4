//! Is Beckmann's distribution a distribution, and what does a lamp's size do to it?

use std::f64::consts::PI;

use glam::DVec3;
use umber::math::frame::spherical;
use umber::math::quadrature::{GaussLegendre, equal_breaks};
use umber::reference::beckmann::{M_MIN, d, under_disc};

use crate::samples::assert_close;
use crate::tolerances::{QUADRATURE_SMOOTH, SAME_FORMULA};

const N: DVec3 = DVec3::Z;

/// The integral over the hemisphere of `f(theta)`, which falls with the slope over `width`.
fn over_slopes(width: f64, f: impl Fn(f64) -> f64) -> f64 {
    let rule = GaussLegendre::new(32);
    let end = 6.5;
    2.0 * PI
        * rule.integrate(&equal_breaks(0.0, end, 8), |s| {
            let theta = (width * s).atan();
            f(theta) * theta.sin() * theta.cos().powi(2) * width
        })
}

#[test]
fn facets_cover_the_surface_once() {
    for m in [M_MIN, 0.01, 0.1, 0.3, 0.5, 0.8, 1.0] {
        let area = over_slopes(m, |theta| d(N, spherical(theta, 0.3), m) * theta.cos());
        assert_close(area, 1.0, QUADRATURE_SMOOTH, &format!("m {m}"));
    }
}

#[test]
fn slopes_have_the_variance_m_squared_over_two_per_axis() {
    for m in [M_MIN, 0.1, 0.5] {
        let both_axes = over_slopes(m, |theta| {
            d(N, spherical(theta, 0.3), m) * theta.cos() * theta.tan().powi(2)
        });
        assert_close(both_axes, m * m, QUADRATURE_SMOOTH, &format!("m {m}"));
    }
}

#[test]
fn facets_do_not_face_away() {
    assert_eq!(d(N, DVec3::X, 0.5), 0.0);
    assert_eq!(d(N, -N, 0.5), 0.0);
}

/// The mean of D over a uniform disc of light about the normal, seen by an eye at the angle `tilt`.
fn disc_average(m: f64, radius: f64, tilt: f64) -> f64 {
    let rule = GaussLegendre::new(16);
    let e = spherical(tilt, 0.0);
    let sum = rule.integrate(&equal_breaks(0.0, radius, 2), |rho| {
        rho * rule.integrate(&equal_breaks(0.0, PI, 2), |phi| {
            let h = (e + spherical(rho, phi)).normalize();
            2.0 * d(N, h, m)
        })
    });
    sum / (PI * radius * radius)
}

/// With x = (r / 2m)^2 the average over the disc is (1 - e^-x) / x of the mirror peak, the widened lobe
/// 1 / (1 + x/2) of it: they part by x^2/12, and what is left are terms of x^3 and of r^2 from the sphere's curvature.
#[test]
fn a_small_disc_lowers_the_peak_as_the_widened_lobe_does() {
    for m in [0.05, 0.1] {
        for ratio in [0.25, 0.5, 1.0] {
            let radius = ratio * m;
            let x = (0.5_f64 * ratio).powi(2);
            let widened = d(N, N, under_disc(m, radius));
            let difference = (widened / disc_average(m, radius, 0.0) - 1.0).abs();
            let allowed = x * x / 12.0 + x * x * x / 12.0 + radius * radius;
            assert!(
                difference <= allowed,
                "m {m}, r {radius}: {difference:e} > {allowed:e}"
            );
        }
    }
}

/// Second moments add, whatever the shapes: also where the disc is far wider than the lobe.
#[test]
fn a_disc_widens_the_highlight_by_its_variance() {
    for (m, radius) in [(0.01, 0.01), (0.01, 0.03), (0.005, 0.04)] {
        let rule = GaussLegendre::new(16);
        // The half vector turns half as far as the eye.
        let tilts = equal_breaks(0.0, radius + 12.0 * m, 24);
        let moment = |power: i32| {
            rule.integrate(&tilts, |tilt| {
                disc_average(m, radius, tilt) * (0.5 * tilt).powi(power)
            })
        };
        let brute_force = moment(3) / moment(1);
        let expected = under_disc(m, radius).powi(2);
        // Angles stand for their tangents and sines: off by the square of the widest angle.
        assert_close(
            brute_force,
            expected,
            (radius + 12.0 * m).powi(2),
            &format!("m {m}, r {radius}"),
        );
    }
}

#[test]
fn a_mirror_shows_the_light_itself() {
    assert_eq!(under_disc(0.0, 0.0), M_MIN);
    let sun = 0.00465;
    assert_close(
        under_disc(0.0, sun),
        sun / 8.0_f64.sqrt(),
        SAME_FORMULA,
        "sun in a mirror",
    );
}
