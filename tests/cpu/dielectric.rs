//! Does a clear interface reflect what Fresnel says?

use umber::reference::dielectric::f;

use crate::samples::assert_close;
use crate::tolerances::{FOUR_DECIMALS, SAME_FORMULA};

#[test]
fn straight_on_it_is_f0_and_at_grazing_all() {
    for f0 in [0.0, 1.0e-6, 0.02, 0.04, 0.5, 0.999] {
        assert!((f(f0, 1.0) - f0).abs() <= SAME_FORMULA, "{f0}");
    }
    assert_eq!((f(0.04, 0.0), f(0.0, 0.0), f(1.0, 0.3)), (1.0, 0.0, 1.0));
}

/// At Brewster's angle, tan = n, only one polarisation is left: ((n^2 - 1) / (n^2 + 1))^2 / 2.
#[test]
fn at_brewsters_angle_half_of_it_is_gone() {
    for index in [1.33_f64, 1.5, 2.4] {
        let f0 = ((index - 1.0) / (index + 1.0)).powi(2);
        let mu = index.atan().cos();
        let n2 = index * index;
        let want = 0.5 * ((n2 - 1.0) / (n2 + 1.0)).powi(2);
        assert_close(f(f0, mu), want, SAME_FORMULA, "Brewster");
    }
}

/// Glass of 1.5 at 60 degrees: 0.0892 (any table of optics).
#[test]
fn glass_is_as_the_tables_have_it() {
    assert!(
        (f(0.04, 0.5) - 0.0892).abs() <= FOUR_DECIMALS,
        "{}",
        f(0.04, 0.5)
    );
}
