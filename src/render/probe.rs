//! What does a lighting function say on a device, value by value?
//!
//! One compute shader includes the files that every frame is shaded with, and calls them.

use std::sync::{Arc, Mutex, PoisonError};

use super::library::{Function, MODEL, Tier};
use super::variant::Variant;
use crate::gpu::{
    Binding, BindingKind, Buffer, BufferUse, ComputePipeline, Constant, DescriptorSet, Device,
    Error, PipelineCache, PipelineLayout, Recorder, Resource, SetLayout, Spirv, Statistic,
    Timestamps,
};
use crate::interface::reflected::{bindings, constants, values};
use crate::interface::{ProbeInput, ProbeResult};

/// Invocations of a dispatch: 16 MiB of inputs and 4 of results.
const MOST_INVOCATIONS: u32 = 1 << 18;

/// `local_size_x` of the shader.
const GROUP: u32 = 64;

const BINDINGS: [Binding; 2] = [
    Binding {
        slot: bindings::ProbeInputBlock,
        kind: BindingKind::Written,
    },
    Binding {
        slot: bindings::ProbeResultBlock,
        kind: BindingKind::Written,
    },
];

/// Where inputs come from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Chance {
    /// Drawn by the shader; each invocation keeps its last one, or the first whose value is no number or below 0.
    Kept,
    /// Drawn by the shader; each invocation keeps the one at which the tiers differ most, or the first bad one.
    Worst,
}

/// A function in a tier, on a device.
pub struct Probe {
    device: Arc<Device>,
    layout: Arc<SetLayout>,
    pipeline_layout: Arc<PipelineLayout>,
    cache: PipelineCache,
    function: &'static Function,
    tier: Tier,
    /// Of a whole model.
    variant: Option<Variant>,
    /// One for each source of inputs that was asked for: a CPU driver takes a second to compile one.
    made: Mutex<Vec<(i32, Arc<ComputePipeline>)>>,
}

/// The push constants of `interface/probe.glsl`, in order, before the range of what the function takes beside.
struct Job {
    seed: u32,
    first: u32,
    count: u32,
    repeats: u32,
}

/// Those four, and two ends of a range of four numbers.
const PUSHED: usize = 12;

