//! Has Blinn's highlight Beckmann's width, and how near is it to giving back the light that it gets?

use glam::DVec3;
use umber::math::frame::spherical;
use umber::math::quadrature::{GaussLegendre, half_vectors};
use umber::reference::blinn_phong::{exponent, lobe};

use crate::samples::pairs;
use crate::tolerances::BLINN_NORMALISATION;

const N: DVec3 = DVec3::Z;

#[test]
fn straight_on_it_gives_back_about_what_it_gets() {
    let rule = GaussLegendre::new(16);
    for m in [0.05, 0.1, 0.3, 0.6] {
        let back = half_vectors(&rule, N, N, m, |l| lobe(N, l, N, m));
        assert!((back - 1.0).abs() <= BLINN_NORMALISATION, "{m}: {back}");
    }
}

#[test]
fn its_highlight_is_as_wide_as_beckmanns() {
    assert_eq!((exponent(1.0), exponent(0.5)), (0.0, 6.0));
    // At a slope of m both have fallen to 1/e of their peak.
    let m = 0.05;
    let tilted = spherical(2.0 * f64::atan(m), 0.0);
    let fallen = lobe(N, tilted, N, m) / lobe(N, N, N, m) / N.dot(tilted);
    assert!((fallen - (-1.0_f64).exp()).abs() < 0.01, "{fallen}");
}

#[test]
fn only_the_cosine_of_the_light_tells_it_from_the_eye() {
    for (l, e) in pairs() {
        let (there, back) = (lobe(N, l, e, 0.4) * N.dot(e), lobe(N, e, l, 0.4) * N.dot(l));
        assert!((there - back).abs() <= 1e-12 * there.abs());
        assert_eq!(lobe(N, -l, e, 0.4), 0.0);
    }
}
