//! Which is the cheapest model that keeps a promise, on this scene and device?
//!
//! Each tier is measured in the place of the best model's; errors and times of their mixes are predicted from that, and the
//! likeliest are measured until one keeps the promise. So what is promised was seen, not predicted.

use super::forms::mixes;
use super::pareto::Point;
use crate::reference::ladders::{Mix, Specular};

/// What is asked of the model.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Promise {
    /// A mean of FLIP of at most this.
    MaxError(f64),
    /// A frame of at most so many milliseconds.
    BudgetMs(f64),
}

/// A mix, and what it costs and errs.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Priced {
    /// Which.
    pub mix: Mix,
    /// In units of the promise's: `time` in ns an evaluation or ms a frame, `error` a mean of FLIP.
    pub point: Point,
}

/// What came of it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Outcome {
    /// This mix keeps the promise.
    Kept(Priced),
    /// None was found that does; this one came nearest.
    Broken(Priced),
}

/// Mixes that are measured before the choice falls back on the best.
const MOST: usize = 24;

/// A prediction may be off by this factor and the mix is tried all the same.
const DOUBT: f64 = 1.25;

/// All mixes, predicted: differences from the best add up. `best` comes first among `swaps`, then the best with one tier changed.
pub fn predicted(swaps: &[Priced]) -> Vec<Priced> {
    let Some(best) = swaps.first() else {
        return Vec::new();
    };
    let changed = |alike: &dyn Fn(&Mix) -> bool| {
        let swap = swaps.iter().find(|swap| alike(&swap.mix));
        swap.map_or((0.0, 0.0), |swap| {
            let time = swap.point.time - best.point.time;
            // A tier may come out nearer by chance; together such chances do not add up.
            (time, (swap.point.error - best.point.error).max(0.0))
        })
    };
    let predict = |mix: Mix| {
        let base = best.mix;
        let parts = [
            changed(&|other: &Mix| {
                *other
                    == Mix {
                        diffuse: mix.diffuse,
                        ..base
                    }
            }),
            changed(&|other: &Mix| {
                let facets = other.specular == mix.specular && other.diffuse == base.diffuse;
                facets && (other.fresnel == base.fresnel || mix.specular == Specular::Slides)
            }),
            // A listing's own Fresnel term is in its price.
            match mix.specular {
                Specular::Slides => (0.0, 0.0),
                _ => changed(&|other: &Mix| {
                    *other
                        == Mix {
                            fresnel: mix.fresnel,
                            ..base
                        }
                }),
            },
        ];
        let time: f64 = parts.iter().map(|part| part.0).sum();
        let error: f64 = parts.iter().map(|part| part.1).sum();
        let point = Point {
            time: (best.point.time + time).max(0.0),
            error: best.point.error + error,
        };
        Priced { mix, point }
    };
    mixes().into_iter().map(predict).collect()
}

/// The cheapest mix that keeps the promise, of those `predicted`. `measure` says what a mix's picture errs and its frame takes.
///
/// # Errors
/// What `measure` fails with.
pub fn choose<E>(
    promise: Promise,
    predicted: &[Priced],
    best: Mix,
    measure: &mut dyn FnMut(Mix) -> Result<Point, E>,
) -> Result<Outcome, E> {
    let mut tried: Vec<Priced> = Vec::new();
    for mix in order(promise, predicted, best) {
        let priced = Priced {
            mix,
            point: measure(mix)?,
        };
        let kept = match promise {
            Promise::MaxError(most) => priced.point.error <= most,
            Promise::BudgetMs(most) => priced.point.time <= most,
        };
        if kept {
            return Ok(Outcome::Kept(priced));
        }
        tried.push(priced);
    }
    let miss = |priced: &Priced| match promise {
        Promise::MaxError(_) => priced.point.error,
        Promise::BudgetMs(_) => priced.point.time,
    };
    let nearest = tried.into_iter().min_by(|a, b| miss(a).total_cmp(&miss(b)));
    Ok(Outcome::Broken(nearest.unwrap_or(Priced {
        mix: best,
        point: Point {
            time: f64::NAN,
            error: f64::NAN,
        },
    })))
}

