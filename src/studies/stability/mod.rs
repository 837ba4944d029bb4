//! Does the library stay with its truth where the slides' listings do not?
//!
//! Each function is evaluated on the device, by the shader files that frames are shaded with: at the hard cases of a
//! named corpus, at inputs drawn by chance, and at the worst of those that it can find. No value may be NaN, infinite or
//! negative, and where an accuracy is promised it is held against f64.

mod cases;
mod cost;
mod judge;
mod map;
mod pixels;
mod search;
mod truth;

use std::sync::Arc;

pub use cases::{CASES, Case};
pub use cost::costs;
pub use judge::Judgement;
pub use pixels::{BadPixel, Cause, bad_pixels};
pub use truth::Truth;

use crate::gpu::{Device, Error};
use crate::interface::{ProbeInput, ProbeResult};
use crate::reference::slides::readings::{self, Reading};
use crate::render::library::{Function, Tier};
use crate::render::probe::{Chance, Probe};
use crate::report::{BitsMap, StabilityRow};

/// How much is evaluated.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Amount {
    /// Inputs of each case.
    pub case: usize,
    /// Inputs drawn by chance for each function and tier.
    pub chance: u64,
    /// Inputs of which each one at which the tiers differ most is judged.
    pub worst: u64,
    /// Draws all of them.
    pub seed: u64,
}

/// Values of an invocation, of which one is judged.
const REPEATS: u32 = 100;

/// Invocations between two words on progress.
const CHUNK: u64 = 1 << 17;

/// A function in a tier under test.
pub struct Study {
    probe: Probe,
    truth: Truth,
    function: &'static Function,
    tier: Tier,
    amount: Amount,
}

