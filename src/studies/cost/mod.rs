//! What does each step nearer to the truth cost on this device?
//!
//! ```text
//! forms               the tiers of each term, and whole models
//! evaluations         ns an evaluation, in the compute probe
//! fragments           ns a fragment, in a frame
//! instructions        SPIR-V instructions
//! reference_picture   a scene shaded in f64 by the highest tiers
//! sight, gallery      how far a model's picture is from it, and what its frame takes
//! pareto              which are beaten by none
//! choice              the cheapest model that keeps a promise
//! ```

mod choice;
mod evaluations;
mod forms;
mod fragments;
mod gallery;
mod instructions;
mod pareto;
mod reference_picture;
mod rows;
mod sheet;
mod sight;

pub use choice::{Outcome, Priced, Promise, choose, predicted};
pub use forms::{mixes, name};
pub use gallery::{DEFAULT, Exhibit};
pub use pareto::{Point, front, nearest};
pub use reference_picture::light as reference_light;
pub use rows::Found;
pub use sheet::Shown;
pub use sight::{Sight, SightError, made_opaque};

use crate::reference::ladders::Mix;
use crate::reference::shade::Lighting;
use crate::render::effects::EffectSet;
use crate::render::{Renderer, Uploaded, Variant};
use crate::report::{CostMethod, Interval95, LampRow, PromiseRow};
use crate::scene::Scene;
use crate::studies::{Cache, ladders};
use evaluations::{Evaluation, INPUTS, evaluations};
use forms::{Form, model, tiers};
use fragments::{Fragment, fragments};

/// How much is measured.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Options {
    /// All mixes, or those near the predicted front.
    pub full: bool,
    /// Width and height of the pictures.
    pub size: (u32, u32),
    /// Frames of each model in each scene.
    pub rounds: usize,
    /// Paths behind the model errors.
    pub paths: usize,
}

/// Models that are measured of those near the predicted front.
const NEAREST: usize = 20;
/// Lamps of the fragments in the rows: a usual scene's.
const LAMPS: u32 = 4;
/// Lamps of the sweep.
const SWEEP: [u32; 4] = [1, 4, 16, 64];
/// Frames of each form under lamps, and in the sweep.
const FRAGMENT_ROUNDS: usize = 11;
const SWEEP_ROUNDS: usize = 5;
/// How many times as much `--full` measures of each form.
const FULL: usize = 3;
/// The promises that are tried.
pub const PROMISES: [f64; 4] = [0.05, 0.02, 0.01, 0.005];

/// Models that are measured in any case.
const WHOLE: [Lighting; 3] = [Lighting::Slides, Lighting::CORRECTED, DEFAULT];

/// Measures all. `progress` hears of the steps that are done, of `steps`.
///
/// # Errors
/// A scene is beyond the device, there is no memory, or the driver fails.
pub fn study(
    renderer: &Renderer,
    scenes: &[(String, Scene)],
    options: &Options,
    cache: &Cache,
    progress: &dyn Fn(),
) -> Result<Found, SightError> {
    let device = renderer.device();
    let uploaded = scenes
        .iter()
        .map(|(_, scene)| Uploaded::new(renderer, scene, EffectSet::ALL))
        .collect::<Result<Vec<_>, _>>()?;
    let mut exhibits = scenes
        .iter()
        .zip(&uploaded)
        .map(|((name, scene), uploaded)| {
            Exhibit::new(renderer, uploaded, (name, scene), options.size)
        })
        .collect::<Result<Vec<_>, _>>()?;
    let prices = Prices::new(renderer, progress)?;
    for exhibit in &mut exhibits {
        for swap in swaps() {
            exhibit.look(Lighting::Mixed(swap))?;
            progress();
        }
    }
    let models = models(options, &mut exhibits, &prices)?;
    for exhibit in &mut exhibits {
        exhibit.time(&models, options.rounds, progress)?;
    }
    let measured = Measured::new(renderer, options, &models, progress)?;
    let promises = promises(&mut exhibits, &prices, options, progress)?;
    let errors = ladders::errors(cache, options.paths, &|_| {});
    Ok(Found {
        rows: rows::rows(device, &measured, &exhibits, &errors)?,
        lamps: sweep(renderer, progress)?,
        promises,
        shown: sheet::shown(&exhibits, &models),
        method: CostMethod {
            plan: if options.full { "full" } else { "quick" }.to_owned(),
            size: options.size,
            rounds: options.rounds,
            lamps: LAMPS,
            paths: options.paths as u32,
        },
    })
}

