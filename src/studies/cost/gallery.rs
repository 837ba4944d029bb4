//! How do models look in every scene, and how long do their frames take there?

use std::collections::HashMap;

use super::pareto::{Point, front};
use super::sight::{Look, Sight, SightError};
use crate::math::statistics::{median, paired_ratio};
use crate::reference::ladders::Mix;
use crate::reference::shade::Lighting;
use crate::render::{Frame, FrameReport, Picture, RenderError, Renderer, Uploaded};
use crate::report::{Interval95, SceneCost};
use crate::scene::Scene;

/// Models that take turns with the default one.
const TOGETHER: usize = 6;

/// The model that frames have if nothing else is said.
pub const DEFAULT: Lighting = Lighting::Mixed(Mix::BEST);

/// A scene and what was seen of it so far.
pub struct Exhibit<'s> {
    /// Its file.
    pub name: String,
    sight: Sight<'s>,
    looks: HashMap<Lighting, Look>,
    times: HashMap<Lighting, FrameTime>,
}

/// A model's frame.
#[derive(Clone, Copy, Debug)]
pub struct FrameTime {
    /// Median.
    pub ms: f64,
    /// Over the default model's, frame by frame.
    pub of_default: f64,
    /// 95 %.
    pub of_default_95: Interval95,
}

impl<'s> Exhibit<'s> {
    /// A scene that `sight::made_opaque` gave, uploaded.
    ///
    /// # Errors
    /// The scene is beyond the device, there is no memory, or the driver fails.
    pub fn new(
        renderer: &'s Renderer,
        uploaded: &'s Uploaded<'s>,
        (name, scene): (&str, &Scene),
        size: (u32, u32),
    ) -> Result<Self, RenderError> {
        Ok(Self {
            name: name.to_owned(),
            sight: Sight::new(renderer, uploaded, scene, size)?,
            looks: HashMap::new(),
            times: HashMap::new(),
        })
    }

    /// The picture that models are held against.
    pub fn reference(&self) -> &Picture {
        self.sight.reference()
    }

    /// How pictures are shown.
    pub fn sight(&self) -> &Sight<'s> {
        &self.sight
    }

    /// Looks at a model, the first time that it is asked for.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn look(&mut self, lighting: Lighting) -> Result<&Look, SightError> {
        if !self.looks.contains_key(&lighting) {
            let mut frame = self.sight.frame(lighting)?;
            let report = frame.draw().map_err(RenderError::from)?;
            self.looks
                .insert(lighting, self.sight.look(&frame, &report)?);
        }
        Ok(&self.looks[&lighting])
    }

    /// What was seen of a model, if it was looked at.
    pub fn seen(&self, lighting: Lighting) -> Option<&Look> {
        self.looks.get(&lighting)
    }

    /// Times frames of models in turn with the default one, `rounds` each, and looks at them. `progress` hears of each model.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn time(
        &mut self,
        models: &[Lighting],
        rounds: usize,
        progress: &dyn Fn(),
    ) -> Result<(), SightError> {
        let new: Vec<Lighting> = models
            .iter()
            .copied()
            .filter(|model| !self.times.contains_key(model))
            .collect();
        for some in new.chunks(TOGETHER) {
            let all = [DEFAULT].into_iter().chain(some.iter().copied());
            let frames = all.map(|lighting| self.sight.frame(lighting));
            let mut frames = frames.collect::<Result<Vec<_>, _>>()?;
            let reports = in_turn(&mut frames, rounds)?;
            let (default, own) = reports.split_at(1);
            for ((lighting, reports), frame) in some.iter().zip(own).zip(&frames[1..]) {
                self.times
                    .insert(*lighting, frame_time(reports, &default[0]));
                if let (false, Some(report)) = (self.looks.contains_key(lighting), reports.first())
                {
                    self.looks
                        .insert(*lighting, self.sight.look(frame, report)?);
                }
                progress();
            }
        }
        Ok(())
    }

    /// What its frames took, if they were timed.
    pub fn frame_time(&self, lighting: Lighting) -> Option<FrameTime> {
        self.times.get(&lighting).copied()
    }

    /// The rows of models that were looked at; a frame's time where it was taken.
    pub fn rows(&self, models: &[Lighting]) -> Vec<Option<SceneCost>> {
        let mut rows: Vec<Option<SceneCost>> =
            models.iter().map(|model| self.row(*model)).collect();
        let points = rows.iter().map(|row| Point {
            time: row
                .as_ref()
                .and_then(|row| row.of_default)
                .unwrap_or(f64::NAN),
            error: row.as_ref().map_or(f64::NAN, |row| row.flip_mean),
        });
        let on = front(&points.collect::<Vec<_>>());
        for (row, on) in rows.iter_mut().zip(on) {
            if let Some(row) = row {
                row.pareto = on;
            }
        }
        rows
    }

    fn row(&self, lighting: Lighting) -> Option<SceneCost> {
        let look = self.looks.get(&lighting)?;
        let time = self.times.get(&lighting);
        Some(SceneCost {
            scene: self.name.clone(),
            flip_mean: look.flip_mean,
            flip_p95: look.flip_p95,
            code_max: look.code_max,
            first_draw_ms: look.first_draw_ms,
            frame_ms: time.map(|time| time.ms),
            of_default: time.map(|time| time.of_default),
            of_default_95: time.map_or(Interval95::UNBOUNDED, |time| time.of_default_95),
            pareto: false,
        })
    }
}

/// Frame by frame, round by round. What is compiled at the first draw was compiled when the frames were made.
pub(super) fn in_turn(
    frames: &mut [Frame],
    rounds: usize,
) -> Result<Vec<Vec<FrameReport>>, RenderError> {
    let mut reports = vec![Vec::with_capacity(rounds); frames.len()];
    for _ in 0..rounds {
        for (frame, reports) in frames.iter_mut().zip(&mut reports) {
            reports.push(frame.draw()?);
        }
    }
    Ok(reports)
}

fn frame_time(own: &[FrameReport], default: &[FrameReport]) -> FrameTime {
    let ms =
        |reports: &[FrameReport]| -> Vec<f64> { reports.iter().map(FrameReport::ms).collect() };
    let (own, default) = (ms(own), ms(default));
    let pairs: Vec<_> = own.iter().copied().zip(default).collect();
    let ratio = paired_ratio(&pairs);
    FrameTime {
        ms: median(&own).unwrap_or(f64::NAN),
        of_default: ratio.map_or(f64::NAN, |ratio| ratio.estimate),
        of_default_95: ratio.map_or(Interval95::UNBOUNDED, Interval95::from),
    }
}
