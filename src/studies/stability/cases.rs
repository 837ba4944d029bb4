//! Which inputs are hard, and who met them first?
//!
//! Each case has a domain and a generator. Vectors are normalised in 32 bits, as an application does it: a quarter of them
//! are then longer than 1.

use fastrand::Rng;
use glam::Vec3;

use crate::interface::ProbeInput;

/// A named family of inputs.
pub struct Case {
    /// Its name.
    pub name: &'static str,
    /// What is hard about it.
    pub what: &'static str,
    /// Where it was met.
    pub source: &'static str,
    make: fn(&mut Rng) -> ProbeInput,
}

/// Steps of the last place that a lattice goes to either side of a special value.
const LATTICE: i32 = 4;

impl Case {
    /// Its first `count` inputs, of a seed.
    pub fn inputs(&self, seed: u64, count: usize) -> Vec<ProbeInput> {
        let mut rng = Rng::with_seed(seed);
        (0..count).map(|_| (self.make)(&mut rng)).collect()
    }
}

/// All cases.
pub const CASES: &[Case] = &[
    Case {
        name: "generic",
        what: "light and eye anywhere above the surface",
        source: "the plain case, for comparison",
        make: |rng| {
            let n = direction(rng);
            of(n, above(rng, n), above(rng, n), rng)
        },
    },
    Case {
        name: "light-on-normal",
        what: "L has the bits of N: normalize(0), and acos above 1 where N is longer than 1",
        source: "the slides' Oren-Nayar listing: up to 13 times too bright",
        make: |rng| {
            let n = direction(rng);
            of(n, n, above(rng, n), rng)
        },
    },
    Case {
        name: "light-near-normal",
        what: "L within 3e-4 rad of N",
        source: "the slides' Oren-Nayar listing: up to 12.8 times too bright",
        make: |rng| {
            let n = direction(rng);
            let aside = tangent(rng, n) * logarithmic(rng, 1e-8, 3e-4);
            of(n, unit(n + aside), above(rng, n), rng)
        },
    },
    Case {
        name: "eye-on-normal",
        what: "E has the bits of N",
        source: "the slides' Oren-Nayar listing: up to 9.2 times too bright",
        make: |rng| {
            let n = direction(rng);
            of(n, above(rng, n), n, rng)
        },
    },
    Case {
        name: "all-on-normal",
        what: "L and E have the bits of N, off the axes",
        source: "KhronosGroup/glTF-Sample-Viewer #80 (N.V above 1, a power of a negative base)",
        make: |rng| {
            let n = direction(rng);
            of(n, n, n, rng)
        },
    },
    Case {
        name: "axis-noon",
        what: "N and L are the same axis: every pixel of a floor at noon",
        source: "the slides' Oren-Nayar listing where min and max keep NaN",
        make: |rng| {
            let axes = [Vec3::X, Vec3::Y, Vec3::Z];
            let n = axes[rng.usize(0..3)] * if rng.bool() { 1.0 } else { -1.0 };
            let e = if rng.bool() { n } else { above(rng, n) };
            of(n, n, e, rng)
        },
    },
    Case {
        name: "eye-at-horizon",
        what: "N.E is a few last places around 0, or below: the silhouette of a smooth normal",
        source: "the slides' Cook-Torrance listing: 0/0 in 0.07 to 0.17 % of an icosphere's pixels",
        make: |rng| {
            let n = direction(rng);
            let e = at_horizon(rng, n);
            of(n, above(rng, n), e, rng)
        },
    },
    Case {
        name: "light-at-horizon",
        what: "N.L is a few last places around 0",
        source: "terminators of smooth normals",
        make: |rng| {
            let n = direction(rng);
            let l = at_horizon(rng, n);
            of(n, l, above(rng, n), rng)
        },
    },
    Case {
        name: "light-below",
        what: "the light is behind the surface, and mostly the half vector too",
        source: "the slides' Cook-Torrance listing: 0/0 in a quarter of all configurations",
        make: |rng| {
            let n = direction(rng);
            let l = -above(rng, n);
            of(n, l, above(rng, n), rng)
        },
    },
    Case {
        name: "light-opposite-eye",
        what: "L = -E: there is no half vector",
        source: "the slides' Cook-Torrance listing: normalize(0)",
        make: |rng| {
            let n = direction(rng);
            let e = direction(rng);
            of(n, -e, e, rng)
        },
    },
    Case {
        name: "opposite-grazing",
        what: "L almost -E, both near the surface: products cancel; and at the roughest, lobes",
        source: "the slides' Cook-Torrance listing: 100 % wrong at a cosine of 1e-3",
        make: |rng| {
            let n = direction(rng);
            let t = tangent(rng, n);
            let l = tilted(n, t, logarithmic(rng, 1e-6, 1e-2));
            let e = tilted(n, -t, logarithmic(rng, 1e-6, 1e-2));
            let input = of(n, l, e, rng);
            let roughness = match rng.u8(0..4) {
                0 => 1.0,
                _ => input.roughness,
            };
            ProbeInput { roughness, ..input }
        },
    },
    Case {
        name: "both-grazing",
        what: "light and eye near the surface, from any side: tan(pi/2)",
        source: "the slides' Oren-Nayar listing: negative below a cosine of 1e-7",
        make: |rng| {
            let n = direction(rng);
            let (t, u) = (tangent(rng, n), tangent(rng, n));
            let l = tilted(n, t, logarithmic(rng, 1e-8, 1.0));
            let e = tilted(n, u, logarithmic(rng, 1e-8, 1.0));
            of(n, l, e, rng)
        },
    },
    Case {
        name: "mirror",
        what: "roughness 0, or too small for its square to be a number above 0",
        source: "mmp/pbrt-v4 #283 (division by zero for a roughness texture of 0)",
        make: |rng| ProbeInput {
            roughness: [0.0, f32::from_bits(1), 1e-30, 1e-20, 1e-10][rng.usize(0..5)],
            ..near_mirror(rng, 1e-6)
        },
    },
    Case {
        name: "smooth-peak",
        what: "roughness 1e-4 to 0.1, the half vector within three of it: 1 - (N.H)^2 cancels",
        source: "google/filament: squared sine from the cross product, for the same reason",
        make: |rng| {
            let m = logarithmic(rng, 1e-4, 0.1);
            ProbeInput {
                roughness: m,
                ..near_mirror(rng, 3.0 * m)
            }
        },
    },
    Case {
        name: "headlight",
        what: "L has the bits of E: 1 - H.E is below 0 where E is longer than 1",
        source: "world-of-claudecraft #2790 (a power of -1e-7, and the bloom spreads the NaN)",
        make: |rng| {
            let n = direction(rng);
            let l = above(rng, n);
            of(n, l, l, rng)
        },
    },
    Case {
        name: "interpolated-normal",
        what: "normals between two others, normalised again in 32 bits",
        source: "every smooth mesh",
        make: |rng| {
            let (a, t) = (direction(rng), rng.f32());
            let b = unit(a + direction(rng) * 0.3);
            let n = unit(a + (b - a) * t);
            of(n, above(rng, n), above(rng, n), rng)
        },
    },
    Case {
        name: "mapped-normal",
        what: "normals of 8 bits or of half floats, normalised in 32",
        source: "every normal map",
        make: |rng| {
            let n = direction(rng);
            let half = rng.bool();
            let coded = |x: f32| match half {
                true => half::f16::from_f32(x).to_f32(),
                false => (x * 127.0).round() / 127.0,
            };
            let n = unit(Vec3::new(coded(n.x), coded(n.y), coded(n.z)));
            of(n, above(rng, n), above(rng, n), rng)
        },
    },
    Case {
        name: "loose-length",
        what: "lengths off 1 by up to 4.5e-7, f0 down to 1e-4: 1 - H.E is not what L - E says",
        source: "Vulkan 1.3, precision of InverseSqrt: 2 units in the last place, and a product's rounding",
        make: |rng| {
            let n = direction(rng);
            let vectors = [n, above(rng, n), above(rng, n)];
            let loose = vectors.map(|v| v * (1.0 + 4.5e-7 * (2.0 * rng.f32() - 1.0)));
            let f0 = logarithmic(rng, 1e-4, 1.0);
            ProbeInput {
                f0,
                ..of(loose[0], loose[1], loose[2], rng)
            }
        },
    },
    Case {
        name: "half-vector-at-horizon",
        what: "light and eye opposite and so low that N.H is next to nothing",
        source: "the slides' Cook-Torrance listing: its divisor leaves the range of a float below 3.3e-10",
        make: |rng| {
            let n = direction(rng);
            let t = tangent(rng, n);
            let l = tilted(n, t, logarithmic(rng, 1e-12, 1e-6));
            let e = tilted(n, -t, logarithmic(rng, 1e-12, 1e-6));
            of(n, l, e, rng)
        },
    },
    Case {
        name: "parameter-edges",
        what: "roughness and f0 a few last places around 0, 1e-4, 1e-3, 0.02 and 1",
        source: "the ends of what a material may say",
        make: |rng| {
            let n = direction(rng);
            let mut edge = |values: &[f32]| {
                let steps = rng.i32(-LATTICE..=LATTICE);
                step(values[rng.usize(0..values.len())], steps).clamp(0.0, 1.0)
            };
            let roughness = edge(&[0.0, 1e-4, 1e-3, 1.0]);
            let f0 = edge(&[0.0, 0.02, 1.0]);
            ProbeInput {
                roughness,
                f0,
                ..of(n, above(rng, n), above(rng, n), rng)
            }
        },
    },
    Case {
        name: "lattice",
        what: "each component of each vector a few last places around 0, 1 and the diagonals",
        source: "axis-aligned geometry",
        make: |rng| {
            let mut near = || {
                let value = |rng: &mut Rng| {
                    let special = [0.0, 1.0, -1.0, 0.5_f32.sqrt(), -0.5_f32.sqrt()];
                    let special = special[rng.usize(0..special.len())];
                    step(special, rng.i32(-LATTICE..=LATTICE))
                };
                loop {
                    let v = Vec3::new(value(rng), value(rng), value(rng));
                    if v.length_squared() > 0.1 {
                        return unit(v);
                    }
                }
            };
            let (n, l, e) = (near(), near(), near());
            of(n, l, e, rng)
        },
    },
    Case {
        name: "tiny-components",
        what: "components so small that their products are no normal numbers",
        source: "drivers that flush such numbers to 0",
        make: |rng| {
            let mut skewed = || {
                let mut v = [1.0, 0.0, 0.0];
                v[1] = logarithmic(rng, 1e-40, 1e-15);
                v[2] = logarithmic(rng, 1e-40, 1e-15);
                v.rotate_right(rng.usize(0..3));
                Vec3::from(v)
            };
            let (n, l, e) = (skewed(), skewed(), skewed());
            of(n, l, e, rng)
        },
    },
];

