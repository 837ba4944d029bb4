//! Does a value step anywhere, where its shader changes branch?

use glam::{Quat, Vec3};
use umber::gpu::Error;
use umber::interface::ProbeInput;
use umber::render::library::{FUNCTIONS, Tier};
use umber::render::probe::Probe;
use umber::studies::stability::Truth;

use crate::harness::with_gpu;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A way through the inputs, of a number of 0 to 1.
type Path = fn(f32) -> ProbeInput;

/// A branch lies on each.
const PATHS: [(&str, Path); 8] = [
    // The smaller of two cosines; G.
    ("light from the surface up", |t| {
        at(elevated(t, 0.0), elevated(0.3, 0.5), 0.4, 0.04)
    }),
    // L.E - (N.L)(N.E) changes its sign; Fujii's divisor.
    ("light around", |t| {
        at(elevated(0.4, 3.2 * t), elevated(0.7, 0.0), 0.7, 0.5)
    }),
    // Where the exponential ends.
    ("light away from the mirror", |t| {
        at(
            elevated(0.6 + 0.399 * t, std::f32::consts::PI),
            elevated(0.6, 0.0),
            0.02,
            0.9,
        )
    }),
    // An arcsine's halves; Lambda's rational and whole ends.
    ("both together from the surface up", |t| {
        at(elevated(t, 0.3), elevated(t, 2.8), 0.6, 0.3)
    }),
    ("both on opposite sides at the surface", |t| {
        at(
            elevated(1e-5 + 1e-3 * t, 0.0),
            elevated(5e-4, std::f32::consts::PI),
            0.8,
            0.04,
        )
    }),
    // The least width; weights that are normalised up to one roughness.
    ("roughness", |t| {
        at(elevated(0.55, 0.2), elevated(0.5, 3.1), t, 0.04)
    }),
    // Below f0 = 0.02 grazing reflectance falls.
    ("f0", |t| at(elevated(0.1, 0.2), elevated(0.2, 3.1), 0.5, t)),
    ("what a function takes beside", |t| ProbeInput {
        extra: [t; 4],
        ..at(elevated(0.12, 0.0), elevated(0.15, 3.1), 0.6, 0.3)
    }),
];

/// A direction at that cosine, turned about the normal.
fn elevated(cosine: f32, azimuth: f32) -> Vec3 {
    let sine = ((1.0 - cosine) * (1.0 + cosine)).max(0.0).sqrt();
    Quat::from_rotation_y(azimuth) * Vec3::new(sine, cosine, 0.0)
}

fn at(light: Vec3, eye: Vec3, roughness: f32, f0: f32) -> ProbeInput {
    // No axis is the normal's.
    let tilt = Quat::from_rotation_x(0.7) * Quat::from_rotation_z(0.3);
    let turned = |v: Vec3| (tilt * v).normalize().to_array();
    ProbeInput {
        extra: [0.3; 4],
        ..ProbeInput::new([turned(Vec3::Y), turned(light), turned(eye)], roughness, f0)
    }
}

/// Intervals of a path, each of which is halved down to neighbouring floats.
const INTERVALS: u32 = 512;
/// 2^-9 down to 2^-24: as far as floats below 1 go.
const HALVINGS: u32 = 16;

/// An interval of a path, and the values at its ends.
#[derive(Clone, Copy)]
struct Interval {
    ends: [f32; 2],
    values: [f32; 2],
}

impl Interval {
    fn middle(&self) -> f32 {
        self.ends[0] + 0.5 * (self.ends[1] - self.ends[0])
    }

    /// The half over which the value changes more: a step stays, all else shrinks.
    fn half(&self, value: f32) -> Self {
        let middle = self.middle();
        let [low, high] = self.values;
        if (value - low).abs() > (high - value).abs() {
            Self {
                ends: [self.ends[0], middle],
                values: [low, value],
            }
        } else {
            Self {
                ends: [middle, self.ends[1]],
                values: [value, high],
            }
        }
    }
}

/// The narrowest intervals of a path over which a function changes most.
fn narrowed(probe: &Probe, input: &dyn Fn(f32) -> ProbeInput) -> Result<Vec<Interval>, Error> {
    let values = |places: &[f32]| -> Result<Vec<f32>, Error> {
        let inputs: Vec<_> = places.iter().map(|t| input(*t)).collect();
        let results = probe.at(&inputs)?;
        Ok(results.into_iter().map(|result| result.value).collect())
    };
    let places: Vec<f32> = (0..=INTERVALS)
        .map(|i| i as f32 / INTERVALS as f32)
        .collect();
    let first = values(&places)?;
    let pairs = places.windows(2).zip(first.windows(2));
    let mut intervals: Vec<_> = pairs
        .map(|(ends, values)| Interval {
            ends: [ends[0], ends[1]],
            values: [values[0], values[1]],
        })
        .collect();
    for _ in 0..HALVINGS {
        let middles: Vec<f32> = intervals.iter().map(Interval::middle).collect();
        let between = values(&middles)?;
        for (interval, value) in intervals.iter_mut().zip(between) {
            *interval = interval.half(value);
        }
    }
    Ok(intervals)
}

/// How large a step is over what two roundings may make of it; `None` where nothing is promised.
fn step(
    truth: &Truth,
    tier: Tier,
    interval: &Interval,
    input: &dyn Fn(f32) -> ProbeInput,
) -> Option<f64> {
    let ends = interval.ends.map(input);
    let bounds = [truth.bound(tier, &ends[0])?, truth.bound(tier, &ends[1])?];
    let [low, high] = interval.values.map(f64::from);
    let true_step = (truth.at(&ends[0]) - truth.at(&ends[1])).abs();
    let allowed = bounds[0] * low + bounds[1] * high + true_step;
    let apart = (low - high).abs();
    // A truth that steps itself would allow everything.
    let smooth = true_step <= 0.01 * low.max(high).max(f64::MIN_POSITIVE);
    Some(if apart == 0.0 {
        0.0
    } else if smooth {
        apart / allowed
    } else {
        f64::INFINITY
    })
}

#[test]
fn no_value_steps_between_neighbours() -> Outcome {
    with_gpu(|gpu| -> Outcome {
        for function in FUNCTIONS.iter().filter(|function| !function.is_listing) {
            let truth = Truth::of(function);
            for tier in function.tiers.iter().filter(|tier| **tier != Tier::F16) {
                let probe = Probe::new(&gpu.device, function, *tier)?;
                let (mut worst, mut judged) = ((0.0_f64, "", 0.0), 0);
                for (name, path) in PATHS {
                    let input = |t: f32| function.ranged(path(t));
                    for interval in narrowed(&probe, &input)? {
                        let Some(step) = step(&truth, *tier, &interval, &input) else {
                            continue;
                        };
                        judged += 1;
                        if step > worst.0 {
                            worst = (step, name, interval.ends[0]);
                        }
                    }
                }
                println!("{}, {}: {worst:?} of {judged}", function.name, tier.name());
                assert!(judged > 300, "{}: {judged} judged", function.name);
                assert!(worst.0 <= 1.0, "{}, {tier:?}: {worst:?}", function.name);
            }
        }
        Ok(())
    })
}

/// That the halving itself finds one.
#[test]
fn a_step_is_found() {
    let value = |t: f32| if t < 0.123_456_78 { t } else { t + 1e-3 };
    let ends = [0.123, 0.125];
    let mut interval = Interval {
        ends,
        values: ends.map(value),
    };
    for _ in 0..HALVINGS {
        interval = interval.half(value(interval.middle()));
    }
    let [low, high] = interval.values;
    assert!(high - low > 0.9e-3, "{low} to {high}");
}
