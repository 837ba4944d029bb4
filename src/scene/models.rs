//! Which meshes do a scene's models stand for, and where do they stand?

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use glam::{Affine3A, EulerRot, Quat, Vec3};
use indexmap::IndexMap;

use super::checks::{COORDINATE, LARGEST_SCALE, Range};
use super::description::{Description, MaterialText, ModelText};
use super::error::Error;
use super::layers::Layers;
use super::materials::{DEFAULT_NAME, Palette};
use super::mesh::Mesh;
use super::obj::{self, ObjFile};
use super::shapes::Shape;
use super::{paths, quote, suggest};

/// The most objects (parts of models) that a scene may have: instance records of 128 bytes fill the
/// 128 MiB that every device can bind as one buffer.
pub const MAX_OBJECTS: usize = 1 << 20;

/// Turns, degrees: more than any animation counts up, and exact in f32 to a thousandth.
const TURN: Range = Range::closed(-36_000.0, 36_000.0);
/// The smallest factor of a scale: its inverse, which turns normals, stays as far from overflow as
/// `LARGEST_SCALE`.
const SMALLEST_SCALE: f32 = 1e-6;
const SCALE: Range = Range::closed(-LARGEST_SCALE, LARGEST_SCALE);

/// A part of a model: a mesh with its own name and material, before the scene chooses another.
#[derive(Clone)]
struct Part {
    mesh: usize,
    name: String,
    /// The part's name in the scene's `materials`: of a shape its own, of a file the MTL's material.
    slot: String,
    /// What it is made of unless the scene says otherwise.
    material: String,
}

/// A placed part.
pub(super) struct Placed {
    pub name: String,
    pub mesh: usize,
    pub material: String,
    pub transform: Affine3A,
    /// The model's name and, where given, the part's: for messages.
    pub key: Vec<String>,
}

/// An OBJ file that the user named on the command line. It may lie anywhere and be a link; only
/// what it names is confined to its folder.
pub(super) struct Lone {
    /// The last part of the path: the model's `file`.
    pub name: String,
    /// As typed.
    pub path: PathBuf,
    /// Where the file lies; for a link, where the file lies that it leads to.
    pub folder: PathBuf,
}

/// Loads each mesh once, however many models use it.
pub(super) struct Loader<'a> {
    pub folder: &'a Path,
    /// An OBJ file by itself: its materials keep their own names.
    lone: Option<Lone>,
    progress: bool,
    /// Whether texture coordinates are wanted of files whose MTL has no picture.
    coordinates: bool,
    files: HashMap<PathBuf, Vec<Part>>,
    shapes: HashMap<Shape, Vec<Part>>,
    pub meshes: Vec<Mesh>,
    /// The materials of MTL files, as `FILE:NAME` unless the OBJ stands alone.
    pub materials: IndexMap<String, MaterialText>,
    pub warnings: Vec<String>,
}

impl<'a> Loader<'a> {
    /// A loader for files in `folder`; `lone` for an OBJ file without a scene around it.
    pub(super) fn new(folder: &'a Path, lone: Option<Lone>, progress: bool) -> Self {
        Self {
            folder,
            lone,
            progress,
            coordinates: false,
            files: HashMap::new(),
            shapes: HashMap::new(),
            meshes: Vec::new(),
            materials: IndexMap::new(),
            warnings: Vec::new(),
        }
    }

    /// All models of the scene, as placed parts in the scene's order.
    pub(super) fn load(
        &mut self,
        description: &Description,
        layers: &Layers,
    ) -> Result<Vec<Placed>, Error> {
        if description.model.is_empty() {
            return Err(layers.error(&[], "has no [model.NAME]: there is nothing to draw"));
        }
        self.coordinates = Palette::scene_has_maps(description);
        let mut placed = Vec::new();
        for (name, text) in &description.model {
            let transform = transform(name, text, layers)?;
            let parts = self.parts(name, text, layers)?;
            if placed.len() + parts.len() > MAX_OBJECTS {
                let message = format!("more than {MAX_OBJECTS} objects (parts of models)");
                return Err(layers.error(&["model", name], message));
            }
            check_slots(name, text, &parts, layers)?;
            let alone = parts.len() == 1;
            for part in parts {
                placed.push(place(name, text, part, transform, alone));
            }
        }
        Ok(placed)
    }

    fn parts(&mut self, name: &str, text: &ModelText, layers: &Layers) -> Result<Vec<Part>, Error> {
        match (&text.shape, &text.file) {
            (Some(shape), None) => match Shape::from_name(shape) {
                Some(shape) => Ok(self.shape(shape)),
                None => {
                    let known = Shape::ALL.iter().map(|shape| shape.name());
                    let message = suggest::unknown("shape", shape, known);
                    Err(layers.error(&["model", name, "shape"], message))
                }
            },
            (None, Some(file)) => self.file(name, file, layers),
            (Some(_), Some(_)) => {
                let model = quote::key(&["model", name]);
                let message = format!("{model}: give shape or file, not both");
                Err(layers.error(&["model", name, "file"], message))
            }
            (None, None) => {
                let model = quote::key(&["model", name]);
                let message = format!("{model} needs a shape or a file");
                Err(layers.error(&["model", name], message))
            }
        }
    }

