//! Does what bounces between facets fill up what one bounce loses: at the table's nodes, and between them?

use glam::DVec3;
use umber::math::frame::spherical;
use umber::math::quadrature::{GaussLegendre, hemisphere};
use umber::reference::ggx;
use umber::reference::kulla_conty::{ROWS, TABLE, albedo, lobe, scale};

use crate::samples::{assert_close, pairs};
use crate::tolerances::{GGX_FURNACE, QUADRATURE_KINKED, SAME_FORMULA};

const N: DVec3 = DVec3::Z;

/// The integral by slopes against the lobe's own over directions.
#[test]
fn the_albedo_is_the_lobes() {
    let rule = GaussLegendre::new(96);
    for (alpha, theta) in [(1.0, 0.3_f64), (0.6, 1.2), (0.5, 0.9)] {
        let e = spherical(theta, 0.0);
        let sum = hemisphere(&rule, N, e, |l| ggx::lobe(N, l, e, alpha));
        assert!(
            (sum - albedo(theta.cos(), alpha)).abs() <= QUADRATURE_KINKED,
            "{alpha}, {theta}"
        );
    }
}

/// 2 int (1 - E) mu dmu by the table, by a rule that knows nothing of its nodes.
fn mean(alpha: f64) -> f64 {
    let rule = GaussLegendre::new(24);
    let breaks = [0.0, 1e-4, 1e-3, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0];
    rule.integrate(&breaks, |mu| 2.0 * mu * TABLE.missing(mu, alpha))
}

/// With F = 1, one bounce gives E back, and what is missing comes as often as the table says.
#[test]
fn no_light_is_lost_at_nodes_and_between() {
    let mut worst = (0.0_f64, 0.0, 0.0);
    for i in 0..3 * (ROWS - 1) {
        let alpha = ((i as f64 + 0.5) / (3 * (ROWS - 1)) as f64)
            .powi(2)
            .max(1.0e-3);
        let again = mean(alpha) / TABLE.mean(alpha);
        for j in 0..80 {
            // From a ten-thousandth on, evenly in its logarithm.
            let mu = 10.0_f64.powf(-4.0 * f64::from(j) / 80.0);
            let off = (albedo(mu, alpha) + TABLE.missing(mu, alpha) * again - 1.0).abs();
            if off > worst.0 {
                worst = (off, alpha, mu);
            }
        }
    }
    println!("the table is off by {worst:?}");
    assert!(worst.0 <= GGX_FURNACE, "{worst:?}");
}

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
