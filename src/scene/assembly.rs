//! How does a description with its layers become a scene?
//!
//! From below: the material library, the materials of MTL files, the framing (camera and lights for
//! a scene without them), the scene's text, each `--set`. Models come first, since MTL files and the
//! framing depend on them.

use std::path::Path;

use indexmap::IndexMap;

use super::description::Description;
use super::error::Error;
use super::layers::{Layer, Layers};
use super::lights::{self, MAX_LIGHTS};
use super::materials::{self, Material, Palette};
use super::mesh::{Bounds, Mesh};
use super::models::{Loader, Lone, Placed};
use super::normals::TooManyVertices;
use super::overrides::Override;
use super::texture_loader::TextureLoader;
use super::{
    LoadOptions, Object, Scene, box_projection, camera, framing, quote, suggest, tangents,
};

/// The scene that `text` describes, a layer of the file `path`. `lone` for an OBJ file by itself.
pub(super) fn build(
    path: &Path,
    text: Layer,
    lone: Option<Lone>,
    options: &LoadOptions,
) -> Result<Scene, Error> {
    let overrides: Vec<Override> = options
        .overrides
        .iter()
        .map(|text| Override::parse(text))
        .collect::<Result<_, _>>()?;
    let mut own = Layers::new(path);
    own.push(text);
    let written = own.merged()?;
    for change in &overrides {
        change.check("model", written.model.keys().map(String::as_str))?;
    }
    for change in overrides.iter().map(|change| &change.layer) {
        own.push(change.clone());
    }
    let wanted = own.merged()?;

    let folder = match &lone {
        Some(lone) => lone.folder.clone(),
        None => path.parent().unwrap_or(Path::new("")).to_path_buf(),
    };
    let mut loader = Loader::new(&folder, lone, options.progress);
    let placed = loader.load(&wanted, &own)?;
    let bounds = bounds(&loader, &placed, &own)?;

    let mut base = library()?;
    base.material.extend(std::mem::take(&mut loader.materials));
    let lit = !written.light.is_empty() || written.ambient.is_some();
    let framed = framing::defaults(bounds, wanted.camera.as_ref(), lit, options.ratio())
        .map_err(|message| own.error(&["model"], message))?;
    check_names(&overrides, &base, &written, &framed)?;

    let mut all = Layers::new(path);
    all.push(Layer::made(&framed));
    all.append(own);
    let description = all.merged()?;
    let palette = Palette::new(base, wanted);
    finish(loader, placed, &description, &palette, &all)
}

/// The built-in materials, checked, in the library's order.
///
/// # Errors
/// None in a build that passes its tests: the library is the program's own.
pub fn built_in_materials() -> Result<Vec<Material>, Error> {
    let description = library()?;
    let names: Vec<_> = description.material.keys().cloned().collect();
    let palette = Palette::new(description, Description::default());
    let layers = Layers::new(Path::new("library.toml"));
    names
        .iter()
        .map(|name| palette.build(name, &layers))
        .collect()
}

/// The built-in materials as text.
fn library() -> Result<Description, Error> {
    let path = Path::new("library.toml");
    let mut layers = Layers::new(path);
    layers.push(Layer::file(path, materials::LIBRARY.to_owned())?);
    layers.merged()
}

/// Refuses overrides of lights and materials that the scene does not have.
fn check_names(
    overrides: &[Override],
    base: &Description,
    written: &Description,
    framed: &Description,
) -> Result<(), Error> {
    let lights = written.light.keys().chain(framed.light.keys());
    let materials = written.material.keys().chain(base.material.keys());
    for change in overrides {
        change.check("light", lights.clone().map(String::as_str))?;
        change.check("material", materials.clone().map(String::as_str))?;
    }
    Ok(())
}

/// The box around all placed meshes.
fn bounds(loader: &Loader<'_>, placed: &[Placed], layers: &Layers) -> Result<Bounds, Error> {
    let placed = placed.iter().map(|part| (part.mesh, &part.transform));
    let all = Bounds::around(&loader.meshes, placed);
    if all.radius().is_finite() {
        Ok(all)
    } else {
        Err(layers.error(&["model"], "the models are too large or too far away"))
    }
}

