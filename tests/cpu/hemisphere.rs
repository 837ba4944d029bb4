//! Are the surroundings' two integrals what they stand for?

use std::f64::consts::PI;

use glam::DVec3;
use umber::math::frame::spherical;
use umber::math::quadrature::{GaussLegendre, half_vectors};
use umber::reference::beckmann::M_MIN;
use umber::reference::cook_torrance::lobe;
use umber::reference::hemisphere::{Surroundings, mean_radiance, mirrored_radiance, sky_share};

use crate::samples::{above, assert_close};
use crate::tolerances::{MIDPOINT_SUM, SAME_FORMULA, SKY_SHARE_RMS, SKY_SHARE_WORST};

const N: DVec3 = DVec3::Z;

/// The irradiance of a sky over a tilted plane, by a sum over the upper hemisphere.
#[test]
fn a_tilted_plane_sees_its_share_of_the_sky() {
    let around = Surroundings {
        sky: DVec3::ONE,
        ground: DVec3::ZERO,
    };
    let steps = 1000;
    for degrees in [0.0_f64, 30.0, 90.0, 150.0] {
        let theta = degrees.to_radians();
        let n = DVec3::new(theta.sin(), theta.cos(), 0.0);
        let mut irradiance = 0.0;
        for i in 0..steps {
            // Equal steps of height are equal areas of the sphere (Archimedes).
            let height = (f64::from(i) + 0.5) / f64::from(steps);
            let ring = (1.0 - height * height).sqrt();
            for j in 0..steps {
                let phi = 2.0 * PI * (f64::from(j) + 0.5) / f64::from(steps);
                let l = DVec3::new(ring * phi.cos(), height, ring * phi.sin());
                irradiance += n.dot(l).max(0.0);
            }
        }
        irradiance *= 2.0 * PI / f64::from(steps * steps);
        let difference = (irradiance / PI - mean_radiance(&around, n).x).abs();
        assert!(
            difference <= MIDPOINT_SUM,
            "{degrees} degrees: {difference:e}"
        );
    }
}

/// The share of the Cook-Torrance lobe (F = 1) that comes from above the horizon of `up`.
fn true_share(e: DVec3, up: DVec3, m: f64) -> f64 {
    let rule = GaussLegendre::new(8);
    let weight = |l| lobe(N, l, e, m, DVec3::ONE).x;
    // e lies in the plane y = 0, and half_vectors takes one half of the azimuths: the other mirrors it.
    let mirror = DVec3::new(1.0, -1.0, 1.0);
    let from_sky = half_vectors(&rule, N, e, m, |l| {
        let halves = [l, l * mirror];
        0.5 * weight(l) * halves.iter().filter(|l| l.dot(up) > 0.0).count() as f64
    });
    from_sky / half_vectors(&rule, N, e, m, weight)
}

#[test]
fn the_mirrored_sky_is_near_its_lobe() {
    let (mut squares, mut count) = (0.0, 0.0);
    for m in [0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0] {
        for view in [1.0_f64, 30.0, 60.0, 80.0] {
            let e = spherical(view.to_radians(), 0.0);
            for tilt in [0.0_f64, 20.0, 45.0, 70.0, 90.0, 120.0, 150.0, 180.0] {
                for azimuth in [0.0_f64, 90.0, 180.0] {
                    let up = spherical(tilt.to_radians(), azimuth.to_radians());
                    let difference = sky_share(N, e, up, m) - true_share(e, up, m);
                    let case = format!("m {m}, view {view}, tilt {tilt}, azimuth {azimuth}");
                    assert!(difference.abs() <= SKY_SHARE_WORST, "{case}: {difference}");
                    squares += difference * difference;
                    count += 1.0;
                }
            }
        }
    }
    let rms = f64::sqrt(squares / count);
    assert!(rms <= SKY_SHARE_RMS, "{rms}");
}

#[test]
fn a_smooth_mirror_sees_sky_above_and_ground_below() {
    let around = Surroundings {
        sky: DVec3::X,
        ground: DVec3::Y,
    };
    let m = M_MIN;
    for e in above() {
        let mirrored = mirrored_radiance(&around, DVec3::Z, e, m);
        let mirror_height = 2.0 * DVec3::Z.dot(e) * DVec3::Z.y - e.y;
        let expected = if mirror_height > 0.0 {
            around.sky
        } else {
            around.ground
        };
        // The step is m wide: at height y it is off by (m / y)^2 / 4.
        let allowed = (m / mirror_height).powi(2);
        assert!((mirrored - expected).length() <= allowed, "{e}: {mirrored}");
    }
}

#[test]
fn even_surroundings_are_mirrored_as_they_are() {
    let around = Surroundings {
        sky: DVec3::splat(3.0),
        ground: DVec3::splat(3.0),
    };
    for e in above() {
        assert_close(
            mirrored_radiance(&around, N, e, 0.4).x,
            3.0,
            SAME_FORMULA,
            "mirrored",
        );
        assert_close(mean_radiance(&around, e).x, 3.0, SAME_FORMULA, "mean");
    }
}