/// In which order mixes are tried. For an error, the cheapest that may keep it, none dearer than the best, then the best and what errs
/// least; for a budget, what errs least, then the cheapest.
fn order(promise: Promise, predicted: &[Priced], best: Mix) -> Vec<Mix> {
    let time = |priced: &Priced| priced.point.time;
    let error = |priced: &Priced| priced.point.error;
    let sorted = |key: &dyn Fn(&Priced) -> f64| {
        let mut all: Vec<Priced> = predicted.to_vec();
        all.sort_by(|a, b| key(a).total_cmp(&key(b)));
        all
    };
    let (first, last): (Vec<Mix>, Vec<Mix>) = match promise {
        Promise::MaxError(most) => {
            let dearest = predicted.iter().find(|priced| priced.mix == best);
            let dearest = dearest.map_or(f64::INFINITY, time);
            let likely = sorted(&time).into_iter();
            let likely =
                likely.filter(|priced| error(priced) <= most * DOUBT && time(priced) <= dearest);
            let last = [best].into_iter();
            let last = last.chain(sorted(&error).first().map(|priced| priced.mix));
            (likely.map(|priced| priced.mix).collect(), last.collect())
        }
        Promise::BudgetMs(most) => {
            let likely = sorted(&error).into_iter();
            let likely = likely.filter(|priced| time(priced) <= most * DOUBT);
            let cheapest = sorted(&time).into_iter().map(|priced| priced.mix);
            (
                likely.map(|priced| priced.mix).collect(),
                cheapest.take(3).collect(),
            )
        }
    };
    let mut order: Vec<Mix> = Vec::new();
    for mix in first.into_iter().take(MOST).chain(last) {
        if !order.contains(&mix) {
            order.push(mix);
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::ladders::{Diffuse, Fresnel};

    fn priced(mix: Mix, time: f64, error: f64) -> Priced {
        Priced {
            mix,
            point: Point { time, error },
        }
    }

    const LAMBERT: Mix = Mix {
        diffuse: Diffuse::Lambert,
        ..Mix::BEST
    };
    const SCHLICK: Mix = Mix {
        fresnel: Fresnel::Schlick,
        ..Mix::BEST
    };
    const BOTH: Mix = Mix {
        diffuse: Diffuse::Lambert,
        ..SCHLICK
    };
    const LISTING: Mix = Mix {
        specular: Specular::Slides,
        fresnel: Fresnel::Scale,
        ..Mix::BEST
    };

    fn swaps() -> Vec<Priced> {
        vec![
            priced(Mix::BEST, 10.0, 0.001),
            priced(LAMBERT, 7.0, 0.021),
            priced(SCHLICK, 9.0, 0.006),
            priced(LISTING, 12.0, 0.1),
        ]
    }

    fn point(all: &[Priced], mix: Mix) -> (f64, f64) {
        let found = all.iter().find(|priced| priced.mix == mix);
        found.map_or((f64::NAN, f64::NAN), |priced| {
            (priced.point.time, priced.point.error)
        })
    }

    #[test]
    fn differences_from_the_best_add_up() {
        let all = predicted(&swaps());
        assert_eq!(all.len(), mixes().len());
        let near = |got: (f64, f64), want: (f64, f64)| {
            assert!((got.0 - want.0).abs() < 1e-12, "{got:?}");
            assert!((got.1 - want.1).abs() < 1e-12, "{got:?}");
        };
        near(point(&all, Mix::BEST), (10.0, 0.001));
        near(point(&all, BOTH), (6.0, 0.026));
        // A listing's Fresnel term is not counted again.
        let listing = Mix {
            diffuse: Diffuse::Lambert,
            ..LISTING
        };
        near(point(&all, listing), (9.0, 0.12));
        assert!(predicted(&[]).is_empty());
    }

    /// What is really there: errors of a mix are half of what is predicted, so more mixes keep a promise than are thought to.
    fn chosen(promise: Promise) -> (Outcome, Vec<Mix>) {
        let all = [
            priced(Mix::BEST, 10.0, 0.001),
            priced(LAMBERT, 7.0, 0.021),
            priced(SCHLICK, 9.0, 0.006),
            priced(BOTH, 6.0, 0.026),
        ];
        let mut asked = Vec::new();
        let outcome = choose::<()>(promise, &all, Mix::BEST, &mut |mix| {
            asked.push(mix);
            let (time, error) = point(&all, mix);
            // Lambert is worse than predicted.
            let error = if mix == LAMBERT { 0.03 } else { error };
            Ok(Point { time, error })
        });
        (outcome.expect("nothing fails"), asked)
    }

    #[test]
    fn the_cheapest_that_keeps_an_error_is_taken() {
        let (outcome, asked) = chosen(Promise::MaxError(0.05));
        assert_eq!(outcome, Outcome::Kept(priced(BOTH, 6.0, 0.026)));
        assert_eq!(asked, [BOTH]);
        // BOTH is tried in doubt, LAMBERT in vain.
        let (outcome, asked) = chosen(Promise::MaxError(0.022));
        assert_eq!(outcome, Outcome::Kept(priced(SCHLICK, 9.0, 0.006)));
        assert_eq!(asked, [BOTH, LAMBERT, SCHLICK]);
        let (outcome, _) = chosen(Promise::MaxError(0.001));
        assert_eq!(outcome, Outcome::Kept(priced(Mix::BEST, 10.0, 0.001)));
    }

    #[test]
    fn what_is_impossible_has_a_nearest() {
        let (outcome, _) = chosen(Promise::MaxError(0.0005));
        assert_eq!(outcome, Outcome::Broken(priced(Mix::BEST, 10.0, 0.001)));
        let (outcome, _) = chosen(Promise::BudgetMs(1.0));
        assert_eq!(outcome, Outcome::Broken(priced(BOTH, 6.0, 0.026)));
    }

    #[test]
    fn a_budget_buys_the_least_error() {
        let (outcome, _) = chosen(Promise::BudgetMs(20.0));
        assert_eq!(outcome, Outcome::Kept(priced(Mix::BEST, 10.0, 0.001)));
        let (outcome, asked) = chosen(Promise::BudgetMs(9.5));
        assert_eq!(outcome, Outcome::Kept(priced(SCHLICK, 9.0, 0.006)));
        assert_eq!(asked, [Mix::BEST, SCHLICK]);
    }
}
