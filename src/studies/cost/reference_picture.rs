//! How does a scene look where only rounding to a screen is left to blame?
//!
//! The frame's own stages write what each pixel is shaded from, at one sample; f64 and the highest tiers shade it. So a
//! frame differs from this picture by its shading alone.

use glam::DVec3;
use rayon::prelude::*;

use crate::reference::hemisphere::Surroundings;
use crate::reference::ladders::{Fresnel, Mix};
use crate::reference::metal::Metal;
use crate::reference::punctual::{self, Place};
use crate::reference::shade::{Lighting, Surface, Terms, shade};
use crate::render::{Frame, Inspection, Picture, RenderError, Settings};
use crate::scene::{Light, LightKind, Material, Scene};

/// Clear stuff reflects at most this at normal incidence: diamond has 0.17. What reflects more and names no metal is known
/// by f0 alone.
const MOST_OF_CLEAR: f64 = 0.2;

/// The picture, of a scene in which nothing lets light through; `first` is a frame of it that was drawn with these settings, one sample a
/// pixel and the default model, whose f0 is the spectral tier's.
///
/// # Errors
/// The scene is beyond the device, there is no memory, or the driver fails.
pub fn reference_picture(
    first: &Frame,
    scene: &Scene,
    settings: &Settings,
) -> Result<Picture, RenderError> {
    let seen = Seen::new(first, scene, settings)?;
    let lamps: Vec<_> = scene.lights.iter().map(light).collect();
    let around = Surroundings {
        sky: wide(scene.ambient.sky),
        ground: wide(scene.ambient.ground),
    };
    let (width, height) = (settings.width, settings.height);
    let row = |y: u32| -> Vec<[f32; 4]> {
        let pixel = |x| seen.shaded(scene, &lamps, &around, x, y);
        (0..width).map(pixel).collect()
    };
    Ok(Picture {
        width,
        height,
        pixels: rows(height, &row),
    })
}

/// All rows, top to bottom, on all processors.
fn rows(height: u32, row: &(impl Fn(u32) -> Vec<[f32; 4]> + Sync)) -> Vec<[f32; 4]> {
    let rows: Vec<_> = (0..height).into_par_iter().map(row).collect();
    rows.concat()
}

/// What each pixel is shaded from.
struct Seen {
    normal_and_material: Picture,
    eye_and_roughness: Picture,
    position_and_opening: Picture,
    albedo: Picture,
    f0: Picture,
    emission: Picture,
    /// Lamp by lamp; none for one that throws none.
    shadows: Vec<Option<Picture>>,
}

impl Seen {
    fn new(first: &Frame, scene: &Scene, settings: &Settings) -> Result<Self, RenderError> {
        let at = |inspection| -> Result<Picture, RenderError> {
            let mut frame = Frame::after(first, settings, inspection)?;
            frame.draw()?;
            Ok(frame.picture()?)
        };
        Ok(Self {
            normal_and_material: at(Inspection::NormalAndMaterial)?,
            eye_and_roughness: at(Inspection::EyeAndRoughness)?,
            position_and_opening: at(Inspection::PositionAndOpening)?,
            albedo: at(Inspection::Albedo)?,
            f0: at(Inspection::F0)?,
            emission: at(Inspection::Emission)?,
            shadows: (0..)
                .zip(&scene.lights)
                .map(|(lamp, light)| {
                    let shadow = light.shadow.then(|| at(Inspection::Shadow(lamp)));
                    shadow.transpose()
                })
                .collect::<Result<_, _>>()?,
        })
    }

    fn shaded(
        &self,
        scene: &Scene,
        lamps: &[punctual::Light],
        around: &Surroundings,
        x: u32,
        y: u32,
    ) -> [f32; 4] {
        let (normal, number) = split(self.normal_and_material.at(x, y));
        if normal == DVec3::ZERO {
            return [0.0; 4];
        }
        let (to_eye, roughness) = split(self.eye_and_roughness.at(x, y));
        let (position, open) = split(self.position_and_opening.at(x, y));
        let (f0, _) = split(self.f0.at(x, y));
        let (metal, fresnel) = interface(&scene.materials[number as usize], f0);
        let surface = Surface {
            position,
            normal,
            to_eye,
            albedo: split(self.albedo.at(x, y)).0,
            opacity: 1.0,
            f0: f0.clamp(DVec3::ZERO, DVec3::ONE),
            metal,
            roughness,
            emission: DVec3::ZERO,
            shininess: 0.0,
        };
        let lighting = Lighting::Mixed(Mix {
            fresnel,
            ..Mix::BEST
        });
        let lit = lamps.iter().zip(&self.shadows).filter_map(|(lamp, share)| {
            let share = share.as_ref();
            let share = share.map_or(1.0, |share| f64::from(share.at(x, y)[0]));
            let intensity = lamp.intensity * share;
            (share > 0.0).then_some(punctual::Light { intensity, ..*lamp })
        });
        let lit: Vec<_> = lit.collect();
        let of = |lights: &[_], terms| {
            DVec3::from_array(shade(&surface, lights, around, lighting, terms).0)
        };
        let direct = Terms {
            ambient: false,
            ..Terms::ALL
        };
        let indirect = Terms {
            ambient: true,
            ..Terms::NONE
        };
        let emission = split(self.emission.at(x, y)).0;
        let radiance = of(&lit, direct) + open * of(&[], indirect) + emission;
        let [r, g, b] = radiance.as_vec3().to_array();
        [r, g, b, 1.0]
    }
}

/// What a material's Fresnel terms take, and the highest that it has numbers for.
fn interface(material: &Material, f0: DVec3) -> (Option<Metal>, Fresnel) {
    match material.metal {
        // A metalness map has a say in f0.
        Some(metal) => (Some(Metal { f0, ..metal }), Fresnel::Spectral),
        None if f0.max_element() <= MOST_OF_CLEAR => (None, Fresnel::Dielectric),
        None => (None, Fresnel::Schlick),
    }
}

fn split([x, y, z, w]: [f32; 4]) -> (DVec3, f64) {
    (wide([x, y, z]), f64::from(w))
}

fn wide(color: [f32; 3]) -> DVec3 {
    DVec3::from_array(color.map(f64::from))
}

/// A light as the reference has it, from the scene's numbers alone.
pub fn light(light: &Light) -> punctual::Light {
    let (place, strength, radius) = match light.kind {
        LightKind::Directional {
            direction,
            illuminance,
            angular_diameter_degrees,
        } => {
            let half = f64::from(angular_diameter_degrees).to_radians() / 2.0;
            (
                Place::Towards(-direction.as_dvec3()),
                illuminance,
                half.tan(),
            )
        }
        LightKind::Point {
            position,
            intensity,
            radius,
        }
        | LightKind::Spot {
            position,
            intensity,
            radius,
            ..
        } => (Place::At(position.as_dvec3()), intensity, f64::from(radius)),
    };
    let (axis, (cone_scale, cone_offset)) = match light.kind {
        LightKind::Spot {
            direction,
            inner_degrees,
            outer_degrees,
            ..
        } => {
            let radians = |degrees: f32| f64::from(degrees).to_radians();
            let cone = punctual::cone(radians(inner_degrees), radians(outer_degrees));
            (direction.as_dvec3(), cone)
        }
        _ => (DVec3::NEG_Y, (0.0, 1.0)),
    };
    punctual::Light {
        place,
        intensity: wide(light.color) * f64::from(strength),
        radius,
        axis,
        cone_scale,
        cone_offset,
    }
}
