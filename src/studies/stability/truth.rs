//! What should a function of the library give, where is that asked of it, and how near must it come?

use glam::Vec3;

use crate::interface::ProbeInput;
use crate::reference::beckmann;
use crate::reference::given::{self, Given, diffuse, fresnel, specular};
use crate::render::library::{Function, Shape, Tier};

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
/// Of terms that cancel to less than this share of themselves nothing is promised.
const LEAST_LEFT: f64 = 1.0e-3;
/// Metals in the visible have 0.3 and more.
const LEAST_METAL_F0: f64 = 0.1;
/// Of clear stuffs: diamond has 0.17.
const DIELECTRIC_F0: std::ops::RangeInclusive<f64> = 1.0e-6..=0.2;
/// A length's square this far from 1 is no unit vector's: what rounding leaves is 4e-7 at most.
const UNIT: f64 = 1.0e-6;

/// The truth of a function, and what is promised of its value.
pub struct Truth {
    function: &'static Function,
    value: Value,
}

/// The value in f64 at vectors, and at the numbers of an input.
type Value = fn(&Given, &ProbeInput) -> f64;

impl Truth {
    /// That of a function; the slides' listings are held against their own formulas.
    pub fn of(function: &'static Function) -> Self {
        let value: Value = match function.name {
            "oren-nayar" => |at, to| given::conserving_oren_nayar(at, sigma(to)),
            "slides-oren-nayar" => |at, to| given::oren_nayar(at, sigma(to)),
            "cook-torrance" => |at, to| given::cook_torrance(at, width(to), f0(to)),
            "slides-cook-torrance" => |at, to| given::slides_cook_torrance(at, sigma(to), f0(to)),
            "beckmann-d" => |at, to| given::beckmann_d(at, width(to)),
            "v-cavity-g" => |at, _| given::v_cavity_g(at),
            "schlick-f" => |at, to| given::schlick_f(at, f0(to)),
            "lambert" => |at, _| diffuse::lambert(at),
            "fon" => |at, to| diffuse::fujii(at, sigma(to)),
            "eon" => |at, to| diffuse::eon(at, sigma(to), extra(to)[0]),
            "full-oren-nayar" => |at, to| diffuse::full_oren_nayar(at, sigma(to), extra(to)[0]),
            "blinn-phong" => |at, to| specular::blinn_phong(at, width(to), f0(to)),
            "beckmann-smith" => |at, to| specular::beckmann_smith_rational(at, width(to), f0(to)),
            "beckmann-smith-exact" => |at, to| specular::beckmann_smith(at, width(to), f0(to)),
            "ggx" => |at, to| specular::ggx(at, width(to), f0(to)),
            "ggx-multi" => |at, to| specular::ggx_multi(at, width(to), f0(to)),
            "f82-f" => |at, to| fresnel::f82(at, f0(to), extra(to)[0]),
            "dielectric-f" => |at, to| fresnel::dielectric(at, f0(to)),
            "conductor-f" => |at, to| fresnel::conductor(at, extra(to)[0], extra(to)[1]),
            "spectral-f" => |at, to| fresnel::spectral(at, f0(to), extra(to)),
            "corrected" => |at, to| given::corrected(at, sigma(to), f0(to)),
            // No truth: a test asks each function of the library for a number.
            _ => |_, _| f64::NAN,
        };
        Self { function, value }
    }

    /// Whether it is a lobe with a peak.
    pub fn has_peak(&self) -> bool {
        matches!(self.function.shape, Shape::Lobe | Shape::Clamped)
    }

    /// The value at an input.
    pub fn at(&self, input: &ProbeInput) -> f64 {
        (self.value)(&seen(input), input)
    }

    /// How far from it a value may be, relative; `None` where nothing is promised.
    pub fn bound(&self, tier: Tier, input: &ProbeInput) -> Option<f64> {
        let at = seen(input);
        if !self.is_within(tier, input, &at) {
            return None;
        }
        let c = match self.function.shape {
            Shape::Flat => 1.0,
            Shape::Cosines | Shape::Lobe | Shape::Clamped => at.least_cosine().min(1.0),
        };
        let bound = match (tier, self.width(input)) {
            (Tier::F16, _) if self.function.shape == Shape::Flat => 5.0e-3,
            (Tier::F16, _) => 2.0e-3 + 1.0e-3 / c,
            (Tier::F32, None) => 2.0e-6 + 2.0e-7 / c,
            // The first is the exponent's own: four roundings of at most 13.8.
            (Tier::F32, Some(m)) => 2.0e-6 + 1.0e-6 / m + 3.0e-6 / c,
            (Tier::F32Compensated, None) => 2.0e-6,
            (Tier::F32Compensated, Some(_)) => 1.0e-5,
        };
        Some(self.looseness() * bound * self.cancelled(&at, input)?)
    }

