//! What shines on a scene, in photometric units?

use glam::{DVec3, Vec3};

use super::checks::{COORDINATE, FARTHEST, LIGHT, Range};
use super::description::{AmbientText, LightKindText, LightText, Triple};
use super::error::Error;
use super::layers::Layers;
use super::quote;

/// The most lights that a scene may have: each one is evaluated for every pixel.
pub const MAX_LIGHTS: usize = 256;

/// Light from everywhere, as two hemispheres of even radiance, cd/m^2.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ambient {
    /// From above (+y).
    pub sky: [f32; 3],
    /// From below.
    pub ground: [f32; 3],
}

/// A lamp.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    pub name: String,
    /// The weight of each channel, linear sRGB; multiplies illuminance or intensity.
    pub color: [f32; 3],
    /// Whether what stands in its way keeps its light off.
    pub shadow: bool,
    pub kind: LightKind,
}

impl Light {
    /// That it gives no light, for the user to read; none where it gives some.
    pub(super) fn told_if_dark(&self) -> Option<String> {
        let (key, strength) = match self.kind {
            LightKind::Directional { illuminance, .. } => ("illuminance", illuminance),
            LightKind::Point { intensity, .. } | LightKind::Spot { intensity, .. } => {
                ("intensity", intensity)
            }
        };
        let key = match (strength == 0.0, self.color == [0.0; 3]) {
            (false, false) => return None,
            (true, _) => key,
            (false, true) => "color",
        };
        let name = quote::key(&["light", &self.name]);
        Some(format!("{name} gives no light: its {key} is 0"))
    }
}

/// How a lamp sends its light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// From so far away that its rays are parallel, such as the sun.
    Directional {
        /// The unit direction in which the light travels.
        direction: Vec3,
        /// On a surface that faces it, lx.
        illuminance: f32,
        /// How large the disc looks, degrees, in (0, 90).
        angular_diameter_degrees: f32,
    },
    /// A small sphere.
    Point {
        /// m.
        position: Vec3,
        /// cd.
        intensity: f32,
        /// m, positive.
        radius: f32,
    },
    /// A small sphere with a cone around its beam.
    Spot {
        /// m.
        position: Vec3,
        /// The unit direction in which the beam travels.
        direction: Vec3,
        /// In the beam's middle, cd.
        intensity: f32,
        /// m, positive.
        radius: f32,
        /// Half-angle of full strength, degrees; less than `outer_degrees`.
        inner_degrees: f32,
        /// Half-angle beyond which there is no light, degrees, in [0.5, 90). The cosines of the two
        /// angles differ by at least 1e-6.
        outer_degrees: f32,
    },
}

/// The sun's mean angular diameter, degrees: 2 atan(696 000 km / 149.6e6 km).
const SUN_DEGREES: f64 = 0.53;
/// A household lamp's bulb, m.
const BULB_RADIUS: f64 = 0.05;
/// A theatre spotlight's usual beam, half-angles in degrees.
const SPOT_DEGREES: (f64, f64) = (15.0, 20.0);
/// Half-angles of a spot, degrees: a narrower beam is a laser's, and its edge has no room in f32.
const OUTER_DEGREES: Range = Range::below(0.5, 90.0);
/// The least difference between the cosines of a spot's angles. f32 knows a cosine to 6e-8: in less
/// room the edge would be noise.
const NARROWEST_EDGE: f64 = 1e-6;

/// Checks a merged `[ambient]`; what is absent is black.
pub(super) fn build_ambient(text: &AmbientText, layers: &Layers) -> Result<Ambient, Error> {
    let radiance = |key: &str, value: Option<Triple>| {
        let value = value.map_or([0.0; 3], |triple| triple.0);
        layers.triple(&["ambient", key], value, LIGHT)
    };
    Ok(Ambient {
        sky: radiance("sky", text.sky)?,
        ground: radiance("ground", text.ground)?,
    })
}

/// Checks a merged `[light.NAME]`.
pub(super) fn build(name: &str, text: &LightText, layers: &Layers) -> Result<Light, Error> {
    let at = At { name, layers };
    let kind = layers.required(&["light", name, "kind"], text.kind)?;
    at.refuse_foreign(kind, text)?;
    let color = text.color.map_or([1.0; 3], |triple| triple.0);
    Ok(Light {
        name: name.to_owned(),
        color: layers.triple(&["light", name, "color"], color, LIGHT)?,
        shadow: text.shadow.unwrap_or(false),
        kind: match kind {
            LightKindText::Directional => at.directional(text)?,
            LightKindText::Point => at.point(text)?,
            LightKindText::Spot => at.spot(text)?,
        },
    })
}

/// The light that is being checked.
struct At<'a> {
    name: &'a str,
    layers: &'a Layers,
}

