//! Is every truth a number that a surface can have, whatever the vectors? Random inputs, shrunk to the least that fails.

use glam::{Quat, Vec3};
use proptest::prelude::*;
use umber::interface::ProbeInput;
use umber::reference::given::Given;
use umber::render::library::{FUNCTIONS, Function};
use umber::studies::stability::Truth;

use crate::tolerances::GIVEN_SWAPPED;

/// A cosine from 1 down to 2^-30, each octave as likely as the next, of either side; and the special ones.
fn cosine() -> impl Strategy<Value = f32> {
    prop_oneof![
        8 => (0.0_f32..30.0).prop_map(|octave| (-octave).exp2()),
        2 => (0.0_f32..30.0).prop_map(|octave| -(-octave).exp2()),
        1 => prop::sample::select(vec![0.0_f32, 1.0, -1.0, f32::MIN_POSITIVE, 1e-42]),
    ]
}

fn azimuth() -> impl Strategy<Value = f32> {
    prop_oneof![
        -std::f32::consts::PI..std::f32::consts::PI,
        prop::sample::select(vec![0.0, std::f32::consts::PI]),
    ]
}

/// A direction about the normal +y, before all is turned.
fn direction() -> impl Strategy<Value = Vec3> {
    (cosine(), azimuth()).prop_map(|(cosine, azimuth)| {
        let sine = ((1.0 - cosine) * (1.0 + cosine)).max(0.0).sqrt();
        Quat::from_rotation_y(azimuth) * Vec3::new(sine, cosine, 0.0)
    })
}

/// The same on the side that the normal is on.
fn above([n, l, e]: [Vec3; 3]) -> [Vec3; 3] {
    let above = |v: Vec3| if n.dot(v) < 0.0 { -v } else { v };
    [n, above(l), above(e)]
}

/// Light and eye apart, equal, opposite or mirrored, under any normal, all normalised in 32 bits.
fn vectors() -> impl Strategy<Value = [Vec3; 3]> {
    let turn = (-3.0_f32..3.0, -3.0_f32..3.0);
    (direction(), direction(), 0..5_u8, turn).prop_map(
        |(light, other, kind, (about_x, about_z))| {
            let eye = match kind {
                0 => light,
                1 => -light,
                2 => Vec3::new(-light.x, light.y, -light.z),
                _ => other,
            };
            let turn = Quat::from_rotation_x(about_x) * Quat::from_rotation_z(about_z);
            [Vec3::Y, light, eye].map(|v| (turn * v).normalize())
        },
    )
}

fn input() -> impl Strategy<Value = ProbeInput> {
    let roughness = prop_oneof![
        (0.0_f32..14.0).prop_map(|octave| (-octave).exp2()),
        Just(0.0),
        Just(1.0),
    ];
    let f0 = prop_oneof![0.0_f32..=1.0, Just(0.0), Just(1.0), Just(0.02)];
    let extra = prop::array::uniform4(0.0_f32..=1.0);
    (vectors(), roughness, f0, extra).prop_map(|(vectors, roughness, f0, extra)| ProbeInput {
        extra,
        ..ProbeInput::new(vectors.map(|v| v.to_array()), roughness, f0)
    })
}

/// Those whose f is the same from both sides, and how large the terms are of which it is a difference.
const RECIPROCAL: [(&str, f64); 10] = [
    ("oren-nayar", 0.0),
    ("cook-torrance", 0.0),
    ("corrected", 0.0),
    ("fon", 2.0),
    ("eon", 2.0),
    ("full-oren-nayar", 2.0),
    ("beckmann-smith", 0.0),
    ("beckmann-smith-exact", 0.0),
    ("ggx", 0.0),
    ("ggx-multi", 0.0),
];

/// Far below it f64 has subnormal numbers, which keep no digits.
const LEAST: f64 = 1.0e-290;

fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 20_000,
        // Failures are told by their input, not kept beside the sources.
        failure_persistence: None,
        // A light or an eye in the surface itself.
        max_global_rejects: 20_000,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn every_truth_is_a_number_and_not_negative(input in input()) {
        for function in FUNCTIONS.iter().filter(|function| !function.is_listing) {
            let value = Truth::of(function).at(&function.ranged(input));
            prop_assert!(value.is_finite() && value >= 0.0, "{}: {value:e}", function.name);
        }
    }

    #[test]
    fn light_and_eye_may_change_places(input in input()) {
        let [n, l, e] = above(input.vectors());
        let at = Given::new(n, l, e);
        prop_assume!(at.least_cosine() > 0.0);
        let input = ProbeInput { light: l.to_array(), eye: e.to_array(), ..input };
        let swapped = ProbeInput { light: input.eye, eye: input.light, ..input };
        for (name, terms) in RECIPROCAL {
            let function = Function::of_name(name).expect("a function");
            let truth = Truth::of(function);
            let there = truth.at(&function.ranged(input)) / at.nol;
            let back = truth.at(&function.ranged(swapped)) / at.noe;
            let apart = (there - back).abs();
            prop_assert!(
                apart <= GIVEN_SWAPPED * there.max(back).max(terms) + LEAST,
                "{name}: {there:e} and {back:e}"
            );
        }
    }
}
