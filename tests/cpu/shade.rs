//! Does a predicted pixel put the terms together as stated?

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;
use umber::math::frame::spherical;
use umber::reference::hemisphere::Surroundings;
use umber::reference::punctual::{Light, Place};
use umber::reference::shade::{Lighting, Surface, Terms, shade};

use crate::samples::{assert_close, pairs};
use crate::tolerances::SAME_FORMULA;

const AROUND: Surroundings = Surroundings {
    sky: DVec3::new(0.5, 0.6, 0.8),
    ground: DVec3::new(0.2, 0.15, 0.1),
};

fn plastic() -> Surface {
    Surface {
        position: DVec3::new(0.1, 0.2, 0.3),
        normal: DVec3::Z,
        to_eye: spherical(0.7, 0.1) * 3.0,
        albedo: DVec3::new(0.6, 0.3, 0.1),
        opacity: 1.0,
        f0: DVec3::splat(0.04),
        metal: None,
        roughness: 0.4,
        emission: DVec3::ZERO,
        shininess: 20.0,
    }
}

fn sun(direction: DVec3) -> Light {
    Light {
        place: Place::Towards(direction),
        intensity: DVec3::new(3.0, 2.9, 2.7),
        radius: 0.00465,
        axis: DVec3::NEG_Y,
        cone_scale: 0.0,
        cone_offset: 1.0,
    }
}

fn rgb(surface: &Surface, lights: &[Light], lighting: Lighting, terms: Terms) -> DVec3 {
    DVec3::from_array(shade(surface, lights, &AROUND, lighting, terms).0)
}

#[test]
fn terms_and_lamps_add_up() {
    let lights = [sun(spherical(0.4, 2.0)), sun(spherical(1.2, 4.0))];
    let surface = Surface {
        emission: DVec3::splat(0.25),
        ..plastic()
    };
    for lighting in Lighting::ALL {
        let only = |ambient, diffuse, specular| {
            rgb(
                &surface,
                &lights,
                lighting,
                Terms {
                    ambient,
                    diffuse,
                    specular,
                },
            ) - surface.emission
        };
        let sum = only(true, false, false) + only(false, true, false) + only(false, false, true);
        let all = rgb(&surface, &lights, lighting, Terms::ALL);
        assert!(
            (sum + surface.emission - all).length() <= SAME_FORMULA,
            "{lighting:?}"
        );

        let lamp = |i: usize| {
            rgb(
                &plastic(),
                &lights[i..=i],
                lighting,
                Terms {
                    ambient: false,
                    ..Terms::ALL
                },
            )
        };
        let both = rgb(
            &plastic(),
            &lights,
            lighting,
            Terms {
                ambient: false,
                ..Terms::ALL
            },
        );
        assert!(
            (lamp(0) + lamp(1) - both).length() <= SAME_FORMULA,
            "{lighting:?}"
        );
    }
}

#[test]
fn emission_is_no_term() {
    let lamp = Surface {
        emission: DVec3::new(1.0, 2.0, 3.0),
        opacity: 0.5,
        ..plastic()
    };
    for lighting in Lighting::ALL {
        assert_eq!(rgb(&lamp, &[], lighting, Terms::NONE), lamp.emission);
    }
}

/// Where the slides' Oren-Nayar makes no light (sigma >= 0.3262) and there is no interface, only the way of
/// writing it differs.
#[test]
fn bare_and_rough_the_slides_diffuse_is_the_corrected_one() {
    let terms = Terms {
        diffuse: true,
        ..Terms::NONE
    };
    for (l, e) in pairs() {
        for roughness in [0.3262, 0.5, 1.0] {
            let surface = Surface {
                to_eye: e,
                f0: DVec3::ZERO,
                roughness,
                ..plastic()
            };
            let slides = rgb(&surface, &[sun(l)], Lighting::Slides, terms);
            let corrected = rgb(&surface, &[sun(l)], Lighting::CORRECTED, terms);
            for channel in 0..3 {
                assert_close(slides[channel], corrected[channel], SAME_FORMULA, "diffuse");
            }
        }
    }
}

