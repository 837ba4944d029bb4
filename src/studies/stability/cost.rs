//! What do the safe forms cost, of the slides' listings?

use std::sync::Arc;

use super::cases::CASES;
use crate::gpu::{Device, Error};
use crate::render::library::{Function, Tier};
use crate::render::probe::Probe;
use crate::report::{CostRow, Interval95};
use crate::studies::clocks::times;

/// Each function, and the listing that it stands for.
const PAIRS: [(&str, &str); 2] = [
    ("oren-nayar", "slides-oren-nayar"),
    ("cook-torrance", "slides-cook-torrance"),
];

/// Inputs above the surface, evaluated in turn.
const INPUTS: usize = 1 << 16;

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
    let mut probes = vec![Probe::new(device, listing, Tier::F32)?];
    for tier in safe.tiers {
        probes.push(Probe::new(device, safe, *tier)?);
    }
    // The first case: light and eye anywhere above the surface.
    let times = times(device, &probes, &CASES[0].inputs(1, INPUTS))?;
    let rows = safe.tiers.iter().enumerate().filter_map(|(i, tier)| {
        let ratio = times.ratio(1 + i, 0)?;
        Some(CostRow {
            function: safe.name.to_owned(),
            tier: tier.name().to_owned(),
            listing: listing.name.to_owned(),
            ns: times.of(1 + i)?,
            listing_ns: times.of(0)?,
            relative: ratio.estimate,
            relative_95: Interval95::from(ratio),
        })
    });
    Ok(rows.collect())
}
