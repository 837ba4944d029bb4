//! Which model keeps what `umber render` was asked to keep?

use crate::cli::exit::{Exit, Failure};
use crate::reference::ladders::Mix;
use crate::reference::shade::Lighting;
use crate::render::effects::EffectSet;
use crate::render::{Frame, RenderError, Renderer, Settings, Uploaded};
use crate::report::ChoiceRow;
use crate::scene::Scene;
use crate::studies::cost::{
    DEFAULT, Exhibit, Outcome, Point, Priced, Prices, Promise, SightError, choose, choose_error,
    made_opaque,
};

/// A promise in place of a model.
#[derive(clap::Args)]
pub struct PromiseArguments {
    /// Take the cheapest model whose picture differs from one in f64 by at most this, to a person: the mean of FLIP, 0 to 1
    #[arg(long, value_name = "FLIP", value_parser = max_error, allow_negative_numbers = true,
          conflicts_with_all = ["lighting", "diffuse", "specular", "fresnel", "budget_ms"])]
    max_error: Option<f64>,
    /// Take the nearest model whose frame takes at most so many milliseconds on this device
    #[arg(long, value_name = "MS", value_parser = budget, allow_negative_numbers = true,
          conflicts_with_all = ["lighting", "diffuse", "specular", "fresnel"])]
    budget_ms: Option<f64>,
}

fn max_error(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(error) if (0.0..=1.0).contains(&error) => Ok(error),
        _ => Err("it is a number from 0 to 1".into()),
    }
}

fn budget(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(ms) if ms > 0.0 && ms.is_finite() => Ok(ms),
        _ => Err("it is a number of milliseconds above 0".into()),
    }
}

impl PromiseArguments {
    /// What is promised, if anything is.
    pub fn promise(&self) -> Option<Promise> {
        let error = self.max_error.map(Promise::MaxError);
        error.or(self.budget_ms.map(Promise::BudgetMs))
    }
}

/// The longer side of the pictures by which models are chosen, pixels.
const LONGER: u32 = 320;

/// The model that keeps a promise for frames of these settings.
///
/// # Errors
/// None keeps it (the message names the nearest); the scene is beyond the device, there is no memory, or the driver fails.
pub fn keep(
    renderer: &Renderer,
    scene: &Scene,
    settings: &Settings,
    promise: Promise,
) -> Result<(Lighting, ChoiceRow), Failure> {
    let opaque = made_opaque(scene);
    let size = small((settings.width, settings.height));
    let uploaded = Uploaded::new(renderer, &opaque, EffectSet::ALL)?;
    let mut exhibit = Exhibit::new(renderer, &uploaded, ("the scene", &opaque), size)?;
    let prices = Prices::new(renderer, &|| {})?;
    let mixes = prices.predicted(&mut exhibit)?;
    let outcome = match promise {
        Promise::MaxError(most) => choose_error(&mut exhibit, &mixes, most)?,
        Promise::BudgetMs(most) => {
            let uploaded = Uploaded::new(renderer, scene, settings.effects.allowed)?;
            let clock = FrameClock {
                renderer,
                uploaded: &uploaded,
                settings,
            };
            choose_budget(&clock, &mut exhibit, &mixes, most)?
        }
    };
    match outcome {
        Outcome::Kept(priced) => {
            let row = row(promise, &priced, &mixes);
            Ok((Lighting::Mixed(priced.mix), row))
        }
        Outcome::Broken(nearest) => Err(refused(promise, &nearest)),
    }
}

/// The same shape, no larger than models are chosen by.
fn small((width, height): (u32, u32)) -> (u32, u32) {
    let longer = width.max(height);
    if longer <= LONGER {
        return (width, height);
    }
    let side = |side: u32| {
        let scaled = u64::from(side) * u64::from(LONGER) / u64::from(longer);
        scaled.max(1) as u32
    };
    (side(width), side(height))
}

/// Frames as they will be drawn.
struct FrameClock<'a> {
    renderer: &'a Renderer,
    uploaded: &'a Uploaded<'a>,
    settings: &'a Settings,
}

/// Frames of which the median counts.
const FRAMES: usize = 3;

impl FrameClock<'_> {
    fn ms(&self, mix: Mix) -> Result<f64, RenderError> {
        let mut settings = *self.settings;
        settings.variant.lighting = Lighting::Mixed(mix);
        let mut frame = Frame::new(self.renderer, self.uploaded, &settings)?;
        let mut times = Vec::new();
        frame.draw()?;
        for _ in 0..FRAMES {
            times.push(frame.draw()?.ms());
        }
        times.sort_by(f64::total_cmp);
        Ok(times[FRAMES / 2])
    }
}

