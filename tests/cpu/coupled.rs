//! Do base and interface together give back no more light than they get?

use std::f64::consts::PI;

use glam::DVec3;
use umber::math::frame::spherical;
use umber::math::quadrature::{GaussLegendre, half_vectors, hemisphere};
use umber::reference::beckmann::under_disc;
use umber::reference::coupled::Coupled;
use umber::reference::hemisphere::Surroundings;
use umber::reference::oren_nayar::conserving_lobe;
use umber::reference::{cook_torrance, schlick};

use crate::samples::{assert_close, pairs, view_angles};
use crate::tolerances::{QUADRATURE_SMOOTH, SAME_FORMULA, SAME_FORMULA_PEAKED};

const N: DVec3 = DVec3::Z;

/// What one direction of view gives back, split so that any f0 can be put together from it.
///
/// Schlick's F is f0 + (f90 - f0) q with q = (1 - cos)^5, so each lobe is linear in f0 and f90.
struct Albedo {
    /// q towards the eye.
    q: f64,
    /// The base without interface, and the same weighted with q of the light.
    base: f64,
    base_q: f64,
    /// The interface with F = 1, and with F = q of the half vector.
    mirror: f64,
    mirror_q: f64,
}

impl Albedo {
    fn seen(theta: f64, roughness: f64) -> Albedo {
        let rule = GaussLegendre::new(12);
        let e = spherical(theta, 0.4);
        let m = under_disc(roughness, 0.0);
        let base = |f: &dyn Fn(f64) -> f64| {
            hemisphere(&rule, N, e, |l| {
                conserving_lobe(N, l, e, roughness) * f(N.dot(l))
            }) / PI
        };
        let mirror = |f0| {
            half_vectors(&rule, N, e, m, |l| {
                cook_torrance::lobe(N, l, e, m, DVec3::splat(f0)).x
            })
        };
        let whole = mirror(1.0);
        Albedo {
            q: (1.0 - e.z).powi(5),
            base: base(&|_| 1.0),
            base_q: base(&|cos| (1.0 - cos).powi(5)),
            mirror: whole,
            mirror_q: (mirror(0.02) - 0.02 * whole) / 0.98,
        }
    }

    /// For albedo 1 and one channel of f0, the others up to `largest`.
    fn total(&self, f0: f64, largest: f64) -> f64 {
        let rise = schlick::f90(DVec3::splat(largest)) - f0;
        let leaving = 1.0 - f0 - rise * self.q;
        let diffuse = leaving * ((1.0 - f0) * self.base - rise * self.base_q);
        diffuse + f0 * self.mirror + rise * self.mirror_q
    }
}

#[test]
fn no_roughness_f0_or_angle_makes_light() {
    for step in 0..=20 {
        let roughness = f64::from(step) / 20.0;
        for theta in view_angles() {
            let albedo = Albedo::seen(theta, roughness);
            for k in 0..=60 {
                let largest = (f64::from(k) / 60.0).powi(2);
                for share in [0.0, 0.1, 0.25, 0.5, 0.75, 1.0] {
                    let total = albedo.total(share * largest, largest);
                    assert!(
                        total <= 1.0 + QUADRATURE_SMOOTH,
                        "roughness {roughness}, f0 {} of {largest}, {theta} rad: {total}",
                        share * largest
                    );
                }
            }
        }
    }
}

/// The split above is the model's own sum.
#[test]
fn the_split_is_the_model() {
    let (theta, roughness, f0) = (1.1, 0.4, 0.05);
    let surface = Coupled::corrected(DVec3::ONE, DVec3::splat(f0), roughness);
    let e = spherical(theta, 0.4);
    let rule = GaussLegendre::new(12);
    let diffuse = hemisphere(&rule, N, e, |l| surface.diffuse(N, l, e).x);
    let specular = half_vectors(&rule, N, e, roughness, |l| surface.specular(N, l, e, 0.0).x);
    assert_close(
        diffuse + specular,
        Albedo::seen(theta, roughness).total(f0, f0),
        SAME_FORMULA,
        "sum",
    );
}

#[test]
fn light_and_eye_may_change_places() {
    let surface = Coupled::corrected(DVec3::new(0.2, 0.5, 1.0), DVec3::new(0.03, 0.04, 0.1), 0.6);
    for (l, e) in pairs() {
        let there = (surface.diffuse(N, l, e) + surface.specular(N, l, e, 0.0)) * N.dot(e);
        let back = (surface.diffuse(N, e, l) + surface.specular(N, e, l, 0.0)) * N.dot(l);
        for channel in 0..3 {
            assert_close(
                back[channel],
                there[channel],
                SAME_FORMULA_PEAKED,
                "reciprocity",
            );
        }
    }
}

#[test]
fn without_interface_there_is_only_the_base_and_behind_a_mirror_none() {
    let bare = Coupled::corrected(DVec3::ONE, DVec3::ZERO, 0.5);
    let mirror = Coupled::corrected(DVec3::ONE, DVec3::ONE, 0.5);
    for (l, e) in pairs() {
        assert_eq!(bare.specular(N, l, e, 0.0), DVec3::ZERO);
        let base = conserving_lobe(N, l, e, 0.5) / PI;
        assert_close(bare.diffuse(N, l, e).x, base, SAME_FORMULA, "bare base");
        assert_eq!(mirror.diffuse(N, l, e), DVec3::ZERO);
    }
}

#[test]
fn even_surroundings_are_not_outshone() {
    let around = Surroundings {
        sky: DVec3::ONE,
        ground: DVec3::ONE,
    };
    for f0 in [0.0, 0.001, 0.04, 0.5, 1.0] {
        for roughness in [0.0, 0.3, 1.0] {
            let surface = Coupled::corrected(DVec3::ONE, DVec3::splat(f0), roughness);
            for theta in view_angles() {
                let e = spherical(theta, 0.0);
                let sum = surface.ambient_diffuse(N, e, &around)
                    + surface.ambient_specular(N, e, &around);
                assert!(
                    sum.max_element() <= 1.0 + SAME_FORMULA,
                    "f0 {f0}, {theta}: {sum}"
                );
            }
        }
    }
}

#[test]
fn a_clear_base_hides_only_what_the_interface_reflects() {
    let glass = Coupled::corrected(DVec3::ZERO, DVec3::splat(0.04), 0.0);
    assert_close(glass.alpha(N, N, 0.0), 0.04, SAME_FORMULA, "from above");
    assert_close(
        glass.alpha(N, DVec3::X, 0.0),
        1.0,
        SAME_FORMULA,
        "at grazing",
    );
    assert_eq!(glass.alpha(N, N, 1.0), 1.0);
}
