//! From where, and in which light, is a scene shown that does not say so itself?
//!
//! The camera stands in front, a little to the right and above, far enough that the sphere around
//! all models fits the picture's height and width. Three directional lights in the manner of a portrait
//! studio (key, fill, rim) and a soft ambient are made for the default exposure, so that a white
//! surface that faces the key light comes out just below white.

use glam::{DMat3, DVec3};
use indexmap::IndexMap;

use super::camera::{self, DEFAULT_EV100, DEFAULT_FOV_DEGREES};
use super::checks::{COORDINATE, FARTHEST};
use super::description::{
    AmbientText, CameraText, Description, LightKindText, LightText, ProjectionText, Triple,
};
use super::mesh::Bounds;

/// Free space around the models, as a factor on the distance.
const MARGIN: f64 = 1.05;
/// From the models to the eye: a three-quarter view, 17 degrees above the ground.
const TO_EYE: DVec3 = DVec3::new(0.5, 0.35, 1.0);

/// The illuminance that shows a white diffuse surface facing it as 1.0 at the default exposure, lx:
/// its luminance E / pi equals 1.2 * 2^EV100.
const WHITE_LUX: f64 = std::f64::consts::PI * 1.2 * (1_u32 << DEFAULT_EV100 as u32) as f64;

/// The key light, and the others by their usual ratios to it: 1:4 for the fill, 1:2 for the rim.
/// Key, fill and ambient together stay below white for an albedo of 0.8.
const KEY: f64 = 0.75;
const FILL: f64 = KEY / 4.0;
const RIM: f64 = KEY / 2.0;
/// Radiance from above, as a part of white; half of it comes from below, as off a grey floor.
const SKY: f64 = 0.12;

/// The size of the lights as seen from the models, degrees: a softbox of half a metre at 6 m.
const SOFTBOX_DEGREES: f64 = 5.0;

/// Camera for `bounds` in a picture `aspect` times as wide as high, and lights and ambient if `lit`
/// is false. `camera` is what the scene states, which wins; an error if what it leaves open cannot
/// be chosen.
pub(super) fn defaults(
    bounds: Bounds,
    camera: Option<&CameraText>,
    lit: bool,
    aspect: f64,
) -> Result<Description, String> {
    let framed = frame(bounds, aspect);
    check(bounds, camera, &framed)?;
    let mut light = IndexMap::new();
    let mut ambient = AmbientText::default();
    if !lit {
        let (eye, target) = (
            camera.and_then(|c| c.position).or(framed.position),
            camera.and_then(|c| c.target).or(framed.target),
        );
        light = rig(DVec3::from_array(eye.unwrap_or_default())
            - DVec3::from_array(target.unwrap_or_default()));
        let white = WHITE_LUX / std::f64::consts::PI;
        ambient.sky = Some(Triple([SKY * white; 3]));
        ambient.ground = Some(Triple([SKY * white / 2.0; 3]));
    }
    Ok(Description {
        camera: Some(framed),
        ambient: Some(ambient),
        light,
        ..Description::default()
    })
}

fn frame(bounds: Bounds, aspect: f64) -> CameraText {
    let center = bounds.center().as_dvec3();
    let radius = f64::from(bounds.radius());
    let upright = (DEFAULT_FOV_DEGREES / 2.0).to_radians();
    // The smaller of the angles to the picture's upper edge and to its right one.
    let half_angle = upright.min((upright.tan() * aspect).atan());
    let distance = MARGIN * radius / half_angle.sin();
    CameraText {
        position: Some((center + TO_EYE.normalize() * distance).to_array()),
        target: Some(center.to_array()),
        up: Some([0.0, 1.0, 0.0]),
        projection: Some(ProjectionText::Perspective),
        vertical_fov_degrees: Some(DEFAULT_FOV_DEGREES),
        height: Some(2.0 * MARGIN * radius / aspect.min(1.0)),
        exposure_ev100: Some(DEFAULT_EV100),
    }
}

/// Refuses models so large, small or far away that no camera can be chosen where `own` leaves it
/// open: messages about `camera` would blame keys that nobody wrote.
fn check(bounds: Bounds, own: Option<&CameraText>, framed: &CameraText) -> Result<(), String> {
    let remedy = "scale them, or state camera.position, camera.target and camera.height";
    let size = 2.0 * f64::from(bounds.radius());
    let open = |key: fn(&CameraText) -> bool| !own.is_some_and(key);
    let (eye, target) = (open(|c| c.position.is_some()), open(|c| c.target.is_some()));
    let is_flat = |c: &CameraText| matches!(c.projection, Some(ProjectionText::Orthographic));
    let height = own.is_some_and(is_flat) && open(|c| c.height.is_some());
    let beyond = |point: Option<[f64; 3]>| {
        let mut values = point.into_iter().flatten();
        values.any(|x| !COORDINATE.contains(x))
    };
    if (eye && beyond(framed.position))
        || (target && beyond(framed.target))
        || (height && framed.height.is_some_and(|height| height > FARTHEST))
    {
        return Err(format!(
            "the models are too large or too far away to be framed ({size:.1e} m across): {remedy}"
        ));
    }
    let at = |point: Option<[f64; 3]>| DVec3::from(point.unwrap_or_default());
    let blurred = || camera::direction(at(framed.position), at(framed.target)).is_err();
    if (eye || height) && (size < 2.0 * camera::SMALLEST) || eye && target && blurred() {
        return Err(format!(
            "the models are too small, or too small for their distance from the origin, to be framed \
             ({size:.1e} m across): {remedy}"
        ));
    }
    Ok(())
}

/// Lights around the direction to the eye: the key from its left and above, the fill from its
/// right, the rim from behind and above.
fn rig(to_eye: DVec3) -> IndexMap<String, LightText> {
    let back = to_eye.normalize_or(DVec3::Z);
    let right = DVec3::Y.cross(back).normalize_or(DVec3::X);
    let view = DMat3::from_cols(right, back.cross(right), back);
    let lamp = |from: DVec3, share: f64, color: [f64; 3]| LightText {
        kind: Some(LightKindText::Directional),
        direction: Some((-(view * from).normalize()).to_array()),
        illuminance: Some(share * WHITE_LUX),
        color: Some(Triple(color)),
        angular_diameter_degrees: Some(SOFTBOX_DEGREES),
        ..LightText::default()
    };
    // Chosen by eye: a warm key, a cool fill, a white rim.
    IndexMap::from([
        (
            "key".to_owned(),
            lamp(DVec3::new(-0.7, 0.8, 1.0), KEY, [1.0, 0.97, 0.92]),
        ),
        (
            "fill".to_owned(),
            lamp(DVec3::new(1.0, 0.2, 0.8), FILL, [0.92, 0.96, 1.0]),
        ),
        (
            "rim".to_owned(),
            lamp(DVec3::new(0.5, 0.7, -1.0), RIM, [1.0; 3]),
        ),
    ])
}
