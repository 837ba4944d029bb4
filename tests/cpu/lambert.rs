//! Is a smooth base Lambert's?

use std::f64::consts::PI;

use glam::DVec3;
use umber::math::quadrature::{GaussLegendre, hemisphere};
use umber::reference::lambert::lobe;

use crate::samples::{above, assert_close};
use crate::tolerances::QUADRATURE_SMOOTH;

const N: DVec3 = DVec3::Z;

#[test]
fn all_light_comes_back_and_none_from_below() {
    let e = DVec3::new(0.6, 0.0, 0.8);
    let albedo = hemisphere(&GaussLegendre::new(16), N, e, |l| lobe(N, l)) / PI;
    assert_close(albedo, 1.0, QUADRATURE_SMOOTH, "albedo");
    for l in above() {
        assert_eq!(lobe(N, l), N.dot(l));
        assert_eq!(lobe(N, -l), 0.0);
    }
}
