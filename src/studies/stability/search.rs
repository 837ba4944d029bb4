//! How bad can it get: what is found by climbing from the worst inputs, float by float?

use fastrand::Rng;

use super::judge::Judgement;
use super::truth::Truth;
use crate::gpu::Error;
use crate::interface::ProbeInput;
use crate::render::library::{Function, Tier};
use crate::render::probe::{Chance, Probe};

/// Inputs from which it climbs at once: enough that one hill does not decide.
const CLIMBERS: usize = 64;
/// Steps that each tries in a round.
const TRIES: usize = 64;
/// Rounds without a worse input, after which nothing worse is expected.
const PATIENCE: u32 = 10;
/// Rounds at most: a step of the last place a round could go on for years.
const MOST_ROUNDS: u32 = 200;
/// A step changes up to this many bits from the last on.
const BITS: u32 = 22;

/// One input, and how much of its bound the value there takes.
type Found = (ProbeInput, f64);

/// Climbs until the largest share of a bound stops growing; judges every value on the way.
///
/// # Errors
/// There is no memory, or the driver fails.
pub fn search(
    probe: &Probe,
    truth: &Truth,
    (function, tier): (&Function, Tier),
    seed: u64,
    progress: &dyn Fn(u64),
) -> Result<Judgement, Error> {
    let mut rng = Rng::with_seed(seed);
    let mut judgement = Judgement::default();
    let start = probe.drawn(Chance::Worst, seed as u32, (0, 4096), 16)?;
    let (inputs, _): (Vec<_>, Vec<_>) = start.into_iter().unzip();
    let mut front = best(evaluated(probe, truth, tier, inputs, &mut judgement)?);
    let mut waited = 0;
    for _ in 0..MOST_ROUNDS {
        let before = front.first().map_or(0.0, |found| found.1);
        let steps = front.iter().flat_map(|(input, _)| {
            let input = *input;
            (0..TRIES).map(move |_| input)
        });
        let steps: Vec<_> = steps
            .map(|input| stepped(function, input, &mut rng))
            .collect();
        progress(steps.len() as u64);
        let found = evaluated(probe, truth, tier, steps, &mut judgement)?;
        front = best(front.into_iter().chain(found).collect());
        let after = front.first().map_or(0.0, |found| found.1);
        waited = if after > before { 0 } else { waited + 1 };
        if waited == PATIENCE {
            break;
        }
    }
    Ok(judgement)
}

fn evaluated(
    probe: &Probe,
    truth: &Truth,
    tier: Tier,
    inputs: Vec<ProbeInput>,
    judgement: &mut Judgement,
) -> Result<Vec<Found>, Error> {
    let results = probe.at(&inputs)?;
    let found = inputs.into_iter().zip(results).map(|pair| {
        let share = judgement.add(truth, tier, &pair, 1);
        (pair.0, share)
    });
    Ok(found.collect())
}

/// Those with the largest shares, the largest first.
fn best(mut found: Vec<Found>) -> Vec<Found> {
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    found.truncate(CLIMBERS);
    found
}

/// The input with one or two of its floats moved.
fn stepped(function: &Function, input: ProbeInput, rng: &mut Rng) -> ProbeInput {
    let mut input = input;
    for _ in 0..rng.u32(1..=2) {
        let place = rng.usize(0..function.columns().len());
        let float = match place {
            0..3 => &mut input.normal[place],
            3..6 => &mut input.light[place - 3],
            6..9 => &mut input.eye[place - 6],
            9 => &mut input.roughness,
            10 => &mut input.f0,
            _ => &mut input.extra[place - 11],
        };
        let (low, high) = match place {
            0..11 => (-1.0, 1.0),
            _ => function.extra[place - 11].range,
        };
        let step = 1_u32 << rng.u32(0..BITS);
        let bits = float.to_bits();
        let moved = if rng.bool() {
            bits.saturating_add(step)
        } else {
            bits.saturating_sub(step)
        };
        let moved = f32::from_bits(moved);
        if (low..=high).contains(&moved) {
            *float = moved;
        }
    }
    input
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_stays_within_what_a_scene_can_say() {
        let mut rng = Rng::with_seed(1);
        let mut input = ProbeInput {
            normal: [0.0, 1.0, 0.0],
            roughness: 0.5,
            light: [0.6, 0.8, 0.0],
            f0: 1.0,
            eye: [0.0, -0.8, 0.6],
            place: 0,
            extra: [0.5; 4],
        };
        let first = input;
        let function = Function::of_name("conductor-f").expect("it is there");
        for _ in 0..10_000 {
            input = stepped(function, input, &mut rng);
            let numbers = [input.normal, input.light, input.eye].concat();
            assert!(numbers.iter().all(|x| x.abs() <= 1.0), "{input:?}");
            assert!((0.0..=1.0).contains(&input.roughness), "{input:?}");
            assert!((0.0..=1.0).contains(&input.f0), "{input:?}");
            assert!(function.takes_extra_of(&input), "{input:?}");
        }
        assert_ne!(input, first);
    }
}
