//! How does an OBJ file alone become a scene?
//!
//! As a scene with one model and nothing else: framing and default lights do the rest, and `--set`
//! reaches `camera`, `ambient`, the lights `key`, `fill` and `rim`, the model, and the materials of
//! its MTL by their names.

use std::path::{Path, PathBuf};

use indexmap::IndexMap;

use super::description::{Description, ModelText};
use super::error::Error;
use super::layers::Layer;
use super::models::Lone;
use super::{LoadOptions, Scene, assembly, paths};

/// Reads the OBJ file at `path` as a scene.
pub(super) fn load(path: &Path, options: &LoadOptions) -> Result<Scene, Error> {
    // Says what is wrong with the path itself before the scene's own rules about names.
    paths::open(path)?;
    let (Some(stem), Some(file)) = (
        path.file_stem().and_then(|name| name.to_str()),
        path.file_name().and_then(|name| name.to_str()),
    ) else {
        return Err(Error::file(path, "has a name that is not UTF-8: rename it"));
    };
    let model = ModelText {
        file: Some(file.to_owned()),
        ..ModelText::default()
    };
    let description = Description {
        model: IndexMap::from([(stem.to_owned(), model)]),
        ..Description::default()
    };
    let lone = Lone {
        name: file.to_owned(),
        path: path.to_path_buf(),
        folder: folder(path)?,
    };
    assembly::build(path, Layer::made(&description), Some(lone), options)
}

/// The folder in which the file lies; of a link, the folder in which its target lies.
fn folder(path: &Path) -> Result<PathBuf, Error> {
    let parent = |path: &Path| path.parent().unwrap_or(Path::new("")).to_path_buf();
    if !path.is_symlink() {
        return Ok(parent(path));
    }
    match path.canonicalize() {
        Ok(real) => Ok(parent(&real)),
        Err(error) => Err(Error::io(path, &error)),
    }
}
