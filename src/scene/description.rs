//! Which tables and keys may a scene file hold? The schema; every key may be absent.
//!
//! A layer (the material library, a scene's text, one `--set`) is read with it on its own, so each
//! key is optional here; what must be there, and in which range, is checked after the merge.

use std::fmt;
use std::path::PathBuf;

use indexmap::IndexMap;
use serde::de::value::MapAccessDeserializer;
use serde::de::{self, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::maps::Slot;

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
    /// Whether it casts shadows; false if absent.
    pub shadow: Option<bool>,
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
    /// A metal whose index was measured: gold, copper, silver or aluminium. Gives f0, f82, n and k, unless they are stated.
    pub metal: Option<String>,
    /// Reflectance at 82 degrees over what Schlick's curve has there, 0..1; 1 if absent.
    pub f82: Option<Triple>,
    /// Index of refraction at 610, 549 and 468 nm, 0.01..100; from f0 if absent.
    pub n: Option<Triple>,
    /// Extinction there, 0..100; 0 if absent.
    pub k: Option<Triple>,
    /// 0..1.
    pub roughness: Option<f64>,
    /// 0..1.
    pub opacity: Option<f64>,
    /// Radiance given off, cd/m^2.
    pub emission: Option<Triple>,
    /// Phong's exponent; from `roughness` if absent.
    pub shininess: Option<f64>,
    /// Whether the back is drawn; true if absent.
    pub two_sided: Option<bool>,
    /// Multiplies `albedo`.
    pub base_color_map: Option<MapText>,
    /// Multiplies `roughness`.
    pub roughness_map: Option<MapText>,
    /// Times `metalness`: how much of the surface is metal.
    pub metalness_map: Option<MapText>,
    /// Normals in the frame of the coordinates, green up.
    pub normal_map: Option<MapText>,
    /// Multiplies `emission`.
    pub emission_map: Option<MapText>,
    /// Multiplies the ambient light.
    pub occlusion_map: Option<MapText>,
    /// Below `alpha_cutoff` there is no surface.
    pub alpha_mask: Option<MapText>,
    /// Repeats per unit of the coordinates: per metre on a surface that has none.
    pub map_repeat: Option<Pair>,
    /// 0..1, with a `metalness_map`.
    pub metalness: Option<f64>,
    /// 0..10, with a `normal_map`.
    pub normal_scale: Option<f64>,
    /// 0..1, with an `alpha_mask`.
    pub alpha_cutoff: Option<f64>,
}

impl MaterialText {
    /// The picture of a slot.
    pub(super) fn map(&self, slot: Slot) -> Option<&MapText> {
        match slot {
            Slot::BaseColor => self.base_color_map.as_ref(),
            Slot::Roughness => self.roughness_map.as_ref(),
            Slot::Metalness => self.metalness_map.as_ref(),
            Slot::Normal => self.normal_map.as_ref(),
            Slot::Emission => self.emission_map.as_ref(),
            Slot::Occlusion => self.occlusion_map.as_ref(),
            Slot::AlphaMask => self.alpha_mask.as_ref(),
        }
    }

    /// True where some slot has a picture.
    pub(super) fn has_maps(&self) -> bool {
        Slot::ALL.iter().any(|&slot| self.map(slot).is_some())
    }
}

/// `"FILE"` or `{ file = "FILE", channel = "g" }`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct MapText {
    /// Relative to the scene's folder and inside it.
    pub file: Option<String>,
    /// Of slots that have one number per texel.
    pub channel: Option<Channel>,
    /// What an MTL file says besides; None for a scene's.
    #[serde(skip)]
    pub origin: Option<MtlOrigin>,
}

/// Which number of a pixel a texture takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
pub(super) enum Channel {
    #[serde(rename = "r")]
    Red,
    #[serde(rename = "g")]
    Green,
    #[serde(rename = "b")]
    Blue,
    #[serde(rename = "a")]
    Alpha,
}

/// Where an MTL file names a picture.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MtlOrigin {
    pub path: PathBuf,
    pub line: usize,
    /// The factor of heights (`-bm`), where the picture may be one of heights.
    pub bump: Option<f32>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MapTable {
    file: Option<String>,
    channel: Option<Channel>,
}

impl<'de> Deserialize<'de> for MapText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(MapVisitor)
    }
}

struct MapVisitor;

impl<'de> Visitor<'de> for MapVisitor {
    type Value = MapText;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of an image file or { file = \"...\", channel = \"...\" }")
    }

    fn visit_str<E: de::Error>(self, file: &str) -> Result<MapText, E> {
        Ok(MapText {
            file: Some(file.to_owned()),
            channel: None,
            origin: None,
        })
    }

    fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<MapText, A::Error> {
        let table = MapTable::deserialize(MapAccessDeserializer::new(table))?;
        Ok(MapText {
            file: table.file,
            channel: table.channel,
            origin: None,
        })
    }
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

/// Two numbers, or one that stands for both.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Pair(pub [f64; 2]);

impl<'de> Deserialize<'de> for Triple {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OneOrAll).map(Self)
    }
}

impl<'de> Deserialize<'de> for Pair {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OneOrAll).map(Self)
    }
}

struct OneOrAll<const N: usize>;

impl<'de, const N: usize> Visitor<'de> for OneOrAll<N> {
    type Value = [f64; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = if N == 2 { "two" } else { "three" };
        write!(f, "a number or an array of {count} numbers")
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<[f64; N], E> {
        Ok([value; N])
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<[f64; N], E> {
        Ok([value as f64; N])
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<[f64; N], A::Error> {
        let mut values = [0.0; N];
        for (count, value) in values.iter_mut().enumerate() {
            *value = list
                .next_element()?
                .ok_or_else(|| de::Error::invalid_length(count, &self))?;
        }
        if list.next_element::<f64>()?.is_some() {
            return Err(de::Error::invalid_length(N + 1, &self));
        }
        Ok(values)
    }
}