    fn shape(&mut self, shape: Shape) -> Vec<Part> {
        if let Some(parts) = self.shapes.get(&shape) {
            return parts.clone();
        }
        let mut parts = Vec::new();
        for part in shape.parts() {
            parts.push(Part {
                mesh: self.meshes.len(),
                name: part.name.to_owned(),
                slot: part.name.to_owned(),
                material: DEFAULT_NAME.to_owned(),
            });
            self.meshes.push(part.mesh);
        }
        self.shapes.insert(shape, parts.clone());
        parts
    }

    fn file(&mut self, name: &str, file: &str, layers: &Layers) -> Result<Vec<Part>, Error> {
        let place = ["model", name, "file"];
        let refuse = |message: String| {
            let (key, file) = (quote::key(&place), quote::short(file));
            layers.error(&place, format!("{key} = '{file}' {message}"))
        };
        if let Some(lone) = self.lone.as_ref().filter(|lone| lone.name == file) {
            let loaded = obj::load(&lone.path, &lone.folder, self.progress, self.coordinates)?;
            return Ok(self.take(file, loaded));
        }
        let Some(found) = paths::inside(self.folder, file).map_err(refuse)? else {
            let folder = quote::path(paths::shown(self.folder));
            return Err(refuse(format!("is missing: no such file in '{folder}'")));
        };
        if let Some(parts) = self.files.get(&found.real) {
            return Ok(parts.clone());
        }
        let path = &found.path;
        if !path
            .extension()
            .is_some_and(|end| end.eq_ignore_ascii_case("obj"))
        {
            return Err(refuse("is not an .obj file".to_owned()));
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        let loaded = obj::load(path, folder, self.progress, self.coordinates)?;
        let parts = self.take(file, loaded);
        self.files.insert(found.real, parts.clone());
        Ok(parts)
    }

    /// Keeps what the OBJ `file` holds; its parts.
    fn take(&mut self, file: &str, mut loaded: ObjFile) -> Vec<Part> {
        self.warnings.append(&mut loaded.warnings);
        let alone = self.lone.is_some();
        let full = |material: &str| {
            if alone {
                material.to_owned()
            } else {
                format!("{file}:{material}")
            }
        };
        let mut parts = Vec::new();
        for piece in loaded.pieces {
            let slot = piece.material.unwrap_or_else(|| DEFAULT_NAME.to_owned());
            let own = loaded.materials.contains_key(&slot);
            parts.push(Part {
                mesh: self.meshes.len(),
                name: piece.mesh.name.clone(),
                material: if own { full(&slot) } else { slot.clone() },
                slot,
            });
            self.meshes.push(piece.mesh);
        }
        for (name, text) in loaded.materials {
            self.materials.insert(full(&name), text);
        }
        parts
    }
}

/// Refuses `materials` for parts that the model does not have.
fn check_slots(name: &str, text: &ModelText, parts: &[Part], layers: &Layers) -> Result<(), Error> {
    for slot in text.materials.iter().flat_map(IndexMap::keys) {
        if !parts.iter().any(|part| part.slot == *slot) {
            let known = parts.iter().map(|part| part.slot.as_str());
            let model = quote::key(&["model", name]);
            let message = format!("{model}: {}", suggest::unknown("part", slot, known));
            return Err(layers.error(&["model", name, "materials", slot], message));
        }
    }
    Ok(())
}

/// The part with its material: the one that `materials` gives to it, else the model's `material`,
/// else its own.
fn place(name: &str, text: &ModelText, part: Part, transform: Affine3A, alone: bool) -> Placed {
    let chosen = text.materials.as_ref().and_then(|m| m.get(&part.slot));
    let mut key = vec!["model".to_owned(), name.to_owned()];
    if chosen.is_some() {
        key.extend(["materials".to_owned(), part.slot.clone()]);
    } else {
        key.push("material".to_owned());
    }
    let chosen = chosen.or(text.material.as_ref());
    Placed {
        name: if alone {
            name.to_owned()
        } else {
            format!("{name}/{}", part.name)
        },
        mesh: part.mesh,
        material: chosen.cloned().unwrap_or(part.material),
        transform,
        key,
    }
}

/// Object to world: scaled, then turned about the fixed axes x, y, z in this order, then moved.
fn transform(name: &str, text: &ModelText, layers: &Layers) -> Result<Affine3A, Error> {
    let at = |key| ["model", name, key];
    let position = text.position.unwrap_or_default();
    let position = layers.triple(&at("position"), position, COORDINATE)?;
    let turns = text.rotation_degrees.unwrap_or_default();
    let [x, y, z] = layers
        .triple(&at("rotation_degrees"), turns, TURN)?
        .map(f32::to_radians);
    let scale = text.scale.map_or([1.0; 3], |triple| triple.0);
    let scale = layers.triple(&at("scale"), scale, SCALE)?;
    if scale.iter().any(|factor| factor.abs() < SMALLEST_SCALE) {
        let message = format!(
            "{} = {scale:?}: no factor may be nearer to 0 than {SMALLEST_SCALE:e}",
            quote::key(&at("scale"))
        );
        return Err(layers.error(&at("scale"), message));
    }
    Ok(Affine3A::from_scale_rotation_translation(
        Vec3::from_array(scale),
        // glam names the order of the matrices in a product: z y x applies x first.
        Quat::from_euler(EulerRot::ZYX, z, y, x),
        Vec3::from_array(position),
    ))
}
