//! Do the quadratures integrate what is known in closed form?

use std::f64::consts::PI;

use glam::DVec3;
use umber::math::frame::{angle, spherical};
use umber::math::quadrature::{GaussLegendre, equal_breaks, half_vectors, hemisphere};

use crate::samples::assert_close;
use crate::tolerances::{QUADRATURE_SMOOTH, SAME_FORMULA};

#[test]
fn gauss_legendre_is_exact_for_polynomials_up_to_its_degree() {
    for n in 1..=20 {
        let rule = GaussLegendre::new(n);
        let degree = 2 * n as i32 - 1;
        let integral = rule.integrate(&[0.0, 0.5, 2.0], |x| x.powi(degree));
        let exact = 2.0_f64.powi(degree + 1) / f64::from(degree + 1);
        assert_close(integral, exact, SAME_FORMULA, &format!("{n} nodes"));
    }
}

#[test]
fn breaks_divide_an_interval_equally() {
    assert_eq!(equal_breaks(1.0, 3.0, 4), [1.0, 1.5, 2.0, 2.5, 3.0]);
}

#[test]
fn a_hemisphere_has_two_pi_steradians_and_a_projected_area_of_pi() {
    let rule = GaussLegendre::new(16);
    let n = DVec3::new(0.36, 0.48, 0.8);
    for e in [n, DVec3::X, DVec3::new(0.0, 0.6, 0.8)] {
        assert_close(
            hemisphere(&rule, n, e, |_| 1.0),
            2.0 * PI,
            QUADRATURE_SMOOTH,
            "solid angle",
        );
        assert_close(
            hemisphere(&rule, n, e, |l| n.dot(l)),
            PI,
            QUADRATURE_SMOOTH,
            "projected area",
        );
    }
}

/// A Gaussian of the half vector's slope, whose integral both ways of placing nodes must find.
#[test]
fn half_vectors_and_directions_give_one_integral() {
    let rule = GaussLegendre::new(24);
    let n = DVec3::Z;
    let e = spherical(0.6, 0.0);
    let lobe = |l: DVec3| {
        let slope = angle(n, l + e).tan();
        (-slope * slope / 0.01).exp()
    };
    let by_half_vectors = half_vectors(&rule, n, e, 0.1, lobe);
    let phis = equal_breaks(0.0, 2.0 * PI, 16);
    let by_directions = rule.integrate(&equal_breaks(0.0, 0.5 * PI, 8), |theta| {
        theta.sin() * rule.integrate(&phis, |phi| lobe(spherical(theta, phi)))
    });
    assert_close(
        by_half_vectors,
        by_directions,
        QUADRATURE_SMOOTH,
        "Gaussian of slopes",
    );
}
