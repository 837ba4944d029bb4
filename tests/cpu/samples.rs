//! At which directions are the lighting models tried?

use glam::DVec3;
use umber::math::frame::spherical;

/// Unit directions above the plane of +Z, 1 to 89.5 degrees from it and all around, none the mirror of another.
pub fn above() -> Vec<DVec3> {
    let mut directions = Vec::new();
    for degrees in [1.0_f64, 10.0, 27.0, 45.0, 60.0, 75.0, 85.0, 89.5] {
        for azimuth in 0..6 {
            directions.push(spherical(
                degrees.to_radians(),
                f64::from(azimuth) * 1.1 + degrees,
            ));
        }
    }
    directions
}

/// Each pair of directions of `above`, light first.
pub fn pairs() -> impl Iterator<Item = (DVec3, DVec3)> {
    above()
        .into_iter()
        .flat_map(|l| above().into_iter().map(move |e| (l, e)))
}

/// Angles of the eye to the normal, in radians, 0 to 89.9 degrees, denser towards grazing.
pub fn view_angles() -> impl Iterator<Item = f64> {
    [
        0.0_f64, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 75.0, 80.0, 85.0, 88.0, 89.0, 89.5, 89.9,
    ]
    .into_iter()
    .map(f64::to_radians)
}

/// Fails unless `actual` is within `relative` of `expected`.
#[track_caller]
pub fn assert_close(actual: f64, expected: f64, relative: f64, what: &str) {
    assert!(
        (actual - expected).abs() <= relative * expected.abs(),
        "{what}: {actual:e} instead of {expected:e}, more than {relative:e} off"
    );
}
