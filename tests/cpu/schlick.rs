//! Does Schlick's reflectance have its limits, and how near is it to Fresnel's?

use glam::DVec3;
use umber::reference::schlick::{f, f_rough, f90};

use crate::tolerances::{SAME_FORMULA, SCHLICK_GLASS};

const GOLD: DVec3 = DVec3::new(1.0, 0.78, 0.34);

#[test]
fn reflectance_runs_from_f0_to_one() {
    for f0 in [DVec3::splat(0.02), DVec3::splat(0.04), GOLD, DVec3::ONE] {
        assert_eq!(f(f0, 1.0), f0);
        assert_eq!(f(f0, 0.0), DVec3::ONE);
    }
}

#[test]
fn reflectance_only_grows_towards_grazing_and_stays_a_share() {
    for f0 in [DVec3::ZERO, DVec3::splat(0.001), DVec3::splat(0.04), GOLD] {
        let mut before = f0;
        for step in (0..=1000).rev() {
            let now = f(f0, f64::from(step) / 1000.0);
            assert!(
                now.cmpge(before).all() && now.cmple(DVec3::ONE).all(),
                "{now}"
            );
            before = now;
        }
    }
}

#[test]
fn no_interface_reflects_nothing() {
    for cos in [0.0, 0.3, 1.0] {
        assert_eq!(f(DVec3::ZERO, cos), DVec3::ZERO);
        assert_eq!(f_rough(DVec3::ZERO, 0.5, cos), DVec3::ZERO);
    }
    assert_eq!(f90(DVec3::splat(0.01)), 0.5);
    assert_eq!(f90(DVec3::new(0.0, 0.02, 0.0)), 1.0);
}

#[test]
fn a_rough_interface_reflects_no_more_than_a_smooth_one() {
    for f0 in [DVec3::splat(0.001), DVec3::splat(0.04), GOLD] {
        for step in 0..=100 {
            let cos = f64::from(step) / 100.0;
            assert_eq!(f_rough(f0, 0.0, cos), f(f0, cos));
            assert!(f_rough(f0, 0.7, cos).cmple(f(f0, cos)).all());
            assert!(f_rough(f0, 1.0, cos).cmpge(f0).all());
        }
    }
}

/// Fresnel's equations for unpolarised light from air into a clear medium.
fn fresnel(index: f64, cos: f64) -> f64 {
    let refracted = (1.0 - (1.0 - cos * cos) / (index * index)).sqrt();
    let s = (cos - index * refracted) / (cos + index * refracted);
    let p = (index * cos - refracted) / (index * cos + refracted);
    0.5 * (s * s + p * p)
}

#[test]
fn glass_is_near_fresnel() {
    let f0 = DVec3::splat(fresnel(1.5, 1.0));
    assert!((f0.x - 0.04).abs() < SAME_FORMULA);
    for step in 0..=1000 {
        let cos = f64::from(step) / 1000.0;
        let difference = (f(f0, cos).x - fresnel(1.5, cos)).abs();
        assert!(difference <= SCHLICK_GLASS, "{difference} at cosine {cos}");
    }
}
