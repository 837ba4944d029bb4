//! Which numbers make a material, and where does each come from?

use glam::{DVec3, Vec3};
use indexmap::IndexMap;

use super::checks::{LIGHT, Range, UNIT};
use super::description::{Description, MapText, MaterialText, Triple};
use super::error::Error;
use super::layers::Layers;
use super::maps::{Maps, Slot};
use super::{quote, suggest};
use crate::reference::metal::Metal;
use crate::reference::spectral;

/// The numbers of one material. Colours are linear sRGB.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    pub name: String,
    /// Diffuse reflectance, 0..1; a metal has none.
    pub albedo: [f32; 3],
    /// Specular reflectance at normal incidence: 0, or 1e-6..1. What lies between becomes 0: it
    /// reflects nothing that can be seen, and where f0 divides, a subnormal number has no result
    /// that GLSL defines.
    pub f0: [f32; 3],
    /// What Fresnel terms beyond Schlick's take; none for a clear interface, whose f0 says all.
    pub metal: Option<Metal>,
    /// Oren-Nayar's sigma and Beckmann's m, 0..1.
    pub roughness: f32,
    /// 0..1; 1 hides what lies behind.
    pub opacity: f32,
    /// Radiance given off, cd/m^2, at least 0.
    pub emission: [f32; 3],
    /// Phong's exponent, 0..10000.
    pub shininess: f32,
    /// Whether the back is drawn, lit as the front.
    pub two_sided: bool,
    pub maps: Maps,
    /// 0..1, multiplies the metalness map; without one it has no effect.
    pub metalness: f32,
    /// 0..10, multiplies x and y of the normal map.
    pub normal_scale: f32,
    /// 0..1: where the alpha mask is below, there is no surface.
    pub alpha_cutoff: f32,
}

/// What a material is that states nothing.
impl Default for Material {
    fn default() -> Self {
        Self {
            name: DEFAULT_NAME.to_owned(),
            albedo: [DEFAULT_ALBEDO as f32; 3],
            f0: [DIELECTRIC_F0 as f32; 3],
            metal: None,
            roughness: DEFAULT_ROUGHNESS as f32,
            opacity: 1.0,
            emission: [0.0; 3],
            shininess: shininess_from_roughness(DEFAULT_ROUGHNESS) as f32,
            two_sided: true,
            maps: Maps::default(),
            metalness: 1.0,
            normal_scale: 1.0,
            alpha_cutoff: DEFAULT_CUTOFF as f32,
        }
    }
}

/// The largest Phong exponent. Its highlight is 0.8 degrees from the middle to half strength, about
/// a pixel of a usual frame, and `pow` of f32 still keeps three digits there (10^4 x 6e-8).
pub const MAX_SHININESS: f32 = 10_000.0;

/// The f0 of a surface whose index of refraction is 1.5: ((1.5 - 1) / (1.5 + 1))^2.
pub(super) const DIELECTRIC_F0: f64 = 0.04;
/// The roughness of a material that states none: between mirror and chalk.
pub(super) const DEFAULT_ROUGHNESS: f64 = 0.5;
/// The albedo of a material that states none: the light grey of concrete.
pub(super) const DEFAULT_ALBEDO: f64 = 0.5;

/// The alpha below which a mask's surface ends: the half, as in glTF.
const DEFAULT_CUTOFF: f64 = 0.5;

/// The smallest reflectance that is not 0; see [`Material::f0`].
const SMALLEST_F0: f32 = 1e-6;

/// The most materials that one is `like`, each of the next: a chain is followed anew for each
/// material, and nobody reads a longer one.
const LONGEST_CHAIN: usize = 32;

/// Indices of refraction of metals in the visible lie between 0.04 and 8, extinctions between 1 and 10.
const INDEX: Range = Range::closed(0.01, 100.0);
const EXTINCTION: Range = Range::closed(0.0, 100.0);

const SHININESS: Range = Range::closed(0.0, MAX_SHININESS as f64);

/// Repeats of a picture: from one over a kilometre to one over a micrometre, where coordinates are
/// metres; between, f32 keeps them apart.
const REPEAT: Range = Range::closed(1e-3, 1e6);
/// A slope of 10 stands at 84 degrees: more hides what the map shows.
const NORMAL_SCALE: Range = Range::closed(0.0, 10.0);

/// The name of the material of surfaces that name none.
pub(super) const DEFAULT_NAME: &str = "default";

/// The Phong exponent whose highlight is as wide as Beckmann's of roughness `m`: n = 2 / m^2 - 2,
/// clamped to 0..`MAX_SHININESS` (a mirror's would be infinite).
pub fn shininess_from_roughness(m: f64) -> f64 {
    (2.0 / (m * m) - 2.0).clamp(0.0, f64::from(MAX_SHININESS))
}

