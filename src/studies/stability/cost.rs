//! What do the safe forms cost, of the slides' listings?

use std::sync::Arc;

use super::cases::CASES;
use crate::gpu::{Device, Error};
use crate::math::statistics::{median, paired_ratio};
use crate::render::library::{Function, NOTHING, Tier};
use crate::render::probe::{Probe, ProbeClock};
use crate::report::{CostRow, Interval95};

/// Each function, and the listing that it stands for.
const PAIRS: [(&str, &str); 2] = [
    ("oren-nayar", "slides-oren-nayar"),
    ("cook-torrance", "slides-cook-torrance"),
];

/// Inputs above the surface, evaluated in turn.
const INPUTS: usize = 1 << 16;
/// Inputs of each invocation, each evaluated 16 times: some 8 million evaluations a sample.
const REPEATS: u32 = 8;
/// Samples of each form, taken in turn.
const ROUNDS: usize = 21;

/// The costs of all safe forms, net of reading inputs and writing results.
///
/// # Errors
/// There is no memory, or the driver fails.
pub fn costs(device: &Arc<Device>) -> Result<Vec<CostRow>, Error> {
    let mut rows = Vec::new();
    for (name, listing) in PAIRS {
        let named = (Function::of_name(name), Function::of_name(listing));
        let (Ok(safe), Ok(listing)) = named else {
            continue;
        };
        rows.extend(of_pair(device, safe, listing)?);
    }
    Ok(rows)
}

fn of_pair(
    device: &Arc<Device>,
    safe: &'static Function,
    listing: &'static Function,
) -> Result<Vec<CostRow>, Error> {
    let probe = |function, tier| Probe::new(device, function, tier);
    let mut probes = vec![probe(&NOTHING, Tier::F32)?, probe(listing, Tier::F32)?];
    for tier in safe.tiers {
        probes.push(probe(safe, *tier)?);
    }
    // The first case: light and eye anywhere above the surface.
    let inputs = CASES[0].inputs(1, INPUTS);
    let clock = |probe| Probe::clock(probe, &inputs, REPEATS);
    let clocks: Vec<ProbeClock> = probes.iter().map(clock).collect::<Result<_, _>>()?;
    // The first dispatch compiles.
    clocks.iter().try_for_each(|clock| clock.ns().map(|_| ()))?;
    let mut samples = vec![Vec::new(); clocks.len()];
    for _ in 0..ROUNDS {
        for (clock, samples) in clocks.iter().zip(&mut samples) {
            samples.push(clock.ns()?);
        }
    }
    let net = |form: usize| -> Vec<f64> {
        let nothing = samples[0].iter();
        samples[form]
            .iter()
            .zip(nothing)
            .map(|(a, b)| a - b)
            .collect()
    };
    let of_listing = net(1);
    let rows = safe.tiers.iter().enumerate().filter_map(|(i, tier)| {
        let own = net(2 + i);
        let pairs: Vec<_> = own
            .iter()
            .copied()
            .zip(of_listing.iter().copied())
            .collect();
        let ratio = paired_ratio(&pairs)?;
        Some(CostRow {
            function: safe.name.to_owned(),
            tier: tier.name().to_owned(),
            listing: listing.name.to_owned(),
            ns: median(&own)?,
            listing_ns: median(&of_listing)?,
            relative: ratio.estimate,
            relative_95: Interval95::from(ratio),
        })
    });
    Ok(rows.collect())
}