/// How often `progress` hears, nearly.
pub fn steps(scenes: usize, options: &Options) -> u64 {
    let tiers = tiers().len();
    let models = match options.full {
        true => mixes().len() + 1,
        false => NEAREST + 2,
    };
    let looks = scenes * (swaps().len() + models);
    let timed = swaps().len() + 2 * (tiers + models) + SWEEP.len() * WHOLE.len();
    (looks + timed + scenes * PROMISES.len()) as u64
}

/// What was measured of the forms, form by form.
struct Measured {
    forms: Vec<Form>,
    evaluations: Vec<Evaluation>,
    /// Of the first of them.
    fragments: Vec<Fragment>,
}

impl Measured {
    /// Measures the tiers, then the models.
    fn new(
        renderer: &Renderer,
        options: &Options,
        models: &[Lighting],
        progress: &dyn Fn(),
    ) -> Result<Self, SightError> {
        let mut forms = tiers();
        // The models near the front come last.
        let in_frames = match options.full {
            true => forms.len() + models.len(),
            false => forms.len() + WHOLE.len(),
        };
        forms.extend(models.iter().map(|lighting| model(*lighting)));
        let variants: Vec<Variant> = forms.iter().map(|form| form.variant).collect();
        let in_frames = &variants[..in_frames.min(variants.len())];
        let times = if options.full { FULL } else { 1 };
        let rounds = FRAGMENT_ROUNDS * times;
        Ok(Self {
            evaluations: evaluations(renderer.device(), &variants, INPUTS * times, progress)?,
            fragments: fragments(renderer, in_frames, LAMPS, rounds, progress)?,
            forms,
        })
    }
}

/// The best mix, then the best with each other tier in its place.
pub fn swaps() -> Vec<Mix> {
    let tiers = tiers().into_iter().filter_map(|form| match form.lighting {
        Lighting::Mixed(mix) if mix != Mix::BEST => Some(mix),
        _ => None,
    });
    [Mix::BEST].into_iter().chain(tiers).collect()
}

/// What an evaluation of each of `swaps` takes on a device, ns.
pub struct Prices(Vec<(Mix, f64)>);

impl Prices {
    /// Measures them. `progress` hears of each.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn new(renderer: &Renderer, progress: &dyn Fn()) -> Result<Self, crate::gpu::Error> {
        let swaps = swaps();
        let variants: Vec<Variant> = swaps
            .iter()
            .map(|swap| model(Lighting::Mixed(*swap)).variant)
            .collect();
        let times = evaluations(renderer.device(), &variants, INPUTS, progress)?;
        let times = times.iter().map(|time| time.ns);
        Ok(Self(swaps.into_iter().zip(times).collect()))
    }

    /// All mixes, predicted for an exhibit: ns an evaluation, and the mean of FLIP.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn predicted(&self, exhibit: &mut Exhibit) -> Result<Vec<Priced>, SightError> {
        let mut swaps = Vec::new();
        for (mix, time) in &self.0 {
            let error = exhibit.look(Lighting::Mixed(*mix))?.flip_mean;
            let point = Point { time: *time, error };
            swaps.push(Priced { mix: *mix, point });
        }
        Ok(predicted(&swaps))
    }
}

