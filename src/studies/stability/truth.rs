//! What should a function of the library give, where is that asked of it, and how near must it come?

use glam::Vec3;

use crate::interface::ProbeInput;
use crate::reference::beckmann;
use crate::reference::given::{self, Given};
use crate::render::library::{Function, Tier};

/// Cosines below it are beyond what is promised.
const LEAST_COSINE: f64 = 1.0e-6;
/// In 16 bits a cosine of 0.01 has a step of 1e-3 of itself, and s one of 0.1.
const LEAST_HALF_COSINE: f64 = 1.0e-2;
/// Below it fifty times f0 has lost bits to the least half float, 6e-8.
const LEAST_HALF_F0: f32 = 1.0e-3;
/// So are roughnesses.
const LEAST_ROUGHNESS: f64 = 1.0e-4;
/// Nothing is promised where a lobe is below 1e-6 of its peak: -ln(1e-6).
const LARGEST_EXPONENT: f64 = 13.815_510_557_964_274;
/// A length's square this far from 1 is no unit vector's: what rounding leaves is 4e-7 at most.
const UNIT: f64 = 1.0e-6;

/// The truth of a function, and what is promised of its value.
pub struct Truth {
    /// The value in f64.
    value: fn(&Given, f64, f64) -> f64,
    /// Which roughness the lobe has at one of the input's, if it is a lobe with a peak.
    width: Option<fn(f64) -> f64>,
    /// Whether cosines matter.
    cosines: bool,
}

impl Truth {
    /// That of a function; the slides' listings are held against their own formulas.
    pub fn of(function: &Function) -> Self {
        let lobe = |value| Self {
            value,
            width: Some(|m| m.max(LEAST_ROUGHNESS)),
            cosines: true,
        };
        let plain = |value, cosines| Self {
            value,
            width: None,
            cosines,
        };
        match function.name {
            "oren-nayar" => plain(|at, sigma, _| given::conserving_oren_nayar(at, sigma), true),
            "slides-oren-nayar" => plain(|at, sigma, _| given::oren_nayar(at, sigma), true),
            "cook-torrance" => lobe(|at, m, f0| given::cook_torrance(at, at_least(m), f0)),
            "slides-cook-torrance" => lobe(given::slides_cook_torrance),
            "beckmann-d" => lobe(|at, m, _| given::beckmann_d(at, at_least(m))),
            "v-cavity-g" => plain(|at, _, _| given::v_cavity_g(at), true),
            "schlick-f" => plain(|at, _, f0| given::schlick_f(at, f0), false),
            _ => Self {
                value: given::corrected,
                width: Some(|m| beckmann::under_disc(m, 0.0)),
                cosines: true,
            },
        }
    }

    /// Whether it is a lobe with a peak.
    pub fn has_peak(&self) -> bool {
        self.width.is_some()
    }

    /// The value at an input.
    pub fn at(&self, input: &ProbeInput) -> f64 {
        (self.value)(&seen(input), input.roughness.into(), input.f0.into())
    }

    /// How far from it a value may be, relative; `None` where nothing is promised.
    pub fn bound(&self, tier: Tier, input: &ProbeInput) -> Option<f64> {
        let at = seen(input);
        let vectors = input.vectors();
        let unit = |v: &Vec3| (v.as_dvec3().length_squared() - 1.0).abs() <= UNIT;
        let roughness = f64::from(input.roughness);
        // A device may take such an f0 for 0, and if not, its product has few bits left.
        if input.f0.is_subnormal() {
            return None;
        }
        if !vectors.iter().all(unit) || !(0.0..=1.0).contains(&roughness) {
            return None;
        }
        if tier == Tier::F16 && input.f0 < LEAST_HALF_F0 && !self.cosines {
            return None;
        }
        let c = match self.cosines {
            true => at.least_cosine().min(1.0),
            false => 1.0,
        };
        let m = self.width.map(|width| width(roughness));
        let far = m.is_some_and(|m| {
            roughness < LEAST_ROUGHNESS || at.beckmann_exponent(m) > LARGEST_EXPONENT
        });
        let least = match tier {
            Tier::F16 => LEAST_HALF_COSINE,
            Tier::F32 | Tier::F32Compensated => LEAST_COSINE,
        };
        if c < least || far {
            return None;
        }
        Some(match (tier, m) {
            (Tier::F16, _) => match self.cosines {
                true => 2.0e-3 + 1.0e-3 / c,
                false => 5.0e-3,
            },
            (Tier::F32, None) => 2.0e-6 + 2.0e-7 / c,
            (Tier::F32, Some(m)) => 1.0e-6 / m + 2.0e-6 / c,
            (Tier::F32Compensated, None) => 2.0e-6,
            (Tier::F32Compensated, Some(_)) => 1.0e-5,
        })
    }
}

fn at_least(m: f64) -> f64 {
    m.max(LEAST_ROUGHNESS)
}

fn seen(input: &ProbeInput) -> Given {
    let [n, l, e] = input.vectors();
    Given::new(n, l, e)
}
