//! Does the library that ships stay with its truth, where the slides' listings do not?

use umber::gpu::Error;
use umber::render::library::{FUNCTIONS, Function, Tier};
use umber::render::probe::{Chance, Probe};
use umber::report::StabilityRow;
use umber::studies::stability::{Amount, CASES, Study};

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
            .map(|i| umber::interface::ProbeInput {
                normal: [0.0, 1.0, 0.0],
                roughness: 0.5,
                light: [0.0, 1.0, 0.0],
                f0: i as f32 / 300_000.0,
                eye: [0.0, 1.0, 0.0],
                place: 0,
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
