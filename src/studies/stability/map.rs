//! Where over roughness and angle does a function lose its bits?

use fastrand::Rng;

use super::cases::lit_from;
use super::judge::Judgement;
use super::truth::Truth;
use crate::gpu::Error;
use crate::render::library::{Function, Tier};
use crate::render::probe::Probe;
use crate::report::BitsMap;

/// Columns, from roughness 1e-4 to 1.
const COLUMNS: usize = 29;
/// Rows, 5 degrees apart; the last stands just above the surface.
const ROWS: usize = 19;
const LAST_ROW: f64 = 89.5;
/// Inputs of a cell.
const INPUTS: usize = 48;

/// Evaluates a grid.
///
/// # Errors
/// There is no memory, or the driver fails.
pub fn map(
    probe: &Probe,
    truth: &Truth,
    (function, tier): (&Function, Tier),
    seed: u64,
) -> Result<BitsMap, Error> {
    let roughness: Vec<f64> = (0..COLUMNS)
        .map(|i| 10_f64.powf(-4.0 + 4.0 * i as f64 / (COLUMNS - 1) as f64))
        .collect();
    let degrees: Vec<f64> = (0..ROWS).map(|j| (5.0 * j as f64).min(LAST_ROW)).collect();
    let mut rng = Rng::with_seed(seed);
    let mut inputs = Vec::with_capacity(COLUMNS * ROWS * INPUTS);
    for angle in &degrees {
        for m in &roughness {
            let cosine = angle.to_radians().cos() as f32;
            let one = || lit_from(cosine, *m as f32, truth.has_peak(), &mut rng);
            inputs.extend(std::iter::repeat_with(one).take(INPUTS));
        }
    }
    super::with_extra(function, &mut inputs, seed);
    let results = probe.at(&inputs)?;
    let pairs: Vec<_> = inputs.into_iter().zip(results).collect();
    let cells: Vec<Judgement> = pairs
        .chunks(INPUTS)
        .map(|cell| {
            let mut judgement = Judgement::default();
            for pair in cell {
                judgement.add(truth, tier, pair, 1);
            }
            judgement
        })
        .collect();
    let rows = || cells.chunks(COLUMNS);
    let bits = |cell: &Judgement| (cell.judged > 0).then(|| cell.bits_lost());
    Ok(BitsMap {
        function: function.name.to_owned(),
        tier: tier.name().to_owned(),
        bits: rows().map(|row| row.iter().map(bits).collect()).collect(),
        bad: rows()
            .map(|row| row.iter().map(|cell| cell.bad() as u32).collect())
            .collect(),
        roughness,
        degrees,
    })
}