/// An input of these vectors, any roughness and any f0.
fn of(n: Vec3, l: Vec3, e: Vec3, rng: &mut Rng) -> ProbeInput {
    let roughness = logarithmic(rng, 1e-4, 1.0);
    ProbeInput::new([n, l, e].map(Vec3::into), roughness, rng.f32())
}

/// A light at this cosine to any normal, and the eye anywhere above, or for a lobe with a peak where a facet within 2.5 m of
/// the normal mirrors it.
pub fn lit_from(cosine: f32, m: f32, peak: bool, rng: &mut Rng) -> ProbeInput {
    let n = direction(rng);
    let l = tilted(n, tangent(rng, n), cosine);
    let e = match peak {
        true => {
            let h = unit(n + tangent(rng, n) * (2.5 * m * rng.f32()));
            unit(h * (2.0 * h.dot(l)) - l)
        }
        false => above(rng, n),
    };
    ProbeInput {
        roughness: m,
        ..of(n, l, e, rng)
    }
}

/// A light anywhere above, and the eye where a facet at most `aside` off the normal mirrors it.
fn near_mirror(rng: &mut Rng, aside: f32) -> ProbeInput {
    let n = direction(rng);
    let l = above(rng, n);
    let h = unit(n + tangent(rng, n) * (aside * rng.f32()));
    let e = unit(h * (2.0 * h.dot(l)) - l);
    of(n, l, e, rng)
}

