//! Is F82 Schlick's with a tint of 1, and what the tint says at 82 degrees?

use glam::DVec3;
use umber::reference::f82::{COSINE, f};
use umber::reference::schlick;

use crate::samples::assert_close;
use crate::tolerances::SAME_FORMULA;

const COPPER: DVec3 = DVec3::new(0.93, 0.63, 0.52);

#[test]
fn a_white_tint_is_schlick() {
    for step in 0..=100 {
        let mu = f64::from(step) / 100.0;
        assert_eq!(f(COPPER, DVec3::ONE, mu), schlick::f(COPPER, mu));
    }
}

#[test]
fn at_82_degrees_it_is_the_tint_and_at_both_ends_schlick() {
    let tint = DVec3::new(0.9, 0.5, 0.0);
    let there = f(COPPER, tint, COSINE);
    let schlick = schlick::f(COPPER, COSINE);
    for channel in 0..3 {
        let want = tint[channel] * schlick[channel];
        assert!((there[channel] - want).abs() <= SAME_FORMULA, "{there}");
    }
    assert_close(f(COPPER, tint, 1.0).x, COPPER.x, SAME_FORMULA, "normal");
    assert_eq!(f(COPPER, tint, 0.0), DVec3::ONE);
}

#[test]
fn nothing_falls_below_nothing() {
    for step in 0..=1000 {
        let mu = f64::from(step) / 1000.0;
        assert!(
            f(DVec3::splat(0.04), DVec3::ZERO, mu)
                .cmpge(DVec3::ZERO)
                .all()
        );
    }
}
