//! Does the library that ships stay with its truth, where the slides' listings do not?

use glam::Vec3;
use umber::gpu::Error;
use umber::interface::ProbeInput;
use umber::reference::given::Given;
use umber::render::library::{FUNCTIONS, Function, Tier};
use umber::render::probe::{Chance, Probe};
use umber::report::StabilityRow;
use umber::studies::stability::{Amount, CASES, Study, Truth};

use crate::harness::{Gpu, with_gpu};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const AMOUNT: Amount = Amount {
    case: 4096,
    // Eleven functions and tiers that promise something: 10^8 in all.
    chance: 9_000_000,
    worst: 400_000,
    seed: 11,
};

/// Each function that promises something, in each tier.
fn promising() -> impl Iterator<Item = (&'static Function, Tier)> {
    let functions = FUNCTIONS.iter().filter(|function| !function.is_listing);
    functions.flat_map(|function| function.tiers.iter().map(move |tier| (function, *tier)))
}

fn study(gpu: &Gpu, function: &'static Function, tier: Tier) -> Result<Study, Error> {
    Study::new(&gpu.device, function, tier, AMOUNT)
}

#[track_caller]
fn assert_kept(row: &StabilityRow) {
    assert!(!row.is_broken(), "{row:#?}");
}

#[test]
fn every_case_of_the_corpus_is_kept() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        for (function, tier) in promising() {
            let study = study(gpu, function, tier)?;
            let mut judged = 0;
            for case in CASES {
                let row = study.case(case, &|_| {})?;
                assert_kept(&row);
                judged += row.judged;
            }
            assert!(judged > 10_000, "{}: {judged} judged", function.name);
        }
        Ok(())
    })
}

#[test]
fn a_hundred_million_values_are_kept() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        let mut values = 0;
        for (function, tier) in promising() {
            let study = study(gpu, function, tier)?;
            let chance = study.chance(&|_| {})?;
            let found = [study.worst(&|_| {})?, study.search(&|_| {})?];
            for row in found.into_iter().flatten().chain([chance]) {
                assert_kept(&row);
                assert!(row.judged > 500, "{row:#?}");
                values += row.inputs;
            }
        }
        assert!(values >= 100_000_000, "{values}");
        Ok(())
    })
}

#[test]
fn the_listings_break_where_the_slides_do() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        let row = |function, case: &str| -> Result<StabilityRow, Box<dyn std::error::Error>> {
            let case = CASES
                .iter()
                .find(|other| other.name == case)
                .ok_or("no such case")?;
            let study = study(gpu, Function::of_name(function)?, Tier::F32)?;
            Ok(study.case(case, &|_| {})?)
        };
        // Whatever a driver makes of NaN in min and max, these are none or infinite.
        let noon = row("slides-oren-nayar", "all-on-normal")?;
        assert!(noon.nan > 0, "{noon:#?}");
        let mirror = row("slides-cook-torrance", "mirror")?;
        assert!(mirror.nan + mirror.inf > 0, "{mirror:#?}");
        // Here one driver makes a NaN, and the other a number that is several times too large.
        let bright = row("slides-oren-nayar", "light-on-normal")?;
        let wrong = bright.max_relative_error.is_some_and(|error| error > 0.5);
        assert!(bright.nan > 0 || wrong, "{bright:#?}");
        let smooth = row("slides-cook-torrance", "smooth-peak")?;
        let wrong = smooth.max_relative_error.is_some_and(|error| error > 0.1);
        assert!(wrong || smooth.nan > 0, "{smooth:#?}");
        Ok(())
    })
}

#[test]
fn what_was_kept_gives_the_same_bits_again() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        for chance in [Chance::Kept, Chance::Worst] {
            let probe = Probe::new(&gpu.device, Function::of_name("cook-torrance")?, Tier::F32)?;
            let drawn = probe.drawn(chance, 3, (1000, 700), 9)?;
            assert_eq!(drawn.len(), 700);
            let (inputs, first): (Vec<_>, Vec<_>) = drawn.into_iter().unzip();
            let again = probe.at(&inputs)?;
            for (first, again) in first.iter().zip(&again) {
                assert_eq!(first.value.to_bits(), again.value.to_bits());
            }
            let same = probe.drawn(chance, 3, (1000, 700), 9)?;
            let same: Vec<_> = same.into_iter().map(|(input, _)| input).collect();
            assert_eq!(inputs, same);
            assert!(inputs.iter().any(|input| input.place < 8) == (chance == Chance::Worst));
        }
        Ok(())
    })
}