/// The models to measure: the slides', both presets, and all mixes or those near the predicted front, by the scene in which they look
/// worst.
fn models(
    options: &Options,
    exhibits: &mut [Exhibit],
    prices: &Prices,
) -> Result<Vec<Lighting>, SightError> {
    let mut worst: Vec<Priced> = Vec::new();
    for exhibit in exhibits {
        let here = prices.predicted(exhibit)?;
        if worst.is_empty() {
            worst.clone_from(&here);
        }
        for (worst, here) in worst.iter_mut().zip(here) {
            worst.point.error = worst.point.error.max(here.point.error);
        }
    }
    let points: Vec<Point> = worst.iter().map(|priced| priced.point).collect();
    let count = if options.full { points.len() } else { NEAREST };
    let near = nearest(&points, count);
    let mut models = WHOLE.to_vec();
    for place in near {
        let lighting = Lighting::Mixed(worst[place].mix);
        if !models.contains(&lighting) {
            models.push(lighting);
        }
    }
    Ok(models)
}

fn sweep(renderer: &Renderer, progress: &dyn Fn()) -> Result<Vec<LampRow>, SightError> {
    let mut rows = Vec::new();
    for lamps in SWEEP {
        let variants = WHOLE.map(|lighting| model(lighting).variant);
        let times = fragments(renderer, &variants, lamps, SWEEP_ROUNDS, progress)?;
        rows.extend(WHOLE.iter().zip(times).map(|(lighting, time)| LampRow {
            tier: name(*lighting),
            lamps,
            ns_per_fragment: time.ns,
            ns_mad: time.ns_mad,
        }));
    }
    rows.sort_by(|a, b| a.tier.cmp(&b.tier));
    Ok(rows)
}

/// What is chosen for each promise in each scene, and whether its frame is no longer than the default model's.
fn promises(
    exhibits: &mut [Exhibit],
    prices: &Prices,
    options: &Options,
    progress: &dyn Fn(),
) -> Result<Vec<PromiseRow>, SightError> {
    let mut rows = Vec::new();
    for exhibit in exhibits {
        let mixes = prices.predicted(exhibit)?;
        for max_error in PROMISES {
            rows.push(promise(exhibit, &mixes, max_error, options.rounds)?);
            progress();
        }
    }
    Ok(rows)
}

fn promise(
    exhibit: &mut Exhibit,
    mixes: &[Priced],
    max_error: f64,
    rounds: usize,
) -> Result<PromiseRow, SightError> {
    let outcome = choose_error(exhibit, mixes, max_error)?;
    let (chosen, priced) = match outcome {
        Outcome::Kept(priced) => (Some(priced.mix), priced),
        Outcome::Broken(priced) => (None, priced),
    };
    let mut time = None;
    if let Some(mix) = chosen {
        let lighting = Lighting::Mixed(mix);
        exhibit.time(&[lighting], rounds, &|| {})?;
        time = exhibit.frame_time(lighting);
    }
    Ok(PromiseRow {
        scene: exhibit.name.clone(),
        max_error,
        chosen: chosen.map(|mix| mix.to_string()),
        flip_mean: priced.point.error,
        of_default: time.map(|time| time.of_default),
        of_default_95: time.map_or(Interval95::UNBOUNDED, |time| time.of_default_95),
    })
}

/// The cheapest mix whose picture keeps an error.
///
/// # Errors
/// There is no memory, or the driver fails.
pub fn choose_error(
    exhibit: &mut Exhibit,
    mixes: &[Priced],
    max_error: f64,
) -> Result<Outcome, SightError> {
    let time = |mix: Mix| {
        let found = mixes.iter().find(|priced| priced.mix == mix);
        found.map_or(f64::NAN, |priced| priced.point.time)
    };
    choose(Promise::MaxError(max_error), mixes, Mix::BEST, &mut |mix| {
        Ok(Point {
            time: time(mix),
            error: exhibit.look(Lighting::Mixed(mix))?.flip_mean,
        })
    })
}
