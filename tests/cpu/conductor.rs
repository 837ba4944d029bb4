//! Does a metal reflect what Fresnel's complex equations say?

use umber::reference::{conductor, dielectric};

use crate::samples::assert_close;
use crate::tolerances::{SAME_FORMULA, SAME_FORMULA_CANCELLING};

#[test]
fn straight_on_it_has_the_closed_form() {
    for (n, k) in [(0.226, 3.192), (1.314, 7.296), (2.9, 3.0), (1.5, 0.0)] {
        let want = ((n - 1.0) * (n - 1.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k);
        assert_close(conductor::f(n, k, 1.0), want, SAME_FORMULA, "normal");
        assert_close(conductor::f(n, k, 0.0), 1.0, SAME_FORMULA, "grazing");
    }
}

#[test]
fn without_extinction_it_is_clear() {
    for step in 1..=100 {
        let mu = f64::from(step) / 100.0;
        let clear = dielectric::f(0.04, mu);
        assert_close(
            conductor::f(1.5, 0.0, mu),
            clear,
            SAME_FORMULA_CANCELLING,
            "k = 0",
        );
    }
}

#[test]
fn it_is_a_share() {
    for n in [0.04, 0.5, 1.0, 3.0, 10.0] {
        for k in [0.0, 0.1, 2.0, 10.0] {
            for step in 0..=50 {
                let f = conductor::f(n, k, f64::from(step) / 50.0);
                assert!((0.0..=1.0 + SAME_FORMULA).contains(&f), "{n}, {k}: {f}");
            }
        }
    }
}
