//! Does what bounces between facets obey reciprocity and the facets' own loss?

use glam::DVec3;
use umber::reference::kulla_conty::{lobe, scale};

use crate::samples::{assert_close, pairs};
use crate::tolerances::SAME_FORMULA;

const N: DVec3 = DVec3::Z;

#[test]
fn light_and_eye_may_change_places() {
    let mean = DVec3::new(1.0, 0.7, 0.04);
    for (l, e) in pairs() {
        let there = lobe(N, l, e, 0.5, mean) * N.dot(e);
        let back = lobe(N, e, l, 0.5, mean) * N.dot(l);
        for channel in 0..3 {
            assert_close(back[channel], there[channel], SAME_FORMULA, "reciprocity");
        }
    }
}

#[test]
fn facets_that_reflect_less_send_less_on() {
    assert_eq!(scale(0.4, DVec3::ONE), DVec3::ONE);
    assert_eq!(scale(0.4, DVec3::ZERO), DVec3::ZERO);
    // 0.5^2 0.6 / (1 - 0.2)
    assert_close(
        scale(0.4, DVec3::splat(0.5)).x,
        0.1875,
        SAME_FORMULA,
        "half",
    );
}
