//! Are medians what they should be, and do their intervals hold the truth as often as they say?

use umber::math::statistics::{
    Interval, mad, median, median_interval, paired_difference, paired_ratio, rank,
};

use crate::samples::assert_close;
use crate::tolerances::{BINOMIAL_DEVIATIONS, SAME_FORMULA};

/// The ranks for n = 6 to 50, summed with `fractions.Fraction` and `math.comb` of Python.
const RANKS: [usize; 45] = [
    1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 5, 5, 5, 6, 6, 6, 7, 7, 8, 8, 8, 9, 9, 10, 10, 10, 11, 11, 12,
    12, 13, 13, 13, 14, 14, 15, 15, 16, 16, 16, 17, 17, 18, 18,
];

/// Uniform in 0..1, both excluded: Steele, Lea and Flood's SplitMix64, 2014.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 12) as f64 / 2.0_f64.powi(52) + 2.0_f64.powi(-53)
    }
}

#[test]
fn a_median_is_the_middle() {
    assert_eq!(median(&[3.0, -1.0, 2.0]), Some(2.0));
    assert_eq!(median(&[4.0, 1.0, 3.0, 2.0]), Some(2.5));
    assert_eq!(median(&[7.0]), Some(7.0));
    assert_eq!(median(&[f64::MAX, f64::MAX]), Some(f64::MAX));
    assert_eq!(median(&[-0.0, 0.0]), Some(0.0));
}

#[test]
fn a_mad_is_the_middle_distance_unscaled() {
    // The distances from 2 are 1, 1, 0, 0, 2, 4, 7.
    assert_eq!(mad(&[1.0, 1.0, 2.0, 2.0, 4.0, 6.0, 9.0]), Some(1.0));
    assert_eq!(mad(&[5.0]), Some(0.0));
    // One wild value moves nothing.
    assert_eq!(mad(&[1.0, 2.0, 3.0, 4.0, 1.0e9]), Some(1.0));
}

#[test]
fn what_is_no_measurement_has_no_answer() {
    assert_eq!(median(&[]), None);
    assert_eq!(mad(&[]), None);
    assert_eq!(paired_ratio(&[]), None);
    assert_eq!(paired_difference(&[]), None);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(median(&[1.0, bad, 2.0]), None);
        assert_eq!(mad(&[1.0, bad, 2.0]), None);
        assert_eq!(paired_ratio(&[(1.0, 1.0), (bad, 1.0)]), None);
        assert_eq!(paired_difference(&[(1.0, 1.0), (1.0, bad)]), None);
    }
    assert_eq!(paired_ratio(&[(1.0, 0.0)]), None);
    assert_eq!(paired_ratio(&[(0.0, 0.0)]), None);
}

#[test]
fn the_ranks_are_the_exact_binomial_s() {
    for n in 0..6 {
        assert_eq!(rank(n), None, "n = {n}");
    }
    for (n, want) in (6..).zip(RANKS) {
        assert_eq!(rank(n).map(|(rank, _)| rank), Some(want), "n = {n}");
    }
    // The same fractions; at 2000, 2^-n is beyond f64.
    for (n, want, coverage) in [
        (6, 1, 0.96875),
        (9, 2, 0.9609375),
        (20, 6, 0.9586105346679688),
        (50, 18, 0.9671608624357315),
        (2000, 956, 0.9534471795082162),
    ] {
        let (rank, reached) = rank(n).expect("bounds");
        assert_eq!(rank, want, "n = {n}");
        assert_close(reached, coverage, SAME_FORMULA, "coverage");
    }
}

#[test]
fn the_bounds_are_order_statistics() {
    let values: Vec<f64> = (1..=9).rev().map(f64::from).collect();
    let nine = median_interval(&values).expect("an interval");
    assert_eq!((nine.estimate, nine.low, nine.high), (5.0, 2.0, 8.0));
    assert_close(nine.coverage, 0.9609375, SAME_FORMULA, "coverage");
    for (x, inside) in [(1.9, false), (2.0, true), (8.0, true), (8.1, false)] {
        assert_eq!(nine.contains(x), inside, "{x}");
    }
    assert!(!nine.contains(f64::NAN));
}

#[test]
fn five_pairs_bound_nothing() {
    let five = paired_ratio(&[(2.0, 1.0); 5]).expect("an estimate");
    let unbounded = Interval {
        estimate: 2.0,
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
        coverage: 1.0,
    };
    assert_eq!(five, unbounded);
    assert!(five.contains(1.0e300) && five.contains(-1.0e300));
    let six = paired_ratio(&[(2.0, 1.0); 6]).expect("an estimate");
    assert_eq!((six.low, six.high), (2.0, 2.0));
}

/// A drift that both members of a pair share is no part of their ratio.
#[test]
fn pairs_cancel_what_they_share() {
    let pairs: Vec<(f64, f64)> = (0..12)
        .map(|k| 2.0_f64.powi(k))
        .map(|drift| (3.0 * drift, 2.0 * drift))
        .collect();
    let ratio = paired_ratio(&pairs).expect("an interval");
    assert_eq!((ratio.low, ratio.estimate, ratio.high), (1.5, 1.5, 1.5));
}

#[test]
fn scales_and_swaps_carry_over() {
    let mut random = Random(1);
    let pairs: Vec<(f64, f64)> = (0..15)
        .map(|_| (random.next() + 1.0, random.next() + 1.0))
        .collect();
    // A power of two scales without rounding.
    let scaled: Vec<(f64, f64)> = pairs.iter().map(|(a, b)| (a * 8.0, b * 8.0)).collect();
    assert_eq!(paired_ratio(&scaled), paired_ratio(&pairs));
    let difference = paired_difference(&pairs).expect("an interval");
    let larger = Interval {
        estimate: difference.estimate * 8.0,
        low: difference.low * 8.0,
        high: difference.high * 8.0,
        coverage: difference.coverage,
    };
    assert_eq!(paired_difference(&scaled), Some(larger));
    let swapped: Vec<(f64, f64)> = pairs.iter().map(|(a, b)| (*b, *a)).collect();
    let opposite = Interval {
        estimate: -difference.estimate,
        low: -difference.high,
        high: -difference.low,
        coverage: difference.coverage,
    };
    assert_eq!(paired_difference(&swapped), Some(opposite));
}

/// Exponential values, whose median is ln 2: far from symmetric, as timings are.
#[test]
fn an_interval_holds_the_truth_as_often_as_it_says() {
    let trials = 20_000;
    let truth = 2.0_f64.ln();
    for n in [6, 9, 20, 31] {
        let mut random = Random(n as u64);
        let mut held = 0;
        let mut coverage = 0.0;
        for _ in 0..trials {
            let pairs: Vec<(f64, f64)> = (0..n)
                .map(|_| (1.0 - random.next().ln(), random.next()))
                .map(|(x, b)| (x * b, b))
                .collect();
            let interval = paired_ratio(&pairs).expect("an interval");
            held += i32::from(interval.contains(1.0 + truth));
            coverage = interval.coverage;
        }
        let share = f64::from(held) / f64::from(trials);
        let deviation = (coverage * (1.0 - coverage) / f64::from(trials)).sqrt();
        assert!(
            (share - coverage).abs() < BINOMIAL_DEVIATIONS * deviation,
            "n = {n}: {share} of the intervals hold the truth, not {coverage}"
        );
    }
}
