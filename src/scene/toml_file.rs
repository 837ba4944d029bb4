//! How is a scene file read?

use std::io::Read;
use std::path::Path;

use super::error::{Error, Place};
use super::layers::Layer;
use super::{LoadOptions, Scene, assembly, paths};

/// The largest scene file: a hundred thousand models of 160 characters each. Its tables take some
/// sixty times as much memory.
const LARGEST: u64 = 16 << 20;

/// Reads the scene file at `path`.
pub(super) fn load(path: &Path, options: &LoadOptions) -> Result<Scene, Error> {
    let mut bytes = Vec::new();
    paths::open(path)?
        .take(LARGEST + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| Error::io(path, &error))?;
    if bytes.len() as u64 > LARGEST {
        return Err(Error::file(
            path,
            "is larger than 16 MiB, the most that a scene file may have: put the geometry into OBJ files",
        ));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let start = error.utf8_error().valid_up_to();
        let valid = String::from_utf8_lossy(&error.as_bytes()[..start]);
        Error::File {
            place: Place::offset(path, &valid, start),
            message: "is not UTF-8 text".to_owned(),
        }
    })?;
    assembly::build(path, Layer::file(path, text)?, None, options)
}