impl Study {
    /// Nothing is evaluated yet.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(
        device: &Arc<Device>,
        function: &'static Function,
        tier: Tier,
        amount: Amount,
    ) -> Result<Self, Error> {
        Ok(Self {
            probe: Probe::new(device, function, tier)?,
            truth: Truth::of(function),
            function,
            tier,
            amount,
        })
    }

    /// The row of a case.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn case(&self, case: &Case, progress: &dyn Fn(u64)) -> Result<StabilityRow, Error> {
        let inputs = self.inputs(case);
        let results = self.probe.at(&inputs)?;
        let mut judgement = Judgement::default();
        for pair in inputs.into_iter().zip(results) {
            judgement.add(&self.truth, self.tier, &pair, 1);
        }
        progress(self.amount.case as u64);
        Ok(self.row(case.name, &judgement))
    }

    /// The rows of a case for a listing as a processor computes it, by each reading of `min` and `max`; none for a function
    /// that is no listing.
    pub fn readings(&self, case: &Case) -> Vec<StabilityRow> {
        if !self.function.is_listing {
            return Vec::new();
        }
        let inputs = self.inputs(case);
        let rows = Reading::ALL.into_iter().map(|reading| {
            let mut judgement = Judgement::default();
            for input in &inputs {
                let value = read_by(reading, self.function, input);
                judgement.add(&self.truth, self.tier, &(*input, counted(value)), 1);
            }
            StabilityRow {
                tier: name_of(reading).to_owned(),
                ..self.row(case.name, &judgement)
            }
        });
        rows.collect()
    }

    /// The row `chance`: inputs drawn by the shader, every hundredth judged.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn chance(&self, progress: &dyn Fn(u64)) -> Result<StabilityRow, Error> {
        self.drawn("chance", Chance::Kept, self.amount.chance, progress)
    }

    /// The row `worst`: of each hundred the one at which the tiers differ most is judged. None where no tier is better.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn worst(&self, progress: &dyn Fn(u64)) -> Result<Option<StabilityRow>, Error> {
        if self.function.tiers.last() == Some(&self.tier) {
            progress(self.amount.worst);
            return Ok(None);
        }
        let row = self.drawn("worst", Chance::Worst, self.amount.worst, progress)?;
        Ok(Some(row))
    }

    /// The row `search`: the worst that climbing finds. None where nothing is promised.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn search(&self, progress: &dyn Fn(u64)) -> Result<Option<StabilityRow>, Error> {
        if self.function.is_listing {
            return Ok(None);
        }
        let (probe, truth, seed) = (&self.probe, &self.truth, self.amount.seed);
        let judgement = search::search(probe, truth, (self.function, self.tier), seed, progress)?;
        Ok(Some(self.row("search", &judgement)))
    }

    /// Bits lost over roughness and the angle of the light.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn map(&self) -> Result<BitsMap, Error> {
        let what = (self.function, self.tier);
        map::map(&self.probe, &self.truth, what, self.amount.seed)
    }

    /// A case's inputs, with what the function takes beside.
    fn inputs(&self, case: &Case) -> Vec<ProbeInput> {
        let mut inputs = case.inputs(self.amount.seed, self.amount.case);
        with_extra(self.function, &mut inputs, self.amount.seed);
        inputs
    }

    fn drawn(
        &self,
        name: &str,
        chance: Chance,
        values: u64,
        progress: &dyn Fn(u64),
    ) -> Result<StabilityRow, Error> {
        let invocations = values.div_ceil(u64::from(REPEATS));
        let mut judgement = Judgement::default();
        let mut first = 0;
        while first < invocations {
            let count = CHUNK.min(invocations - first);
            // Beyond 2^32 invocations their numbers begin again, so the seed counts the rounds.
            let seed = (self.amount.seed ^ ((first >> 32) << 16)) as u32;
            let range = (first as u32, count as u32);
            for pair in self.probe.drawn(chance, seed, range, REPEATS)? {
                judgement.add(&self.truth, self.tier, &pair, REPEATS);
            }
            first += count;
            progress(count * u64::from(REPEATS));
        }
        Ok(self.row(name, &judgement))
    }

    fn row(&self, case: &str, judgement: &Judgement) -> StabilityRow {
        // JSON has no infinity.
        let judged = |figure: f64| (judgement.judged > 0 && figure.is_finite()).then_some(figure);
        StabilityRow {
            function: self.function.name.to_owned(),
            tier: self.tier.name().to_owned(),
            case: case.to_owned(),
            inputs: judgement.inputs,
            judged: judgement.judged,
            nan: judgement.nans,
            inf: judgement.infinities,
            negative: judgement.negatives,
            max_relative_error: judged(judgement.largest_error),
            mean_relative_error: judgement.mean_error().and_then(judged),
            max_of_bound: judged(judgement.of_bound),
            max_ulp: judged(judgement.largest_ulp),
            max_bits_lost: judged(judgement.bits_lost()),
            worst_input: judgement
                .worst
                .as_ref()
                .map(|worst| told(self.function, worst)),
        }
    }
}

/// Draws what a function takes beside, for inputs that were made without it.
pub fn with_extra(function: &Function, inputs: &mut [ProbeInput], seed: u64) {
    let mut rng = fastrand::Rng::with_seed(seed);
    for input in inputs {
        input.extra = function.extra_at([(); 4].map(|()| rng.f32()));
    }
}

/// What rows call the tier of a reading.
fn name_of(reading: Reading) -> &'static str {
    match reading {
        Reading::Dropped => "f32, NaN dropped",
        Reading::Text => "f32, GLSL's text",
        Reading::Propagated => "f32, NaN kept",
    }
}

fn read_by(reading: Reading, function: &Function, input: &ProbeInput) -> f32 {
    let [n, l, e] = input.vectors();
    match function.name {
        "slides-oren-nayar" => readings::oren_nayar(reading, n, l, e, input.roughness),
        _ => readings::cook_torrance(reading, [n, l, e], input.roughness, input.f0),
    }
}

/// A value as the probe counts it.
fn counted(value: f32) -> ProbeResult {
    ProbeResult {
        value,
        nans: value.is_nan().into(),
        infinities: value.is_infinite().into(),
        negatives: u32::from(value < 0.0),
    }
}

/// An input in decimal, and as the bits that repeat it.
fn told(function: &Function, input: &ProbeInput) -> String {
    let numbers = function.numbers(input);
    let decimal: Vec<String> = numbers.iter().map(f32::to_string).collect();
    let bits = numbers.iter().map(|x| format!("{:08x}", x.to_bits()));
    let bits: Vec<String> = bits.collect();
    format!("{} = {}", decimal.join(","), bits.join(" "))
}