    /// What a function's longer way of rounding adds.
    fn looseness(&self) -> f64 {
        match self.function.name {
            // Amplitudes are squared twice.
            "dielectric-f" | "conductor-f" => 5.0,
            // A polynomial of terms that cancel.
            "ggx-multi" => 2.0,
            _ => 1.0,
        }
    }

    /// Whether accuracy is promised there.
    fn is_within(&self, tier: Tier, input: &ProbeInput, at: &Given) -> bool {
        let unit = |v: &Vec3| (v.as_dvec3().length_squared() - 1.0).abs() <= UNIT;
        let unit = input.vectors().iter().all(unit);
        // A device may take such an f0 for 0, and if not, its product has few bits left.
        if !unit || input.f0.is_subnormal() || !(0.0..=1.0).contains(&input.roughness) {
            return false;
        }
        if !self.function.takes_extra_of(input) || !self.takes_reflectance(input) {
            return false;
        }
        if self.function.shape == Shape::Flat {
            return tier != Tier::F16 || input.f0 >= LEAST_HALF_F0;
        }
        let far = self.width(input).is_some_and(|m| {
            f64::from(input.roughness) < LEAST_ROUGHNESS
                || at.beckmann_exponent(m) > LARGEST_EXPONENT
        });
        let least = match tier {
            Tier::F16 => LEAST_HALF_COSINE,
            Tier::F32 | Tier::F32Compensated => LEAST_COSINE,
        };
        at.least_cosine() >= least && !far
    }

    /// Whether accuracy is promised for a Fresnel term's numbers: a clear interface's curve asks for 1 - sqrt(f0), of which a metal's f0
    /// leaves few digits, and a metal's for n - 1, which nothing like a metal leaves none of.
    fn takes_reflectance(&self, input: &ProbeInput) -> bool {
        match self.function.name {
            "dielectric-f" => f0(input) == 0.0 || DIELECTRIC_F0.contains(&f0(input)),
            "conductor-f" => {
                let [n, k, ..] = extra(input);
                let at = |n: f64| n * n + k * k;
                at(n - 1.0) >= LEAST_METAL_F0 * at(n + 1.0)
            }
            _ => true,
        }
    }

    /// Which roughness the lobe has at the input's, if it is a lobe with a peak.
    fn width(&self, input: &ProbeInput) -> Option<f64> {
        match self.function.shape {
            Shape::Flat | Shape::Cosines => None,
            Shape::Lobe => Some(width(input)),
            Shape::Clamped => Some(beckmann::under_disc(sigma(input), 0.0)),
        }
    }

    /// The sum of a value's terms without their signs over the value: what is left of a difference has that much more of the
    /// terms' error. `None` where less than a thousandth is left.
    fn cancelled(&self, at: &Given, input: &ProbeInput) -> Option<f64> {
        let terms = match self.function.name {
            "fon" => diffuse::fujii_terms(at, sigma(input)),
            "eon" => diffuse::eon_terms(at, sigma(input), extra(input)[0]),
            "full-oren-nayar" => diffuse::full_oren_nayar_terms(at, sigma(input), extra(input)[0]),
            "f82-f" => fresnel::f82_terms(at, f0(input), extra(input)[0]),
            "spectral-f" => fresnel::spectral_terms(at, f0(input), extra(input)),
            _ => return Some(1.0),
        };
        let value = self.at(input);
        (value >= LEAST_LEFT * terms).then(|| terms / value.max(f64::MIN_POSITIVE))
    }
}

fn sigma(input: &ProbeInput) -> f64 {
    input.roughness.into()
}

/// The width of a lobe, which stops where accuracy does.
fn width(input: &ProbeInput) -> f64 {
    sigma(input).max(LEAST_ROUGHNESS)
}

fn f0(input: &ProbeInput) -> f64 {
    input.f0.into()
}

fn extra(input: &ProbeInput) -> [f64; 4] {
    input.extra.map(f64::from)
}

fn seen(input: &ProbeInput) -> Given {
    let [n, l, e] = input.vectors();
    Given::new(n, l, e)
}
