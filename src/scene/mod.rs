//! What can a user describe, and how is it read from files?
//!
//! [`load`] reads a scene file (TOML) or an OBJ file into a [`Scene`]: plain numbers in metres and
//! photometric units, checked and ready for any renderer. The floor knows nothing of the GPU.
//!
//! * A scene file has the tables `[camera]`, `[ambient]`, `[light.NAME]`, `[material.NAME]` and
//!   `[model.NAME]`; `description` is the schema.
//! * Layers lie over each other, each checked on its own: the material library, materials of MTL
//!   files, the framing of a scene without camera or lights, the scene's text, each `--set`.
//! * No file makes this floor panic, and none outside the scene's folder is read.

mod assembly;
mod box_projection;
mod camera;
mod checks;
mod description;
mod error;
mod framing;
mod image_file;
mod layers;
mod lights;
mod maps;
mod materials;
mod mesh;
mod models;
mod mtl;
mod mtl_maps;
mod normals;
mod obj;
mod obj_scene;
mod obj_sieve;
mod overrides;
mod paths;
mod quote;
pub mod shapes;
mod still;
pub(crate) mod suggest;
mod tangents;
mod texture;
mod texture_loader;
mod toml_file;
mod wall;
mod warnings;

use std::path::Path;

pub use assembly::built_in_materials;
pub use camera::{Camera, Projection};
pub use error::{Error, Place};
pub use lights::{Ambient, Light, LightKind, MAX_LIGHTS};
pub use maps::{Maps, Slot};
pub use materials::{MAX_SHININESS, Material, roughness_from_shininess, shininess_from_roughness};
pub use mesh::{Bounds, Mesh};
pub use models::MAX_OBJECTS;
pub use normals::CREASE_DEGREES;
pub use still::{Still, StillPixels};
pub use texture::{MAX_TEXEL_EMISSION, MAX_TEXTURE_PIXELS, MAX_TEXTURE_SIDE, Texture};
pub use texture_loader::MAX_TEXTURES;
pub use wall::{Exhibit, Order, Wall};

/// A loaded scene. Numbers of `objects` are valid indices of `meshes` and `materials`.
#[derive(Clone, Debug)]
pub struct Scene {
    pub camera: Camera,
    pub ambient: Ambient,
    /// At most [`MAX_LIGHTS`].
    pub lights: Vec<Light>,
    /// The materials in use, in the order of their first use.
    pub materials: Vec<Material>,
    pub meshes: Vec<Mesh>,
    /// The pictures of the materials in use, each file once per slot and channel.
    pub textures: Vec<Texture>,
    /// At least one, at most [`MAX_OBJECTS`].
    pub objects: Vec<Object>,
    /// What was passed over while loading, for the user to read.
    pub warnings: Vec<String>,
}

/// A mesh that stands in the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// The model's name; with several parts, `MODEL/PART`.
    pub name: String,
    /// Index into [`Scene::meshes`].
    pub mesh: usize,
    /// Index into [`Scene::materials`].
    pub material: usize,
    /// From the mesh's frame to the world's; it can be inverted.
    pub transform: glam::Affine3A,
}

impl Scene {
    /// A box around all objects, m.
    pub fn bounds(&self) -> Bounds {
        let placed = self.objects.iter();
        Bounds::around(
            &self.meshes,
            placed.map(|object| (object.mesh, &object.transform)),
        )
    }

    /// The number of triangles that are drawn: a mesh counts once for each object that uses it.
    pub fn triangle_count(&self) -> usize {
        let count = |object: &Object| self.meshes[object.mesh].triangle_count();
        self.objects.iter().map(count).sum()
    }
}

/// How to load a scene.
#[derive(Clone, Debug)]
pub struct LoadOptions {
    /// `KEY=VALUE` lines that change the scene, such as `material.gold.roughness=0.3`.
    pub overrides: Vec<String>,
    /// Shows a progress bar on stderr for OBJ files above 16 MiB, if stderr is a terminal.
    pub progress: bool,
    /// The picture's width over its height, for the view of a scene that states none. What is not
    /// above 0 and finite counts as the default, 16/9.
    pub aspect: f32,
}

/// The aspect of a picture of no known size.
const DEFAULT_ASPECT: f32 = 16.0 / 9.0;

impl Default for LoadOptions {
    fn default() -> Self {
        Self {
            overrides: Vec::new(),
            progress: false,
            aspect: DEFAULT_ASPECT,
        }
    }
}

impl LoadOptions {
    /// `aspect`, or its default.
    fn ratio(&self) -> f64 {
        if self.aspect > 0.0 && self.aspect.is_finite() {
            f64::from(self.aspect)
        } else {
            f64::from(DEFAULT_ASPECT)
        }
    }
}

/// Reads a scene file (`.toml`) or an OBJ file (`.obj`), which is a scene by itself.
///
/// # Errors
/// A file that is missing, unreadable or wrong, or an override that cannot be obeyed; the message
/// says what, where (file, line, column) and what to do. [`Error::exit_code`] is 6 or 2.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, Error> {
    let ending = path.extension().and_then(|ending| ending.to_str());
    match ending.map(str::to_ascii_lowercase).as_deref() {
        Some("toml") => toml_file::load(path, options),
        Some("obj") => obj_scene::load(path, options),
        _ => Err(Error::file(
            path,
            "is neither a scene (.toml) nor a model (.obj): give a file with one of these endings",
        )),
    }
}