fn choose_budget(
    clock: &FrameClock,
    exhibit: &mut Exhibit,
    mixes: &[Priced],
    most: f64,
) -> Result<Outcome, SightError> {
    let mixes = in_ms(clock, mixes)?;
    choose(Promise::BudgetMs(most), &mixes, Mix::BEST, &mut |mix| {
        Ok(Point {
            time: clock.ms(mix)?,
            error: exhibit.look(Lighting::Mixed(mix))?.flip_mean,
        })
    })
}

/// ns an evaluation as ms a frame: a straight line through the dearest and the cheapest mix, whose frames are timed.
fn in_ms(clock: &FrameClock, mixes: &[Priced]) -> Result<Vec<Priced>, RenderError> {
    let by_time = |a: &&Priced, b: &&Priced| a.point.time.total_cmp(&b.point.time);
    let ends = mixes
        .iter()
        .min_by(by_time)
        .zip(mixes.iter().max_by(by_time));
    let Some((cheap, dear)) = ends else {
        return Ok(Vec::new());
    };
    let (low, high) = (clock.ms(cheap.mix)?, clock.ms(dear.mix)?);
    let slope = (high - low) / (dear.point.time - cheap.point.time).max(f64::MIN_POSITIVE);
    let in_ms = |priced: &Priced| Priced {
        mix: priced.mix,
        point: Point {
            time: low + slope * (priced.point.time - cheap.point.time),
            ..priced.point
        },
    };
    Ok(mixes.iter().map(in_ms).collect())
}

fn row(promise: Promise, priced: &Priced, mixes: &[Priced]) -> ChoiceRow {
    let of = |mix: Mix| {
        let found = mixes.iter().find(|priced| priced.mix == mix);
        found.map_or(f64::NAN, |priced| priced.point.time)
    };
    let (max_error, budget_ms) = match promise {
        Promise::MaxError(most) => (Some(most), None),
        Promise::BudgetMs(most) => (None, Some(most)),
    };
    ChoiceRow {
        max_error,
        budget_ms,
        lighting: priced.mix.to_string(),
        flip_mean: priced.point.error,
        frame_ms: budget_ms.map(|_| priced.point.time),
        ns_of_default: of(priced.mix) / of(Mix::BEST),
    }
}

fn refused(promise: Promise, nearest: &Priced) -> Failure {
    let Priced { mix, point } = nearest;
    let message = match promise {
        Promise::MaxError(most) => format!(
            "no model keeps a mean difference of {most} on this scene; the nearest, {mix}, differs by {:.4}: ask for --max-error {}",
            point.error,
            rounded_up(point.error)
        ),
        Promise::BudgetMs(most) => format!(
            "no model draws this scene in {most} ms on this device; the quickest, {mix}, takes {:.1} ms: ask for more, or for fewer pixels",
            point.time
        ),
    };
    Failure::new(Exit::Compared, message)
}

/// With four digits behind the point, not below it.
fn rounded_up(error: f64) -> f64 {
    (error * 1e4).ceil() / 1e4
}

/// What is told of a choice.
pub fn told(row: &ChoiceRow) -> String {
    let promise = match (row.max_error, row.budget_ms) {
        (Some(most), _) => format!("the cheapest found whose mean difference is at most {most}"),
        (_, Some(most)) => format!("the nearest found that takes at most {most} ms"),
        _ => String::new(),
    };
    let frame = row
        .frame_ms
        .map_or(String::new(), |ms| format!(", {ms:.1} ms a frame"));
    let lighting = &row.lighting;
    let default = crate::studies::cost::name(DEFAULT);
    format!(
        "lighting {lighting}: {promise}; it differs by {:.4}{frame}, an evaluation takes {:.2} of {default}'s",
        row.flip_mean, row.ns_of_default
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_small_picture_keeps_its_shape() {
        assert_eq!(small((1280, 720)), (320, 180));
        assert_eq!(small((100, 320)), (100, 320));
        assert_eq!(small((1, 16384)), (1, 320));
        assert_eq!(small((16384, 1)), (320, 1));
    }

    #[test]
    fn a_promise_has_its_range() {
        assert_eq!(max_error("0.01"), Ok(0.01));
        assert_eq!(budget("2"), Ok(2.0));
        for text in ["", "-0.1", "1.1", "nan", "one"] {
            assert!(max_error(text).is_err(), "{text}");
        }
        for text in ["0", "-1", "inf", "nan"] {
            assert!(budget(text).is_err(), "{text}");
        }
    }

    #[test]
    fn what_is_impossible_names_the_nearest() {
        let nearest = Priced {
            mix: Mix::BEST,
            point: Point {
                time: 12.34,
                error: 0.004_23,
            },
        };
        let failure = refused(Promise::MaxError(0.001), &nearest);
        assert_eq!(failure.exit, Exit::Compared);
        assert!(
            failure
                .message
                .contains("0.0042: ask for --max-error 0.0043"),
            "{}",
            failure.message
        );
        let failure = refused(Promise::BudgetMs(2.0), &nearest);
        assert!(
            failure.message.contains("takes 12.3 ms"),
            "{}",
            failure.message
        );
    }
}
