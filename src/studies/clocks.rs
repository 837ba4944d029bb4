//! How long does an evaluation take, of several forms in turn?

use std::sync::Arc;

use crate::gpu::{Device, Error};
use crate::interface::ProbeInput;
use crate::math::statistics::{Interval, mad, median, paired_ratio};
use crate::render::library::{NOTHING, Tier};
use crate::render::probe::{Probe, ProbeClock};

/// Inputs of each invocation, each evaluated 16 times: some 8 million evaluations a sample of 2^16 inputs.
const REPEATS: u32 = 8;
/// Samples of each form.
const ROUNDS: usize = 21;

/// Times of an evaluation, ns, net of reading inputs and writing results: form by form, round by round.
pub struct Times(Vec<Vec<f64>>);

/// Measures all forms at and about the same inputs, one after the other in each round.
///
/// # Errors
/// There is no memory, or the driver fails.
pub fn times(device: &Arc<Device>, forms: &[Probe], inputs: &[ProbeInput]) -> Result<Times, Error> {
    let nothing = Probe::new(device, &NOTHING, Tier::F32)?;
    let nothing = nothing.clock(inputs, REPEATS)?;
    let clock = |form| Probe::clock(form, inputs, REPEATS);
    let clocks: Vec<ProbeClock> = forms.iter().map(clock).collect::<Result<_, _>>()?;
    // The first dispatch compiles.
    nothing.ns()?;
    for clock in &clocks {
        clock.ns()?;
    }
    let mut samples = vec![Vec::new(); clocks.len()];
    for _ in 0..ROUNDS {
        let base = nothing.ns()?;
        for (clock, samples) in clocks.iter().zip(&mut samples) {
            samples.push(clock.ns()? - base);
        }
    }
    Ok(Times(samples))
}

impl Times {
    /// The median of a form, ns.
    pub fn of(&self, form: usize) -> Option<f64> {
        median(&self.0[form])
    }

    /// The median distance of a form's samples from it.
    pub fn mad(&self, form: usize) -> Option<f64> {
        mad(&self.0[form])
    }

    /// A form over another, round by round.
    pub fn ratio(&self, form: usize, base: usize) -> Option<Interval> {
        let pairs = self.0[form].iter().zip(&self.0[base]);
        paired_ratio(&pairs.map(|(a, b)| (*a, *b)).collect::<Vec<_>>())
    }
}
