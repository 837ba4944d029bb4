//! How long does an evaluation of each form take, in the compute probe?

use std::sync::Arc;

use crate::gpu::{Device, Error, Statistic};
use crate::interface::ProbeInput;
use crate::math::statistics::Interval;
use crate::reference::shade::{Lighting, Terms};
use crate::render::Variant;
use crate::render::library::MODEL;
use crate::render::probe::Probe;
use crate::studies::clocks::times;
use crate::studies::stability::{CASES, with_extra};

/// A form's time, net of reading inputs and writing results.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// Median, ns.
    pub ns: f64,
    /// Median distance from it.
    pub ns_mad: f64,
    /// Over the slides' listings, round by round.
    pub of_slides: Interval,
    /// What the driver tells of its code.
    pub statistics: Vec<Statistic>,
}

/// What all are compared with: the slides' listings, to the letter.
pub const SLIDES: Variant = Variant {
    lighting: Lighting::Slides,
    terms: Terms::ALL,
};

/// Forms that take turns with the listings; more would stand too far from them in time.
const TOGETHER: usize = 12;

/// Inputs: half a million evaluations a sample, some milliseconds of a CPU.
pub const INPUTS: usize = 1 << 12;

/// Measures each form beside the slides' listings, at so many inputs. `progress` hears of each.
///
/// # Errors
/// There is no memory, or the driver fails.
pub fn evaluations(
    device: &Arc<Device>,
    variants: &[Variant],
    inputs: usize,
    progress: &dyn Fn(),
) -> Result<Vec<Evaluation>, Error> {
    let inputs = drawn(inputs);
    let mut all = Vec::new();
    for some in variants.chunks(TOGETHER) {
        let forms = [SLIDES].into_iter().chain(some.iter().copied());
        let probes: Vec<Probe> = forms
            .map(|variant| Probe::of_model(device, variant))
            .collect::<Result<_, _>>()?;
        let times = times(device, &probes, &inputs)?;
        for (form, probe) in probes.iter().enumerate().skip(1) {
            all.push(Evaluation {
                ns: times.of(form).unwrap_or(f64::NAN),
                ns_mad: times.mad(form).unwrap_or(f64::NAN),
                of_slides: times.ratio(form, 0).unwrap_or(Interval::UNKNOWN),
                statistics: probe.statistics()?,
            });
            progress();
        }
    }
    Ok(all)
}

/// Light and eye anywhere above the surface, and any material.
fn drawn(count: usize) -> Vec<ProbeInput> {
    let mut inputs = CASES[0].inputs(1, count);
    with_extra(&MODEL, &mut inputs, 1);
    inputs
}
