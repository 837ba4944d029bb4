//! Where does the slides' listing break on this driver, and does the corrected form hold there?
//!
//! On both CPU drivers: NaN for L = E = N with normals that are not along an axis, and infinity for
//! roughness 0 at the mirror's peak. On lavapipe, whose min and max drop NaN, also finite values that
//! are wrong for L = N. Counts differ from driver to driver: they are recorded, not asserted.

use glam::{Quat, Vec3};
use umber::reference::shade::{Lighting, Terms};
use umber::render::Variant;

use crate::harness::{Gpu, whole, with_gpu};
use crate::patches::{DARK, Patch, Patches, material, towards};
use crate::records::record;
use crate::tolerances;

/// The file that the counts go to.
const WHAT: &str = "slides_breakdown";

/// Directions on a spiral over the sphere (Swinbank and Purser 2006), none along an axis.
fn directions(count: usize) -> impl Iterator<Item = Vec3> {
    let golden = std::f32::consts::PI * (3.0 - 5.0_f32.sqrt());
    (0..count).map(move |i| {
        let y = 1.0 - (2.0 * i as f32 + 1.0) / count as f32;
        let (sin, cos) = (golden * i as f32).sin_cos();
        let r = (1.0 - y * y).sqrt();
        Vec3::new(r * cos, y, r * sin).normalize()
    })
}

fn one_patch(to_eye: Vec3, to_light: Vec3, normal: Vec3, roughness: f32) -> Patches {
    Patches {
        to_eye,
        lights: vec![towards(to_light, [1.0; 3])],
        ambient: DARK,
        patches: vec![Patch {
            normal,
            material: material([0.8; 3], [0.04; 3], roughness),
        }],
    }
}

fn red(gpu: &Gpu, patches: &Patches, lighting: Lighting, terms: Terms) -> f32 {
    patches.rendered(gpu, Variant { lighting, terms })[0][0]
}

const DIFFUSE: Terms = Terms {
    diffuse: true,
    ..Terms::NONE
};
const SPECULAR: Terms = Terms {
    specular: true,
    ..Terms::NONE
};

#[test]
fn light_eye_and_normal_in_one_line_make_a_nan() {
    with_gpu(|gpu| {
        let (mut nan, mut count) = (0, 0);
        for direction in directions(200) {
            let patches = one_patch(direction, direction, direction, 0.5);
            nan += usize::from(red(gpu, &patches, Lighting::Slides, DIFFUSE).is_nan());
            count += 1;
            let corrected = patches.rendered(gpu, whole(Lighting::CORRECTED))[0];
            assert!(
                corrected.iter().all(|value| value.is_finite()),
                "{direction:?}"
            );
        }
        let counts = [("nan", nan), ("of", count)];
        record(gpu, WHAT, "light, eye and normal in one line", &counts);
        assert!(
            nan > 0,
            "the listing's acos and normalize are undefined here"
        );
    });
}

#[test]
fn roughness_0_at_the_mirrors_peak_makes_an_infinity() {
    with_gpu(|gpu| {
        let (mut infinite, mut nan, mut count) = (0, 0, 0);
        for normal in directions(200) {
            let tilt = Quat::from_axis_angle(normal.any_orthonormal_vector(), 0.5);
            let (to_eye, to_light) = (tilt * normal, tilt.inverse() * normal);
            let patches = one_patch(to_eye, to_light, normal, 0.0);
            let value = red(gpu, &patches, Lighting::Slides, SPECULAR);
            infinite += usize::from(value.is_infinite());
            nan += usize::from(value.is_nan());
            count += 1;
            let corrected = patches.rendered(gpu, whole(Lighting::CORRECTED))[0];
            assert!(
                corrected.iter().all(|value| value.is_finite()),
                "{normal:?}"
            );
        }
        let counts = [("infinite", infinite), ("nan", nan), ("of", count)];
        record(gpu, WHAT, "roughness 0 at the mirror's peak", &counts);
        assert!(infinite > 0, "the listing divides by R2 = 0 here");
    });
}

#[test]
fn light_along_the_normal_is_wrong_and_finite_where_nan_is_dropped() {
    with_gpu(|gpu| {
        let (mut wrong, mut undefined, mut count) = (0, 0, 0);
        for normal in directions(40) {
            for degrees in [60.0_f32, 70.0, 80.0, 89.0] {
                let axis = normal.any_orthonormal_vector();
                let to_eye = Quat::from_axis_angle(axis, degrees.to_radians()) * normal;
                let patches = one_patch(to_eye, normal, normal, 0.5);
                let value = f64::from(red(gpu, &patches, Lighting::Slides, DIFFUSE));
                // The limit as the light comes to the normal: tan(beta) goes to 0, A is left.
                let truth = 0.8 / std::f64::consts::PI * (1.0 - 0.5 * 0.25 / (0.25 + 0.33));
                wrong += usize::from(value.is_finite() && (value / truth - 1.0).abs() > 0.01);
                undefined += usize::from(!value.is_finite());
                count += 1;
                let corrected = Variant {
                    lighting: Lighting::CORRECTED,
                    terms: DIFFUSE,
                };
                let got = f64::from(patches.rendered(gpu, corrected)[0][0]);
                let want = patches.predicted(0, corrected)[0];
                let right = tolerances::CORRECTED_PIXEL.holds(got, want);
                assert!(right, "corrected, {degrees} degrees: {got} for {want}");
            }
        }
        let counts = [
            ("finite_and_wrong_by_over_1_percent", wrong),
            ("undefined", undefined),
            ("of", count),
        ];
        record(gpu, WHAT, "light along the normal", &counts);
        if gpu.is_lavapipe() {
            assert!(wrong > 0, "a dropped NaN hides here as a plausible number");
        }
    });
}