#[test]
fn more_inputs_than_a_dispatch_takes_are_answered_in_order() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        let probe = Probe::new(&gpu.device, Function::of_name("schlick-f")?, Tier::F32)?;
        let inputs: Vec<_> = (0..(1 << 18) + 77)
            .map(|i| ProbeInput {
                normal: [0.0, 1.0, 0.0],
                roughness: 0.5,
                light: [0.0, 1.0, 0.0],
                f0: i as f32 / 300_000.0,
                eye: [0.0, 1.0, 0.0],
                place: 0,
                extra: [0.0; 4],
            })
            .collect();
        let results = probe.at(&inputs)?;
        assert_eq!(results.len(), inputs.len());
        // Seen along the normal, the reflectance is f0.
        for (input, result) in inputs.iter().zip(results) {
            assert_eq!(result.value, input.f0);
        }
        assert_eq!(probe.at(&[])?, []);
        Ok(())
    })
}

#[test]
fn a_clock_counts_evaluations() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        let probe = Probe::new(&gpu.device, Function::of_name("corrected")?, Tier::F32)?;
        let inputs = CASES[0].inputs(1, 5000);
        let ns = probe.clock(&inputs, 10)?.ns()?;
        assert!(ns > 0.0 && ns < 1e5, "{ns} ns");
        Ok(())
    })
}

fn inputs_of(case: &str) -> Vec<ProbeInput> {
    let case = CASES.iter().find(|other| other.name == case);
    case.map_or_else(Vec::new, |case| case.inputs(21, 4000))
}

#[test]
fn light_and_eye_may_change_places() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        for name in ["oren-nayar", "cook-torrance", "corrected"] {
            let function = Function::of_name(name)?;
            for tier in [Tier::F32, Tier::F32Compensated] {
                let probe = Probe::new(&gpu.device, function, tier)?;
                let inputs = [inputs_of("generic"), inputs_of("smooth-peak")].concat();
                let swap = |input: &ProbeInput| ProbeInput {
                    light: input.eye,
                    eye: input.light,
                    ..*input
                };
                let swapped: Vec<_> = inputs.iter().map(swap).collect();
                let (there, back) = (probe.at(&inputs)?, probe.at(&swapped)?);
                let mut compared = 0;
                for ((input, there), back) in inputs.iter().zip(there).zip(back) {
                    let Some(bound) = Truth::of(function).bound(tier, input) else {
                        continue;
                    };
                    let [n, l, e] = [input.normal, input.light, input.eye].map(Vec3::from);
                    let at = Given::new(n, l, e);
                    // f from f (N.L) and from f (N.E).
                    let there = f64::from(there.value) / at.nol;
                    let back = f64::from(back.value) / at.noe;
                    let apart = (there - back).abs() / there.max(back);
                    assert!(
                        apart <= 2.0 * bound,
                        "{name}, {tier:?}: {apart:e} at {input:?}"
                    );
                    compared += 1;
                }
                assert!(compared > 4000, "{name}: {compared}");
            }
        }
        Ok(())
    })
}

#[test]
fn a_smooth_base_is_lamberts_and_a_smooth_mirror_dark_beside_its_peak() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        let inputs = inputs_of("generic");
        let at = |name: &str, roughness: f32| -> Result<Vec<f32>, Box<dyn std::error::Error>> {
            let probe = Probe::new(&gpu.device, Function::of_name(name)?, Tier::F32)?;
            let set = |input: &ProbeInput| ProbeInput {
                roughness,
                ..*input
            };
            let inputs: Vec<_> = inputs.iter().map(set).collect();
            let results = probe.at(&inputs)?;
            Ok(results.into_iter().map(|result| result.value).collect())
        };
        let cosine = |input: &ProbeInput| Vec3::from(input.normal).dot(input.light.into());
        for (value, input) in at("oren-nayar", 0.0)?.iter().zip(&inputs) {
            assert!(
                (value - cosine(input)).abs() <= 2.0 * f32::EPSILON,
                "{input:?}"
            );
        }
        // Nearer to Lambert's with every step down.
        let mut last = f32::INFINITY;
        for sigma in [0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3] {
            let values = at("oren-nayar", sigma)?;
            let off = values
                .iter()
                .zip(&inputs)
                .map(|(v, input)| (v - cosine(input)).abs());
            let largest = off.fold(0.0, f32::max);
            assert!(largest < last, "sigma {sigma}: {largest} after {last}");
            last = largest;
        }
        // Half vectors of generic inputs are nowhere near the normal.
        let mut last = usize::MAX;
        for m in [1.0, 0.3, 0.1, 0.03, 0.01, 1e-3] {
            let lit = at("cook-torrance", m)?
                .iter()
                .filter(|value| **value > 0.0)
                .count();
            assert!(lit <= last, "m {m}: {lit} after {last}");
            last = lit;
        }
        assert!(last < 10, "{last} of {} still lit", inputs.len());
        Ok(())
    })
}