fn unit(v: Vec3) -> Vec3 {
    v.try_normalize().unwrap_or(Vec3::Y)
}

/// Uniform over the sphere.
fn direction(rng: &mut Rng) -> Vec3 {
    let z = 2.0 * rng.f32() - 1.0;
    let (sin, cos) = (std::f32::consts::TAU * rng.f32()).sin_cos();
    let across = (1.0 - z * z).max(0.0).sqrt();
    unit(Vec3::new(across * cos, across * sin, z))
}

/// Uniform over the hemisphere about `n`.
fn above(rng: &mut Rng, n: Vec3) -> Vec3 {
    let v = direction(rng);
    if v.dot(n) < 0.0 { -v } else { v }
}

/// Along the surface.
fn tangent(rng: &mut Rng, n: Vec3) -> Vec3 {
    loop {
        let across = n.cross(direction(rng));
        if across.length_squared() > 1e-4 {
            return unit(across);
        }
    }
}

/// At this cosine from `n`, towards the tangent `t`.
fn tilted(n: Vec3, t: Vec3, cosine: f32) -> Vec3 {
    unit(n * cosine + t * (1.0 - cosine * cosine).max(0.0).sqrt())
}

/// At a cosine of a few last places around 0, or further below.
fn at_horizon(rng: &mut Rng, n: Vec3) -> Vec3 {
    let t = tangent(rng, n);
    let cosine = match rng.bool() {
        true => rng.i32(-LATTICE..=LATTICE) as f32 * f32::EPSILON,
        false => -logarithmic(rng, 1e-9, 0.1),
    };
    tilted(n, t, cosine)
}

/// Each decade as likely as the next.
fn logarithmic(rng: &mut Rng, low: f32, high: f32) -> f32 {
    low * (high / low).powf(rng.f32())
}

/// So many floats further on.
fn step(x: f32, steps: i32) -> f32 {
    let mut x = x;
    for _ in 0..steps.unsigned_abs() {
        x = if steps > 0 {
            x.next_up()
        } else {
            x.next_down()
        };
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_case_repeats_and_gives_what_a_scene_can_contain() {
        for case in CASES {
            let inputs = case.inputs(1, 1000);
            assert_eq!(inputs, case.inputs(1, 1000), "{}", case.name);
            assert_ne!(inputs, case.inputs(2, 1000), "{}", case.name);
            for input in inputs {
                for v in input.vectors() {
                    assert!((v.length() - 1.0).abs() < 1e-6, "{}: {v}", case.name);
                }
                let numbers = [input.roughness, input.f0];
                let within = numbers.iter().all(|x| (0.0..=1.0).contains(x));
                assert!(within, "{}: {input:?}", case.name);
            }
        }
    }
}
