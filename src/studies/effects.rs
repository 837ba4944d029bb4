//! Which effects does a scene call for, and what does each cost on this device?
//!
//! Each effect is priced by frames drawn in turn: with it, without it, and compiled in but idle. Only frames
//! drawn next to each other are compared, so that a clock that drifts cancels.

use crate::math::statistics::{Interval, median, paired_difference, paired_ratio};
use crate::render::effects::{Build, Caller, Census, Effect, EffectSet, Effects};
use crate::render::{Frame, Picture, RenderError, Renderer, Settings, Uploaded};
use crate::report::{BuildRow, EffectRow, Interval95};
use crate::scene::Scene;

/// How a scene is measured.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Size, samples, lighting; its `effects` are the study's own to choose.
    pub settings: Settings,
    /// Frames of each kind; at least one. Fewer than six have no interval.
    pub rounds: usize,
    /// The effects that are measured.
    pub measured: EffectSet,
    /// Whether the builds are.
    pub builds: bool,
}

/// What a scene calls for, and what that costs.
#[derive(Clone, Debug)]
pub struct SceneStudy {
    /// One for each measured effect, in the order of [`crate::render::effects::ALL`].
    pub effects: Vec<EffectRow>,
    /// One for each build, in the order of [`Build::ALL`], if they are measured; without first draws, which take processes of their
    /// own.
    pub builds: Vec<BuildRow>,
}

/// Measures a scene. `progress` hears of each frame.
///
/// # Errors
/// The scene is beyond the device, there is no memory, or the driver fails.
pub fn study(
    renderer: &Renderer,
    name: &str,
    scene: &Scene,
    options: &Options,
    progress: &dyn Fn(),
) -> Result<SceneStudy, RenderError> {
    let uploaded = Uploaded::new(renderer, scene, EffectSet::ALL)?;
    let bench = Bench {
        renderer,
        uploaded: &uploaded,
        name,
        options,
        progress,
    };
    let effects = options.measured.iter();
    Ok(SceneStudy {
        effects: effects
            .map(|effect| bench.effect(effect, effect.callers(scene)))
            .collect::<Result<_, _>>()?,
        builds: if options.builds {
            bench.builds()?
        } else {
            Vec::new()
        },
    })
}

/// How many frames the study of a scene draws, for a progress bar.
pub fn frames(scene: &Scene, options: &Options) -> u64 {
    let measured = options.measured.iter().count();
    let called_for = Census::of(scene).called_for().and(options.measured);
    let builds = if options.builds { Build::ALL.len() } else { 0 };
    let kinds = 2 * measured + called_for.iter().count() + builds;
    (kinds * options.rounds) as u64
}

struct Bench<'a> {
    renderer: &'a Renderer,
    uploaded: &'a Uploaded<'a>,
    name: &'a str,
    options: &'a Options,
    progress: &'a dyn Fn(),
}

impl<'a> Bench<'a> {
    fn frame(&self, effects: Effects) -> Result<Frame<'a>, RenderError> {
        let settings = Settings {
            effects,
            ..self.options.settings
        };
        Frame::new(self.renderer, self.uploaded, &settings)
    }

    fn effect(&self, effect: &Effect, callers: Vec<Caller>) -> Result<EffectRow, RenderError> {
        let allowed = EffectSet::ALL.without(effect);
        let without = Effects {
            allowed,
            ..Effects::default()
        };
        let idle = Effects {
            idle: EffectSet::NONE.with(effect),
            ..without
        };
        let mut frames = vec![self.frame(without)?, self.frame(idle)?];
        if !callers.is_empty() {
            frames.push(self.frame(Effects::default())?);
        }
        let times = self.in_turn(&mut frames)?;
        let with = times.get(2);
        let cost = with.map(|with| difference(with, &times[0]));
        let unused = ratio(&times[1], &times[0]);
        Ok(EffectRow {
            scene: self.name.to_owned(),
            effect: effect.name,
            called_for_by: callers.iter().map(Caller::to_string).collect(),
            frame_ms_with: with.map(|with| middle(with)),
            frame_ms_without: middle(&times[0]),
            cost_ms: cost.map(|cost| cost.estimate),
            cost_ms_95: cost.map(Interval95::from),
            unused_cost_percent: percent(unused.estimate),
            unused_cost_percent_95: Interval95::from(unused).map(percent),
        })
    }

    fn builds(&self) -> Result<Vec<BuildRow>, RenderError> {
        let mut frames = Vec::new();
        for build in Build::ALL {
            frames.push(self.frame(Effects {
                build,
                ..Effects::default()
            })?);
        }
        let times = self.in_turn(&mut frames)?;
        let pictures: Vec<Picture> = frames
            .iter()
            .map(Frame::picture)
            .collect::<Result<_, _>>()?;
        let scene = Build::ALL.iter().position(|build| *build == Build::Scene);
        let base = &times[scene.unwrap_or_default()];
        let rows = Build::ALL.iter().zip(&frames).zip(&times).zip(&pictures);
        Ok(rows
            .map(|(((build, frame), times), picture)| {
                let relative = ratio(times, base);
                BuildRow {
                    scene: self.name.to_owned(),
                    build: build.name(),
                    pipelines: frame.surface_pipelines(),
                    first_draw_cold_ms: None,
                    first_draw_warm_ms: None,
                    frame_ms: middle(times),
                    relative: relative.estimate,
                    relative_95: relative.into(),
                    max_difference: picture.max_difference(&pictures[0]),
                }
            })
            .collect())
    }

    /// Draws the frames in turn, each first in its turn and then the other way round, so that none always follows the same
    /// one; for each its times. One round before them is not counted.
    fn in_turn(&self, frames: &mut [Frame<'a>]) -> Result<Vec<Vec<f64>>, RenderError> {
        for frame in frames.iter_mut() {
            frame.draw()?;
        }
        let mut times = vec![Vec::with_capacity(self.options.rounds); frames.len()];
        for round in 0..self.options.rounds {
            let count = frames.len();
            let mut order: Vec<_> = (0..count).map(|place| (place + round) % count).collect();
            if round / count % 2 == 1 {
                order.reverse();
            }
            for place in order {
                times[place].push(frames[place].draw()?.ms());
                (self.progress)();
            }
        }
        Ok(times)
    }
}

fn middle(times: &[f64]) -> f64 {
    median(times).unwrap_or(f64::NAN)
}

fn ratio(a: &[f64], b: &[f64]) -> Interval {
    paired_ratio(&pairs(a, b)).unwrap_or(Interval::UNKNOWN)
}

fn difference(a: &[f64], b: &[f64]) -> Interval {
    paired_difference(&pairs(a, b)).unwrap_or(Interval::UNKNOWN)
}

fn pairs(a: &[f64], b: &[f64]) -> Vec<(f64, f64)> {
    a.iter().copied().zip(b.iter().copied()).collect()
}

/// How much more than 1, in percent.
fn percent(ratio: f64) -> f64 {
    (ratio - 1.0) * 100.0
}
