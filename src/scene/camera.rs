//! From where does the picture look, and how bright does it become?

use glam::{DVec3, Vec3};

use super::checks::{COORDINATE, FARTHEST, Range};
use super::description::{CameraText, ProjectionText};
use super::error::Error;
use super::layers::Layers;

/// The eye. `target` is at least 1e-6 m from `position`, and `up` is not parallel to the view.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Where the eye is, m.
    pub position: Vec3,
    /// The point in the middle of the picture, m.
    pub target: Vec3,
    /// The direction that points up in the picture; any length but zero.
    pub up: Vec3,
    pub projection: Projection,
    /// Exposure value at ISO 100: luminance 1.2 * 2^EV cd/m^2 becomes 1.0 (Lagarde and de Rousiers
    /// 2014, section 5.1).
    pub exposure_ev100: f32,
}

/// How space becomes a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// The angle between the picture's lower and upper edge, degrees, in [0.001, 180).
    Perspective { vertical_fov_degrees: f32 },
    /// The picture's height in the scene, m, at least 1e-6.
    Orthographic { height: f32 },
}

/// The exposure of a scene that states none: a bright interior. The default lights are made for it.
pub(super) const DEFAULT_EV100: f64 = 10.0;
/// The angle of view of a scene that states none: close to that of the eye's attention, and of a
/// 38 mm lens on 36 mm x 24 mm film.
pub(super) const DEFAULT_FOV_DEGREES: f64 = 35.0;

/// The smallest sine of the angle between `up` and the view: below it f32 rounding (6e-8) would
/// tilt the picture by more than a thousandth.
const SMALLEST_SINE: f64 = 1e-4;
/// The shortest distance from eye to target, and the smallest height of an orthographic picture, m:
/// twice the wavelength of light, below which there is no picture. Their reciprocals, which a
/// projection holds, stay far below the largest f32.
pub(super) const SMALLEST: f64 = 1e-6;
/// How far rounding to f32 may move the target, as a share of its distance: a pixel of a usual frame.
const LARGEST_SHIFT: f64 = 1e-3;
/// Degrees. The lower end, 3.6 seconds of arc, is a planet in a telescope.
const FOV: Range = Range::below(1e-3, 180.0);
const HEIGHT: Range = Range::closed(SMALLEST, FARTHEST);
/// Twice the exposures that any film or sensor meets, either way.
const EXPOSURE: Range = Range::closed(-32.0, 32.0);

/// Checks a merged `[camera]`, in which every key but `height` has a value.
pub(super) fn build(text: &CameraText, layers: &Layers) -> Result<Camera, Error> {
    let position = point(layers, "position", text.position)?;
    let target = point(layers, "target", text.target)?;
    let up = point(layers, "up", text.up)?;
    let exact = [text.position, text.target].map(|point| DVec3::from(point.unwrap_or_default()));
    if let Err(message) = direction(exact[0], exact[1]) {
        return Err(layers.error(&["camera", "target"], message));
    }
    let view = (target - position).as_dvec3();
    let across = view.normalize().cross(up.as_dvec3().normalize_or_zero());
    if across.length() < SMALLEST_SINE {
        return Err(layers.error(
            &["camera", "up"],
            "camera.up is zero or parallel to the view: choose another direction",
        ));
    }
    let exposure = text.exposure_ev100.unwrap_or(DEFAULT_EV100);
    Ok(Camera {
        position,
        target,
        up,
        projection: projection(text, layers)?,
        exposure_ev100: layers.number(&["camera", "exposure_ev100"], exposure, EXPOSURE)?,
    })
}

/// Whether f32 can tell where `target` lies as seen from `position`, m.
pub(super) fn direction(position: DVec3, target: DVec3) -> Result<(), String> {
    let exact = target - position;
    let rounded = (target.as_vec3() - position.as_vec3()).as_dvec3();
    if exact == DVec3::ZERO {
        return Err(
            "camera.target equals camera.position: there is no direction to look in".to_owned(),
        );
    }
    if exact.length() < SMALLEST || rounded == DVec3::ZERO {
        return Err(format!(
            "camera.target is {:.1e} m from camera.position: must be at least {SMALLEST:e} m, and more \
             the farther both are from the origin",
            exact.length()
        ));
    }
    if (rounded - exact).length() > LARGEST_SHIFT * exact.length() {
        return Err(format!(
            "camera.target is {:.1e} m from camera.position, too near for their distance from the \
             origin: f32 cannot tell the direction; move the scene to the origin",
            exact.length()
        ));
    }
    Ok(())
}

fn projection(text: &CameraText, layers: &Layers) -> Result<Projection, Error> {
    let fov = text.vertical_fov_degrees.unwrap_or(DEFAULT_FOV_DEGREES);
    let vertical_fov_degrees = layers.number(&["camera", "vertical_fov_degrees"], fov, FOV)?;
    match text.projection.unwrap_or(ProjectionText::Perspective) {
        ProjectionText::Perspective => Ok(Projection::Perspective {
            vertical_fov_degrees,
        }),
        ProjectionText::Orthographic => {
            let path = ["camera", "height"];
            let height = layers.required(&path, text.height)?;
            let height = layers.number(&path, height, HEIGHT)?;
            Ok(Projection::Orthographic { height })
        }
    }
}

fn point(layers: &Layers, key: &str, value: Option<[f64; 3]>) -> Result<Vec3, Error> {
    let path = ["camera", key];
    let value = layers.required(&path, value)?;
    Ok(Vec3::from_array(layers.triple(&path, value, COORDINATE)?))
}
