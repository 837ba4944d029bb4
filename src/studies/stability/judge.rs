//! What do values and their truths add up to?

use super::truth::Truth;
use crate::interface::{ProbeInput, ProbeResult};
use crate::render::library::Tier;

/// What was seen so far of one function in one tier and case.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Judgement {
    /// Values made.
    pub inputs: u64,
    /// Of which NaN.
    pub nans: u64,
    /// Of which infinite.
    pub infinities: u64,
    /// Of which below 0.
    pub negatives: u64,
    /// Values held against the truth.
    pub judged: u64,
    /// Their relative errors' sum.
    error_sum: f64,
    /// The largest relative error.
    pub largest_error: f64,
    /// The largest error over what is promised there.
    pub of_bound: f64,
    /// The largest error in units of the last place of the truth.
    pub largest_ulp: f64,
    /// The input of the value that is no number or below 0, or else of the largest share of its bound.
    pub worst: Option<ProbeInput>,
    worst_is_bad: bool,
}

impl Judgement {
    /// Counts an invocation's `values` of which one is kept, and judges that one: how much of what is allowed it takes, 0 where
    /// nothing is promised, infinitely much where a value is none or below 0.
    pub fn add(
        &mut self,
        truth: &Truth,
        tier: Tier,
        (input, result): &(ProbeInput, ProbeResult),
        values: u32,
    ) -> f64 {
        self.inputs += u64::from(values);
        self.nans += u64::from(result.nans);
        self.infinities += u64::from(result.infinities);
        self.negatives += u64::from(result.negatives);
        if result.nans + result.infinities + result.negatives > 0 {
            if !self.worst_is_bad {
                (self.worst, self.worst_is_bad) = (Some(*input), true);
            }
            return f64::INFINITY;
        }
        truth.bound(tier, input).map_or(0.0, |bound| {
            self.judge(input, f64::from(result.value), truth.at(input), bound)
        })
    }

    fn judge(&mut self, input: &ProbeInput, value: f64, want: f64, bound: f64) -> f64 {
        let off = (value - want).abs();
        // Where nothing is reflected, nothing may be given.
        let error = if off == 0.0 { 0.0 } else { off / want.abs() };
        self.judged += 1;
        self.error_sum += error;
        self.largest_error = self.largest_error.max(error);
        self.largest_ulp = self.largest_ulp.max(off / ulp(want));
        let share = error / bound;
        if share > self.of_bound || self.worst.is_none() {
            self.of_bound = share;
            if !self.worst_is_bad {
                self.worst = Some(*input);
            }
        }
        share
    }

    /// The mean of the relative errors; none where nothing was judged.
    pub fn mean_error(&self) -> Option<f64> {
        (self.judged > 0).then(|| self.error_sum / self.judged as f64)
    }

    /// How many bits of a float's 24 are wrong at worst: log2 of 1 and the largest error in units of the last place.
    pub fn bits_lost(&self) -> f64 {
        (1.0 + self.largest_ulp).log2()
    }

    /// Values that are no number or below 0.
    pub fn bad(&self) -> u64 {
        self.nans + self.infinities + self.negatives
    }
}

/// The distance of neighbouring 32-bit floats at `x`.
fn ulp(x: f64) -> f64 {
    // 2^-149 is the least float above 0; a normal one has 23 bits behind the first.
    let exponent = x.abs().max(f64::from(f32::MIN_POSITIVE)).log2().floor();
    (exponent - 23.0).exp2()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::library::Function;

    fn noon() -> ProbeInput {
        ProbeInput {
            normal: [0.0, 1.0, 0.0],
            roughness: 0.5,
            light: [0.0, 1.0, 0.0],
            f0: 0.04,
            eye: [0.0, 1.0, 0.0],
            place: 0,
            extra: [0.0; 4],
        }
    }

    fn judged(value: f32, bad: [u32; 3]) -> Judgement {
        let truth = Truth::of(Function::of_name("v-cavity-g").expect("it is there"));
        let mut judgement = Judgement::default();
        let [nans, infinities, negatives] = bad;
        let result = ProbeResult {
            value,
            nans,
            infinities,
            negatives,
        };
        judgement.add(&truth, Tier::F32, &(noon(), result), 100);
        judgement
    }

    #[test]
    fn a_value_is_held_against_the_truth() {
        let right = judged(1.0, [0; 3]);
        assert_eq!((right.inputs, right.judged, right.bad()), (100, 1, 0));
        assert_eq!((right.largest_error, right.bits_lost()), (0.0, 0.0));
        let off = judged(1.0 + 3.0 * f32::EPSILON, [0; 3]);
        assert_eq!((off.largest_ulp, off.bits_lost()), (3.0, 2.0));
        assert_eq!(off.mean_error(), Some(off.largest_error));
        assert_eq!(off.worst, Some(noon()));
    }

    #[test]
    fn what_is_no_number_is_counted_and_not_judged() {
        let bad = judged(f32::NAN, [1, 2, 3]);
        assert_eq!((bad.nans, bad.infinities, bad.negatives), (1, 2, 3));
        assert_eq!((bad.judged, bad.mean_error()), (0, None));
        assert_eq!(bad.worst, Some(noon()));
    }

    #[test]
    fn a_last_place_is_that_of_its_octave() {
        assert_eq!(ulp(1.0), f64::from(f32::EPSILON));
        assert_eq!(ulp(1.99), f64::from(f32::EPSILON));
        assert_eq!(ulp(-2.0), 2.0 * f64::from(f32::EPSILON));
        assert_eq!(ulp(0.0), 2.0_f64.powi(-149));
    }
}