/// The inverse: m = sqrt(2 / (n + 2)), 1 for n = 0.
pub fn roughness_from_shininess(n: f64) -> f64 {
    (2.0 / (n + 2.0)).sqrt()
}

/// The built-in materials as a layer's text.
pub(super) const LIBRARY: &str = include_str!("library.toml");

/// The materials of the layers below (library and MTL) and of the scene with its overrides.
pub(super) struct Palette {
    base: IndexMap<String, MaterialText>,
    scene: IndexMap<String, MaterialText>,
}

impl Palette {
    /// `base` holds what a scene starts from, `scene` what it and `--set` state.
    pub(super) fn new(base: Description, scene: Description) -> Self {
        Self {
            base: base.material,
            scene: scene.material,
        }
    }

    /// True where some layer has a material of this name.
    pub(super) fn contains(&self, name: &str) -> bool {
        name == DEFAULT_NAME || self.base.contains_key(name) || self.scene.contains_key(name)
    }

    /// All names.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        let own = self.scene.keys().map(String::as_str);
        own.chain(self.base.keys().map(String::as_str))
    }

    /// The names that the scene itself writes.
    pub(super) fn scene_names(&self) -> impl Iterator<Item = &str> {
        self.scene.keys().map(String::as_str)
    }

    /// The pictures that the material `name` has, as [`Palette::build`] does with numbers.
    pub(super) fn maps(&self, name: &str, layers: &Layers) -> Result<Vec<(Slot, MapText)>, Error> {
        let text = self.resolve(name, layers)?;
        let map = |slot| text.map(slot).map(|map| (slot, map.clone()));
        Ok(Slot::ALL.into_iter().filter_map(map).collect())
    }

    /// True where some material of the scene itself has pictures.
    pub(super) fn scene_has_maps(description: &Description) -> bool {
        description.material.values().any(MaterialText::has_maps)
    }

    /// The material `name`, checked, without its pictures. A name of the scene starts from what it is `like`, else from
    /// the material of its own name below, else from the defaults: albedo 0.5, f0 0.04, roughness
    /// 0.5, opacity 1, no emission, shininess from roughness, both sides, no pictures.
    pub(super) fn build(&self, name: &str, layers: &Layers) -> Result<Material, Error> {
        let text = self.resolve(name, layers)?;
        let at = |key| ["material", name, key];
        let roughness = text.roughness.unwrap_or(DEFAULT_ROUGHNESS);
        let roughness = layers.number(&at("roughness"), roughness, UNIT)?;
        let shininess = text
            .shininess
            .unwrap_or_else(|| shininess_from_roughness(f64::from(roughness)));
        let color = |key, value: Option<Triple>, default: f64, range| {
            let value = value.map_or([default; 3], |triple| triple.0);
            layers.triple(&at(key), value, range)
        };
        let measured = measured(&text, name, layers)?;
        let f0 = match (text.f0, measured) {
            (None, Some(metal)) => metal.f0.clamp(DVec3::ZERO, DVec3::ONE).as_vec3().to_array(),
            _ => color("f0", text.f0, DIELECTRIC_F0, UNIT)?,
        };
        let f0 = f0.map(|f0| if f0 < SMALLEST_F0 { 0.0 } else { f0 });
        let repeat = text.map_repeat.map_or([1.0; 2], |pair| pair.0);
        Ok(Material {
            name: name.to_owned(),
            albedo: color("albedo", text.albedo, DEFAULT_ALBEDO, UNIT)?,
            f0,
            metal: metal(&text, measured, f0, name, layers)?,
            roughness,
            opacity: layers.number(&at("opacity"), text.opacity.unwrap_or(1.0), UNIT)?,
            emission: color("emission", text.emission, 0.0, LIGHT)?,
            shininess: layers.number(&at("shininess"), shininess, SHININESS)?,
            two_sided: text.two_sided.unwrap_or(true),
            maps: Maps {
                repeat: [
                    layers.number(&at("map_repeat"), repeat[0], REPEAT)?,
                    layers.number(&at("map_repeat"), repeat[1], REPEAT)?,
                ],
                ..Maps::default()
            },
            metalness: layers.number(&at("metalness"), text.metalness.unwrap_or(1.0), UNIT)?,
            normal_scale: layers.number(
                &at("normal_scale"),
                text.normal_scale.unwrap_or(1.0),
                NORMAL_SCALE,
            )?,
            alpha_cutoff: layers.number(
                &at("alpha_cutoff"),
                text.alpha_cutoff.unwrap_or(DEFAULT_CUTOFF),
                UNIT,
            )?,
        })
    }

    /// Follows `like` from `name` down and lays the numbers over each other.
    fn resolve(&self, name: &str, layers: &Layers) -> Result<MaterialText, Error> {
        let mut result = MaterialText::default();
        let mut visited: Vec<&str> = vec![name];
        loop {
            let current = visited[visited.len() - 1];
            let own = self.scene.get(current);
            if let Some(own) = own {
                fill(&mut result, own);
            }
            let Some(like) = own.and_then(|text| text.like.as_deref()) else {
                if let Some(base) = self.base.get(current) {
                    fill(&mut result, base);
                }
                return Ok(result);
            };
            let path = ["material", current, "like"];
            if !self.contains(like) {
                return Err(layers.error(&path, suggest::unknown("material", like, self.names())));
            }
            if visited.contains(&like) {
                let (key, like) = (quote::key(&path), quote::short(like));
                let message = format!("{key} = '{like}' leads back to itself");
                return Err(layers.error(&path, message));
            }
            if visited.len() > LONGEST_CHAIN {
                let message = format!(
                    "{}: from '{}' to here more than {LONGEST_CHAIN} materials are like the next: \
                     shorten the chain",
                    quote::key(&path),
                    quote::short(name)
                );
                return Err(layers.error(&path, message));
            }
            visited.push(like);
        }
    }
}