impl Probe {
    /// A probe; its pipelines are made when they are first asked for.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(
        device: &Arc<Device>,
        function: &'static Function,
        tier: Tier,
    ) -> Result<Self, Error> {
        let layout = SetLayout::new(device, "probe", &BINDINGS)?;
        let bytes = (PUSHED * size_of::<u32>()) as u32;
        Ok(Self {
            pipeline_layout: PipelineLayout::for_compute(device, "probe", &layout, bytes)?,
            cache: PipelineCache::open(device, None)?,
            device: Arc::clone(device),
            layout,
            function,
            tier,
            variant: None,
            made: Mutex::default(),
        })
    }

    /// A probe of a whole model, or of one of its lobes: the terms say which; light from around is none of it.
    ///
    /// # Errors
    /// The driver fails.
    pub fn of_model(device: &Arc<Device>, variant: Variant) -> Result<Self, Error> {
        Ok(Self {
            variant: Some(variant),
            ..Self::new(device, &MODEL, Tier::F32)?
        })
    }

    /// What is probed.
    pub fn function(&self) -> &'static Function {
        self.function
    }

    /// The results at inputs of the host, in their order.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn at(&self, inputs: &[ProbeInput]) -> Result<Vec<ProbeResult>, Error> {
        let pipeline = self.pipeline(values::SOURCE_HOST)?;
        let mut results = Vec::with_capacity(inputs.len());
        for chunk in inputs.chunks(MOST_INVOCATIONS as usize) {
            let set = self.set(chunk)?;
            let job = Job {
                seed: 0,
                first: 0,
                count: chunk.len() as u32,
                repeats: 1,
            };
            set.dispatch(self, &pipeline, &job, None)?;
            results.extend(read::<ProbeResult>(
                &self.device,
                &set.results,
                chunk.len(),
            )?);
        }
        Ok(results)
    }

    /// Values at inputs drawn by chance: of each of `count` invocations `repeats`, of which it keeps one. Invocations are
    /// numbered from `first` on; the same seed and number draw the same inputs on every device, up to rounding.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn drawn(
        &self,
        chance: Chance,
        seed: u32,
        (first, count): (u32, u32),
        repeats: u32,
    ) -> Result<Vec<(ProbeInput, ProbeResult)>, Error> {
        let source = match chance {
            Chance::Kept => values::SOURCE_CHANCE,
            Chance::Worst => values::SOURCE_WORST,
        };
        let pipeline = self.pipeline(source)?;
        let mut all = Vec::with_capacity(count as usize);
        let most = count.clamp(1, MOST_INVOCATIONS);
        let blank = vec![bytemuck::Zeroable::zeroed(); most as usize];
        let set = self.set(&blank)?;
        let mut done = 0;
        while done < count {
            let now = most.min(count - done);
            let job = Job {
                seed,
                first: first.wrapping_add(done),
                count: now,
                repeats,
            };
            set.dispatch(self, &pipeline, &job, None)?;
            let inputs = read::<ProbeInput>(&self.device, &set.inputs, now as usize)?;
            let results = read::<ProbeResult>(&self.device, &set.results, now as usize)?;
            all.extend(inputs.into_iter().zip(results));
            done += now;
        }
        Ok(all)
    }

    /// A clock for evaluations at and about `inputs`: each invocation takes `repeats` of them, and each several times.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn clock(&self, inputs: &[ProbeInput], repeats: u32) -> Result<ProbeClock<'_>, Error> {
        let count = inputs.len().min(MOST_INVOCATIONS as usize);
        Ok(ProbeClock {
            probe: self,
            pipeline: self.pipeline(values::SOURCE_AGAIN)?,
            set: self.set(&inputs[..count])?,
            timestamps: Timestamps::new(&self.device)?,
            job: Job {
                seed: 0,
                first: 0,
                count: count as u32,
                repeats,
            },
        })
    }

    /// What the driver tells of the code that a clock runs; nothing where it cannot tell.
    ///
    /// # Errors
    /// The driver fails.
    pub fn statistics(&self) -> Result<Vec<Statistic>, Error> {
        self.pipeline(values::SOURCE_AGAIN)?.statistics()
    }

    fn pipeline(&self, source: i32) -> Result<Arc<ComputePipeline>, Error> {
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, pipeline)) = made.iter().find(|(known, _)| *known == source) {
            return Ok(Arc::clone(pipeline));
        }
        let pipeline = Arc::new(self.make(source)?);
        made.push((source, Arc::clone(&pipeline)));
        Ok(pipeline)
    }

    fn make(&self, source: i32) -> Result<ComputePipeline, Error> {
        let name = format!("probe[{}, {}]", self.function.name, self.tier.name());
        let constants = [
            (constants::PROBE_FUNCTION, self.function.constant),
            (constants::PROBE_TIER, self.tier.constant()),
            (constants::PROBE_SOURCE, source),
            (constants::PROBE_SHAPE, self.function.shape.constant()),
        ]
        .map(|(id, value)| Constant { id, value });
        let constants = [&constants[..], &self.model_constants()].concat();
        let shader = Spirv(self.function.shader);
        let layout = &self.pipeline_layout;
        ComputePipeline::new(&self.device, layout, &self.cache, &name, shader, &constants)
    }

    /// Tiers, and lobes.
    fn model_constants(&self) -> Vec<Constant> {
        let Some(variant) = self.variant else {
            return Vec::new();
        };
        let lobes = variant.lobes().map(|(id, on)| Constant {
            id,
            value: on.into(),
        });
        variant.constants().into_iter().chain(lobes).collect()
    }

    fn pushed(&self, job: &Job) -> [u32; PUSHED] {
        let low = self.function.extra_at([0.0; 4]).map(f32::to_bits);
        let high = self.function.extra_at([1.0; 4]).map(f32::to_bits);
        let mut pushed = [0; PUSHED];
        pushed[..4].copy_from_slice(&[job.seed, job.first, job.count, job.repeats]);
        pushed[4..8].copy_from_slice(&low);
        pushed[8..].copy_from_slice(&high);
        pushed
    }

    fn set(&self, inputs: &[ProbeInput]) -> Result<ProbeSet, Error> {
        let device = &self.device;
        let data = bytemuck::cast_slice(inputs);
        let inputs_buffer = Buffer::with_data(device, "probe: inputs", BufferUse::Written, data)?;
        let blank = vec![ProbeResult::default(); inputs.len()];
        let data = bytemuck::cast_slice(&blank);
        let results = Buffer::with_data(device, "probe: results", BufferUse::Written, data)?;
        let (inputs, results) = (Arc::new(inputs_buffer), Arc::new(results));
        let resources = [&inputs, &results].map(|buffer| Resource::Buffer(Arc::clone(buffer)));
        Ok(ProbeSet {
            set: DescriptorSet::new(&self.layout, "probe", &resources)?,
            inputs,
            results,
        })
    }
}

