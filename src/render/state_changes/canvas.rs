//! Where do modes draw, and what did that take?

use std::sync::Arc;
use std::time::Instant;

use super::super::picture::Picture;
use super::super::targets::Targets;
use super::case::Made;
use crate::gpu::{Buffer, Device, Error, Pass, PassCounts, Recorder, Samples, Timestamps};

/// The pass's label.
pub const NAME: &str = "shading";

/// A mode that is ready to draw a scene.
pub trait Drawing {
    /// What making it took.
    fn made(&self) -> Made;

    /// What its pass must count.
    fn expected(&self) -> PassCounts;

    /// Records its pass.
    fn commands<'a>(&'a self, pass: &mut Pass<'_, 'a>);
}

/// Targets and a clock, for modes that draw in turn.
pub struct Canvas {
    device: Arc<Device>,
    targets: Targets,
    timestamps: Option<Timestamps>,
}

/// What one frame took.
#[derive(Clone, PartialEq, Debug)]
pub struct Sample {
    /// Recording its commands, ns.
    pub record_ns: f64,
    /// From its submission until the device is idle, ms. Nothing is copied to the host.
    pub submit_to_idle_ms: f64,
    /// Between the device's timestamps around the pass, ms; `None` where the queue has no clock.
    pub gpu_ms: Option<f64>,
    /// What was recorded.
    pub counts: PassCounts,
}

impl Canvas {
    /// A canvas of one sample a pixel.
    ///
    /// # Errors
    /// The size is beyond the device, or there is no memory.
    pub fn new(device: &Arc<Device>, (width, height): (u32, u32)) -> Result<Self, Error> {
        device.check_target_size(width, height)?;
        Ok(Self {
            targets: Targets::new(device, width, height, Samples::One)?,
            timestamps: Timestamps::new(device)?,
            device: Arc::clone(device),
        })
    }

    /// Draws once and waits.
    ///
    /// # Errors
    /// The driver fails.
    pub fn sample(&self, case: &dyn Drawing) -> Result<Sample, Error> {
        let mut recorder = Recorder::new(&self.device, "frame")?;
        let before = Instant::now();
        match &self.timestamps {
            Some(stamps) => recorder.timed(stamps, |recorder| self.record(case, recorder)),
            None => self.record(case, &mut recorder),
        }
        let recorded = recorder.finish()?;
        let record_ns = before.elapsed().as_secs_f64() * 1e9;
        let before = Instant::now();
        let passes = recorded.submit()?;
        let submit_to_idle_ms = before.elapsed().as_secs_f64() * 1e3;
        let gpu_ms = self.timestamps.as_ref().map(Timestamps::elapsed_ms);
        Ok(Sample {
            record_ns,
            submit_to_idle_ms,
            gpu_ms: gpu_ms.transpose()?,
            counts: the_one(passes),
        })
    }

    /// Records once, and throws the commands away: ns, and what was recorded.
    ///
    /// # Errors
    /// The driver fails.
    pub fn record_and_reset(&self, case: &dyn Drawing) -> Result<(f64, PassCounts), Error> {
        let before = Instant::now();
        let mut recorder = Recorder::new(&self.device, "frame")?;
        self.record(case, &mut recorder);
        let passes = recorder.finish()?.discard();
        Ok((before.elapsed().as_secs_f64() * 1e9, the_one(passes)))
    }

    /// Draws once and brings the picture to the host.
    ///
    /// # Errors
    /// The driver fails, or there is no memory.
    pub fn picture(&self, case: &dyn Drawing) -> Result<Picture, Error> {
        let mut readback: Buffer = self.targets.readback(&self.device)?;
        let mut recorder = Recorder::new(&self.device, "picture")?;
        self.record(case, &mut recorder);
        self.targets.record_readback(&mut recorder, &mut readback);
        recorder.submit()?;
        self.targets.picture(&readback)
    }

    fn record<'a>(&'a self, case: &'a dyn Drawing, recorder: &mut Recorder<'a>) {
        recorder.pass(&self.targets.pass(NAME, &[]), |pass| case.commands(pass));
    }
}

/// A canvas records one pass.
fn the_one(mut passes: Vec<PassCounts>) -> PassCounts {
    passes.swap_remove(0)
}
