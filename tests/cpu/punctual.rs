//! Does a lamp light as far and as wide as it should?

use glam::DVec3;
use umber::reference::punctual::{DISTANCE_MAX, Light, Place, cone};

use crate::samples::assert_close;
use crate::tolerances::{SAME_FORMULA, SAME_FORMULA_PEAKED};

fn bulb(position: DVec3, radius: f64) -> Light {
    Light {
        place: Place::At(position),
        intensity: DVec3::new(100.0, 80.0, 60.0),
        radius,
        axis: DVec3::NEG_Y,
        cone_scale: 0.0,
        cone_offset: 1.0,
    }
}

#[test]
fn a_bulb_falls_off_with_the_square_of_distance() {
    for distance in [0.5, 1.0, 2.0, 100.0] {
        let light = bulb(DVec3::new(0.0, distance, 0.0), 0.01);
        let incident = light.at(DVec3::ZERO).expect("the bulb shines all around");
        assert_eq!(incident.l, DVec3::Y);
        assert_close(
            incident.illuminance.x,
            100.0 / (distance * distance),
            SAME_FORMULA,
            "falloff",
        );
        assert_close(
            incident.angular_radius,
            0.01 / distance,
            SAME_FORMULA,
            "angular radius",
        );
    }
}

#[test]
fn inside_a_lamp_light_stops_growing() {
    let light = bulb(DVec3::new(0.0, 0.01, 0.0), 0.1);
    let incident = light.at(DVec3::ZERO).expect("the bulb shines all around");
    assert_close(
        incident.illuminance.x,
        100.0 / (0.1 * 0.1),
        SAME_FORMULA,
        "at the bulb's surface",
    );
    assert_eq!(incident.angular_radius, 1.0);
}

#[test]
fn a_lamp_on_the_point_and_one_out_of_reach_give_nothing() {
    assert!(bulb(DVec3::ONE, 0.1).at(DVec3::ONE).is_none());
    assert!(
        bulb(DVec3::X * 2.0 * DISTANCE_MAX, 0.1)
            .at(DVec3::ZERO)
            .is_none()
    );
}

#[test]
fn a_directional_lamp_lights_every_point_alike() {
    let light = Light {
        place: Place::Towards(DVec3::Z),
        radius: 0.00465,
        ..bulb(DVec3::ZERO, 0.0)
    };
    for point in [DVec3::ZERO, DVec3::new(1.0e6, -3.0, 2.0), DVec3::Z] {
        let incident = light
            .at(point)
            .expect("a directional lamp reaches every point");
        assert_eq!(
            (incident.l, incident.illuminance),
            (DVec3::Z, light.intensity)
        );
        assert_close(
            incident.angular_radius,
            0.00465,
            SAME_FORMULA,
            "angular radius",
        );
    }
}

#[test]
fn a_spot_is_full_within_its_inner_cone_and_dark_beyond_its_outer() {
    let (inner, outer) = (0.3, 0.5);
    let (cone_scale, cone_offset) = cone(inner, outer);
    let light = Light {
        cone_scale,
        cone_offset,
        ..bulb(DVec3::Y, 1.0e-3)
    };
    let lit = |angle: f64| {
        light
            .at(DVec3::new(angle.tan(), 0.0, 0.0))
            .map(|incident| incident.illuminance.x)
    };
    let full = |angle: f64| 100.0 * angle.cos().powi(2);
    for angle in [0.0, 0.1, 0.299] {
        assert_close(
            lit(angle).expect("within the inner cone"),
            full(angle),
            SAME_FORMULA,
            "full",
        );
    }
    for angle in [0.501, 1.0, 1.5] {
        assert_eq!(lit(angle), None, "{angle} is beyond the outer cone");
    }
    let halfway = f64::acos(0.5 * (inner.cos() + outer.cos()));
    assert_close(
        lit(halfway).expect("within the outer cone"),
        0.25 * full(halfway),
        SAME_FORMULA_PEAKED,
        "halfway",
    );
}
