//! Which numbers make a material, and where does each come from?

use indexmap::IndexMap;

use super::checks::{LIGHT, Range, UNIT};
use super::description::{Description, MaterialText, Triple};
use super::error::Error;
use super::layers::Layers;
use super::{quote, suggest};

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
    /// Oren-Nayar's sigma and Beckmann's m, 0..1.
    pub roughness: f32,
    /// 0..1; 1 hides what lies behind.
    pub opacity: f32,
    /// Radiance given off, cd/m^2, at least 0.
    pub emission: [f32; 3],
    /// Phong's exponent, 0..10000.
    pub shininess: f32,
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

/// The smallest reflectance that is not 0; see [`Material::f0`].
const SMALLEST_F0: f32 = 1e-6;

/// The most materials that one is `like`, each of the next: a chain is followed anew for each
/// material, and nobody reads a longer one.
const LONGEST_CHAIN: usize = 32;

const SHININESS: Range = Range::closed(0.0, MAX_SHININESS as f64);

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

    /// The material `name`, checked. A name of the scene starts from what it is `like`, else from
    /// the material of its own name below, else from the defaults: albedo 0.5, f0 0.04, roughness
    /// 0.5, opacity 1, no emission, shininess from roughness.
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
        Ok(Material {
            name: name.to_owned(),
            albedo: color("albedo", text.albedo, DEFAULT_ALBEDO, UNIT)?,
            f0: color("f0", text.f0, DIELECTRIC_F0, UNIT)?
                .map(|f0| if f0 < SMALLEST_F0 { 0.0 } else { f0 }),
            roughness,
            opacity: layers.number(&at("opacity"), text.opacity.unwrap_or(1.0), UNIT)?,
            emission: color("emission", text.emission, 0.0, LIGHT)?,
            shininess: layers.number(&at("shininess"), shininess, SHININESS)?,
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

/// Takes from `from` what `into` lacks.
fn fill(into: &mut MaterialText, from: &MaterialText) {
    into.albedo = into.albedo.or(from.albedo);
    into.f0 = into.f0.or(from.f0);
    into.roughness = into.roughness.or(from.roughness);
    into.opacity = into.opacity.or(from.opacity);
    into.emission = into.emission.or(from.emission);
    into.shininess = into.shininess.or(from.shininess);
}