fn finish(
    loader: Loader<'_>,
    placed: Vec<Placed>,
    description: &Description,
    palette: &Palette,
    layers: &Layers,
) -> Result<Scene, Error> {
    if description.light.len() > MAX_LIGHTS {
        let message = format!(
            "{} lights: at most {MAX_LIGHTS} are possible",
            description.light.len()
        );
        return Err(layers.error(&["light"], message));
    }
    let mut lights = Vec::with_capacity(description.light.len());
    for (name, text) in &description.light {
        lights.push(lights::build(name, text, layers)?);
    }
    // All of the scene's own materials are checked, used or not.
    let mut textures = TextureLoader::new(loader.folder);
    for name in palette.scene_names() {
        palette.build(name, layers)?;
        textures.check(name, &palette.maps(name, layers)?, layers)?;
    }
    let (objects, materials) = dress(placed, palette, &mut textures, layers)?;
    let mut warnings = loader.warnings;
    warnings.extend(textures.warnings.into_text());
    warnings.extend(lights.iter().filter_map(lights::Light::told_if_dark));
    let camera = description.camera.clone().unwrap_or_default();
    let ambient = description.ambient.clone().unwrap_or_default();
    let mut meshes = loader.meshes;
    lay_textures(&mut meshes, &objects, &materials, layers)?;
    Ok(Scene {
        camera: camera::build(&camera, layers)?,
        ambient: lights::build_ambient(&ambient, layers)?,
        lights,
        materials,
        meshes,
        textures: textures.textures,
        objects,
        warnings,
    })
}

/// Gives meshes what the pictures of their objects need, coordinates and tangents, and takes away
/// what none needs.
fn lay_textures(
    meshes: &mut [Mesh],
    objects: &[Object],
    materials: &[Material],
    layers: &Layers,
) -> Result<(), Error> {
    let mut needs = vec![(false, false); meshes.len()];
    for object in objects {
        let maps = &materials[object.material].maps;
        let (any, normal) = &mut needs[object.mesh];
        *any |= !maps.is_empty();
        *normal |= maps.normal.is_some();
    }
    for (mesh, (any, normal)) in meshes.iter_mut().zip(needs) {
        let done = match (any, mesh.coordinates.is_empty()) {
            (true, true) => box_projection::project(mesh),
            (true, false) => Ok(()),
            (false, _) => {
                mesh.coordinates = Vec::new();
                Ok(())
            }
        };
        let done = done.and_then(|()| if normal { tangents::make(mesh) } else { Ok(()) });
        done.map_err(|TooManyVertices| {
            let name = quote::short(&mesh.name);
            let message = format!(
                "'{name}' has more than 4294967295 vertices where its pictures meet: split the mesh"
            );
            layers.error(&["model"], message)
        })?;
    }
    Ok(())
}

/// Objects with their materials; only materials in use are kept, in the order of first use.
fn dress(
    placed: Vec<Placed>,
    palette: &Palette,
    textures: &mut TextureLoader,
    layers: &Layers,
) -> Result<(Vec<Object>, Vec<Material>), Error> {
    let mut used: IndexMap<String, Material> = IndexMap::new();
    let mut objects = Vec::with_capacity(placed.len());
    for part in placed {
        let material = match used.get_index_of(&part.material) {
            Some(number) => number,
            None => {
                let name = &part.material;
                if !palette.contains(name) {
                    let key: Vec<&str> = part.key.iter().map(String::as_str).collect();
                    let message = suggest::unknown("material", name, palette.names());
                    return Err(layers.error(&key, format!("{}: {message}", quote::key(&key))));
                }
                let mut built = palette.build(name, layers)?;
                let maps = palette.maps(name, layers)?;
                textures.dress(&mut built.maps, name, &maps, layers)?;
                used.insert_full(part.material, built).0
            }
        };
        objects.push(Object {
            name: part.name,
            mesh: part.mesh,
            material,
            transform: part.transform,
        });
    }
    Ok((objects, used.into_values().collect()))
}