/// The metal that a material names.
fn measured(text: &MaterialText, name: &str, layers: &Layers) -> Result<Option<Metal>, Error> {
    let Some(metal) = &text.metal else {
        return Ok(None);
    };
    let found = spectral::METALS.iter().find(|known| known.name == metal);
    match found {
        Some(known) => Ok(Some(known.metal())),
        None => {
            let names = spectral::METALS.iter().map(|known| known.name);
            let message = suggest::unknown("metal", metal, names);
            Err(layers.error(&["material", name, "metal"], message))
        }
    }
}

/// What Fresnel terms take: of the metal that is named, and what is stated instead.
fn metal(
    text: &MaterialText,
    measured: Option<Metal>,
    f0: [f32; 3],
    name: &str,
    layers: &Layers,
) -> Result<Option<Metal>, Error> {
    let stated = [&text.f82, &text.n, &text.k];
    if measured.is_none() && stated.iter().all(|triple| triple.is_none()) {
        return Ok(None);
    }
    let metal = measured.unwrap_or_else(|| Metal::clear(Vec3::from(f0).as_dvec3()));
    let or = |key, value: &Option<Triple>, otherwise: DVec3, range| match value {
        None => Ok(otherwise),
        Some(triple) => {
            let triple = layers.triple(&["material", name, key], triple.0, range)?;
            Ok(Vec3::from(triple).as_dvec3())
        }
    };
    Ok(Some(Metal {
        tint: or("f82", &text.f82, metal.tint, UNIT)?,
        n: or("n", &text.n, metal.n, INDEX)?,
        k: or("k", &text.k, metal.k, EXTINCTION)?,
        ..metal
    }))
}

/// Takes from `from` what `into` lacks.
fn fill(into: &mut MaterialText, from: &MaterialText) {
    fn take<T: Clone>(into: &mut Option<T>, from: &Option<T>) {
        if into.is_none() {
            into.clone_from(from);
        }
    }
    take(&mut into.albedo, &from.albedo);
    take(&mut into.f0, &from.f0);
    take(&mut into.metal, &from.metal);
    take(&mut into.f82, &from.f82);
    take(&mut into.n, &from.n);
    take(&mut into.k, &from.k);
    take(&mut into.roughness, &from.roughness);
    take(&mut into.opacity, &from.opacity);
    take(&mut into.emission, &from.emission);
    take(&mut into.shininess, &from.shininess);
    take(&mut into.two_sided, &from.two_sided);
    take(&mut into.base_color_map, &from.base_color_map);
    take(&mut into.roughness_map, &from.roughness_map);
    take(&mut into.metalness_map, &from.metalness_map);
    take(&mut into.normal_map, &from.normal_map);
    take(&mut into.emission_map, &from.emission_map);
    take(&mut into.occlusion_map, &from.occlusion_map);
    take(&mut into.alpha_mask, &from.alpha_mask);
    take(&mut into.map_repeat, &from.map_repeat);
    take(&mut into.metalness, &from.metalness);
    take(&mut into.normal_scale, &from.normal_scale);
    take(&mut into.alpha_cutoff, &from.alpha_cutoff);
}
