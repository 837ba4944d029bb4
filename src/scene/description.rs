//! Which tables and keys may a scene file hold? The schema; every key may be absent.
//!
//! A layer (the material library, a scene's text, one `--set`) is read with it on its own, so each
//! key is optional here; what must be there, and in which range, is checked after the merge.

use std::fmt;

use indexmap::IndexMap;
use serde::de::{self, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

/// A whole scene file, or a part of one.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Description {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraText>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ambient: Option<AmbientText>,
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub light: IndexMap<String, LightText>,
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub material: IndexMap<String, MaterialText>,
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub model: IndexMap<String, ModelText>,
}

/// `[camera]`
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraText {
    /// Where the eye is, m.
    pub position: Option<[f64; 3]>,
    /// What it looks at, m.
    pub target: Option<[f64; 3]>,
    /// Which way is up in the picture.
    pub up: Option<[f64; 3]>,
    /// `"perspective"` (the default) or `"orthographic"`.
    pub projection: Option<ProjectionText>,
    /// Of a perspective: the angle from the picture's lower to its upper edge.
    pub vertical_fov_degrees: Option<f64>,
    /// Of an orthographic view: the picture's height, m.
    pub height: Option<f64>,
    /// Exposure value at ISO 100.
    pub exposure_ev100: Option<f64>,
}

/// How space becomes a picture.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum ProjectionText {
    Perspective,
    Orthographic,
}

/// `[ambient]`
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AmbientText {
    /// Radiance from above (+y), cd/m^2.
    pub sky: Option<Triple>,
    /// Radiance from below, cd/m^2.
    pub ground: Option<Triple>,
}

/// `[light.NAME]`
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LightText {
    /// `"directional"`, `"point"` or `"spot"`.
    pub kind: Option<LightKindText>,
    /// Weight per channel of illuminance or intensity; white if absent.
    pub color: Option<Triple>,
    /// The way the light travels (directional, spot).
    pub direction: Option<[f64; 3]>,
    /// On a surface that faces the light, lx (directional).
    pub illuminance: Option<f64>,
    /// The disc's diameter as seen from the scene (directional).
    pub angular_diameter_degrees: Option<f64>,
    /// m (point, spot).
    pub position: Option<[f64; 3]>,
    /// What a spot's beam points at, m.
    pub target: Option<[f64; 3]>,
    /// cd (point, spot).
    pub intensity: Option<f64>,
    /// m (point, spot).
    pub radius: Option<f64>,
    /// Half-angle of full strength (spot).
    pub inner_degrees: Option<f64>,
    /// Half-angle beyond which there is no light (spot).
    pub outer_degrees: Option<f64>,
}

/// How a light sends its light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum LightKindText {
    Directional,
    Point,
    Spot,
}

/// `[material.NAME]`
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialText {
    /// The material whose numbers this one starts from.
    pub like: Option<String>,
    /// Diffuse reflectance, 0..1.
    pub albedo: Option<Triple>,
    /// Specular reflectance at normal incidence, 0..1; below 1e-6 it becomes 0.
    pub f0: Option<Triple>,
    /// 0..1.
    pub roughness: Option<f64>,
    /// 0..1.
    pub opacity: Option<f64>,
    /// Radiance given off, cd/m^2.
    pub emission: Option<Triple>,
    /// Phong's exponent; from `roughness` if absent.
    pub shininess: Option<f64>,
}

/// `[model.NAME]`
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ModelText {
    /// A model of the project's own making.
    pub shape: Option<String>,
    /// An OBJ file, relative to the scene's folder and inside it.
    pub file: Option<String>,
    /// The material of every part.
    pub material: Option<String>,
    /// The material of a part of a shape, or instead of a material of the file's MTL.
    pub materials: Option<IndexMap<String, String>>,
    /// m.
    pub position: Option<[f64; 3]>,
    /// Turns about the fixed axes x, then y, then z.
    pub rotation_degrees: Option<[f64; 3]>,
    /// One factor, or one per axis.
    pub scale: Option<Triple>,
}

/// Three numbers, or one that stands for all three.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Triple(pub [f64; 3]);

impl<'de> Deserialize<'de> for Triple {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TripleVisitor)
    }
}

struct TripleVisitor;

impl<'de> Visitor<'de> for TripleVisitor {
    type Value = Triple;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number or an array of three numbers")
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Triple, E> {
        Ok(Triple([value; 3]))
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Triple, E> {
        Ok(Triple([value as f64; 3]))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Triple, A::Error> {
        let mut values = [0.0; 3];
        for (count, value) in values.iter_mut().enumerate() {
            *value = list
                .next_element()?
                .ok_or_else(|| de::Error::invalid_length(count, &self))?;
        }
        if list.next_element::<f64>()?.is_some() {
            return Err(de::Error::invalid_length(4, &self));
        }
        Ok(Triple(values))
    }
}