/// The probe's set, and what it points at.
struct ProbeSet {
    set: DescriptorSet,
    inputs: Arc<Buffer>,
    results: Arc<Buffer>,
}

impl ProbeSet {
    fn dispatch(
        &self,
        probe: &Probe,
        pipeline: &ComputePipeline,
        job: &Job,
        timestamps: Option<&Timestamps>,
    ) -> Result<(), Error> {
        let push = probe.pushed(job);
        let groups = job.count.div_ceil(GROUP);
        let mut recorder = Recorder::new(&probe.device, "probe")?;
        match timestamps {
            Some(timestamps) => recorder.timed(timestamps, |recorder| {
                recorder.dispatch(pipeline, &self.set, bytemuck::cast_slice(&push), groups);
            }),
            None => recorder.dispatch(pipeline, &self.set, bytemuck::cast_slice(&push), groups),
        }
        recorder.submit()?;
        Ok(())
    }
}

/// Evaluations that can be timed again and again.
pub struct ProbeClock<'p> {
    probe: &'p Probe,
    pipeline: Arc<ComputePipeline>,
    set: ProbeSet,
    timestamps: Option<Timestamps>,
    job: Job,
}

impl ProbeClock<'_> {
    /// Nanoseconds an evaluation: the device's clock, or the host's until the device is idle where it has none.
    ///
    /// # Errors
    /// The driver fails.
    pub fn ns(&self) -> Result<f64, Error> {
        let before = std::time::Instant::now();
        let timestamps = self.timestamps.as_ref();
        (self.set).dispatch(self.probe, &self.pipeline, &self.job, timestamps)?;
        let ns = match timestamps {
            Some(timestamps) => timestamps.elapsed_ms()? * 1e6,
            None => before.elapsed().as_secs_f64() * 1e9,
        };
        let evaluations = f64::from(self.job.count) * f64::from(self.job.repeats);
        Ok(ns / (evaluations * f64::from(values::AGAIN)))
    }
}

/// The first `count` records of a buffer that a dispatch wrote.
fn read<T: bytemuck::Pod>(
    device: &Arc<Device>,
    from: &Buffer,
    count: usize,
) -> Result<Vec<T>, Error> {
    let bytes = (count * size_of::<T>()) as u64;
    let mut to = Buffer::new(device, "probe: readback", BufferUse::Readback, bytes)?;
    let mut recorder = Recorder::new(device, "probe: read back")?;
    recorder.read_back(from, &mut to, bytes);
    recorder.submit()?;
    let records = to.read()?.chunks_exact(size_of::<T>());
    Ok(records.map(bytemuck::pod_read_unaligned).collect())
}