impl At<'_> {
    /// Refuses keys that another kind of light has: they would be ignored in silence.
    fn refuse_foreign(&self, kind: LightKindText, text: &LightText) -> Result<(), Error> {
        use LightKindText::{Directional, Point, Spot};
        let keys: [(&str, bool, &[LightKindText]); 9] = [
            ("direction", text.direction.is_some(), &[Directional, Spot]),
            ("illuminance", text.illuminance.is_some(), &[Directional]),
            (
                "angular_diameter_degrees",
                text.angular_diameter_degrees.is_some(),
                &[Directional],
            ),
            ("position", text.position.is_some(), &[Point, Spot]),
            ("target", text.target.is_some(), &[Spot]),
            ("intensity", text.intensity.is_some(), &[Point, Spot]),
            ("radius", text.radius.is_some(), &[Point, Spot]),
            ("inner_degrees", text.inner_degrees.is_some(), &[Spot]),
            ("outer_degrees", text.outer_degrees.is_some(), &[Spot]),
        ];
        for (key, given, kinds) in keys {
            if given && !kinds.contains(&kind) {
                let path = ["light", self.name, key];
                let message = format!(
                    "{}: a {} light has no {key}",
                    quote::key(&path),
                    kind_name(kind)
                );
                return Err(self.layers.error(&path, message));
            }
        }
        Ok(())
    }

    fn directional(&self, text: &LightText) -> Result<LightKind, Error> {
        let diameter = text.angular_diameter_degrees.unwrap_or(SUN_DEGREES);
        Ok(LightKind::Directional {
            direction: self.direction(text.direction)?,
            illuminance: self.needed("illuminance", text.illuminance, LIGHT)?,
            angular_diameter_degrees: self.needed(
                "angular_diameter_degrees",
                Some(diameter),
                Range::open(0.0, 90.0),
            )?,
        })
    }

    fn point(&self, text: &LightText) -> Result<LightKind, Error> {
        Ok(LightKind::Point {
            position: self.place("position", text.position)?,
            intensity: self.needed("intensity", text.intensity, LIGHT)?,
            radius: self.radius(text)?,
        })
    }

    fn spot(&self, text: &LightText) -> Result<LightKind, Error> {
        let position = self.place("position", text.position)?;
        let direction = match (text.direction, text.target) {
            (Some(_), Some(_)) => {
                let light = quote::key(&["light", self.name]);
                let message = format!("{light}: give target or direction, not both");
                return Err(self.layers.error(&["light", self.name, "target"], message));
            }
            (None, Some(_)) => {
                let target = self.place("target", text.target)?;
                self.unit("target", (target - position).as_dvec3())?
            }
            (given, None) => self.direction(given)?,
        };
        let (inner, outer) = SPOT_DEGREES;
        let outer = text.outer_degrees.unwrap_or(outer);
        let inner = text.inner_degrees.unwrap_or(inner.min(outer * 0.75));
        let outer_degrees = self.needed("outer_degrees", Some(outer), OUTER_DEGREES)?;
        let inner_degrees = self.needed(
            "inner_degrees",
            Some(inner),
            Range::below(0.0, f64::from(outer_degrees)),
        )?;
        let cos = |degrees: f32| f64::from(degrees).to_radians().cos();
        if cos(inner_degrees) - cos(outer_degrees) < NARROWEST_EDGE {
            let path = ["light", self.name, "inner_degrees"];
            let message = format!(
                "{} = {inner_degrees} is too near to outer_degrees = {outer_degrees}: their cosines \
                 must differ by {NARROWEST_EDGE:e}",
                quote::key(&path)
            );
            return Err(self.layers.error(&path, message));
        }
        Ok(LightKind::Spot {
            position,
            direction,
            intensity: self.needed("intensity", text.intensity, LIGHT)?,
            radius: self.radius(text)?,
            inner_degrees,
            outer_degrees,
        })
    }

    fn radius(&self, text: &LightText) -> Result<f32, Error> {
        let radius = text.radius.unwrap_or(BULB_RADIUS);
        self.needed("radius", Some(radius), Range::above(0.0, FARTHEST))
    }

    fn needed(&self, key: &str, value: Option<f64>, range: Range) -> Result<f32, Error> {
        let path = ["light", self.name, key];
        let value = self.layers.required(&path, value)?;
        self.layers.number(&path, value, range)
    }

    fn place(&self, key: &str, value: Option<[f64; 3]>) -> Result<Vec3, Error> {
        let path = ["light", self.name, key];
        let value = self.layers.required(&path, value)?;
        let value = self.layers.triple(&path, value, COORDINATE)?;
        Ok(Vec3::from_array(value))
    }

    fn direction(&self, value: Option<[f64; 3]>) -> Result<Vec3, Error> {
        let direction = self.place("direction", value)?;
        self.unit("direction", direction.as_dvec3())
    }

    fn unit(&self, key: &str, vector: DVec3) -> Result<Vec3, Error> {
        match vector.try_normalize() {
            Some(unit) => Ok(unit.as_vec3()),
            None => {
                let path = ["light", self.name, key];
                let message = format!("{} gives no direction: its length is 0", quote::key(&path));
                Err(self.layers.error(&path, message))
            }
        }
    }
}

fn kind_name(kind: LightKindText) -> &'static str {
    match kind {
        LightKindText::Directional => "directional",
        LightKindText::Point => "point",
        LightKindText::Spot => "spot",
    }
}