#[test]
fn metals_are_not_black_in_the_classic_surroundings() {
    let gold = Surface {
        albedo: DVec3::ZERO,
        f0: DVec3::new(1.0, 0.78, 0.34),
        ..plastic()
    };
    for lighting in Lighting::ALL {
        let ambient = rgb(
            &gold,
            &[],
            lighting,
            Terms {
                ambient: true,
                ..Terms::NONE
            },
        );
        assert!(ambient.min_element() > 0.0, "{lighting:?}");
        assert!(
            ambient.x / ambient.z > AROUND.sky.x / AROUND.sky.z,
            "{lighting:?}: no colour of its own"
        );
    }
}

#[test]
fn opacity_dims_the_base_and_not_the_interface() {
    let light = [sun(spherical(0.7, 0.1 + PI))];
    let clear = Surface {
        opacity: 0.0,
        ..plastic()
    };
    for lighting in Lighting::ALL {
        assert_eq!(
            rgb(
                &clear,
                &light,
                lighting,
                Terms {
                    diffuse: true,
                    ..Terms::NONE
                }
            ),
            DVec3::ZERO
        );
        let specular = Terms {
            specular: true,
            ..Terms::NONE
        };
        assert_eq!(
            rgb(&clear, &light, lighting, specular),
            rgb(&plastic(), &light, lighting, specular)
        );
        let (_, opaque) = shade(&plastic(), &light, &AROUND, lighting, Terms::ALL);
        assert_close(opaque, 1.0, SAME_FORMULA, "alpha of an opaque base");
    }
    let (_, alpha) = shade(&clear, &light, &AROUND, Lighting::CORRECTED, Terms::ALL);
    assert!(alpha > 0.04 && alpha < 0.05, "{alpha}");
    assert_eq!(
        shade(&clear, &light, &AROUND, Lighting::Slides, Terms::ALL).1,
        0.0
    );
}

/// Every pair of a few directions, also zero, opposite and below the surface.
#[test]
fn corrected_and_phong_are_finite_and_not_negative_everywhere() {
    let edges = [
        DVec3::ZERO,
        DVec3::Z,
        DVec3::NEG_Z,
        DVec3::X,
        DVec3::NEG_X,
        spherical(0.5, 1.0),
        -spherical(0.5, 1.0),
        spherical(FRAC_PI_2 - 1.0e-7, 2.0),
        DVec3::new(1.0, 0.0, 1.0e-12),
    ];
    for normal in edges {
        for to_eye in edges {
            for l in edges {
                for (roughness, f0) in [
                    (0.0, 0.0),
                    (0.0, 1.0),
                    (0.5, 0.04),
                    (1.0, 1.0),
                    (1.0e-6, 0.04),
                ] {
                    let f0 = DVec3::splat(f0);
                    let surface = Surface {
                        normal,
                        to_eye,
                        roughness,
                        f0,
                        shininess: 0.0,
                        ..plastic()
                    };
                    for lighting in [Lighting::Phong, Lighting::CORRECTED] {
                        let pixel = rgb(&surface, &[sun(l)], lighting, Terms::ALL);
                        let good = pixel.is_finite() && pixel.min_element() >= 0.0;
                        assert!(
                            good,
                            "{lighting:?} n {normal} e {to_eye} l {l} roughness {roughness}: {pixel}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn a_normal_without_direction_faces_the_eye() {
    let light = [sun(spherical(0.9, 1.0))];
    let degenerate = Surface {
        normal: DVec3::ZERO,
        ..plastic()
    };
    let facing = Surface {
        normal: plastic().to_eye,
        ..plastic()
    };
    for lighting in [Lighting::Phong, Lighting::CORRECTED] {
        let expected = rgb(&facing, &light, lighting, Terms::ALL);
        assert_eq!(rgb(&degenerate, &light, lighting, Terms::ALL), expected);
    }
}
