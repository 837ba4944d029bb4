//! How is a scene file read?

use std::io::Read;
use std::path::Path;

use super::error::{Error, Place};
use super::layers::Layer;
use super::{LoadOptions, Scene, assembly, paths};

/// The largest scene file: a million models of a line each.
const LARGEST: u64 = 256 << 20;

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
            "is larger than 256 MiB: not a scene file",
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
    assembly::build(path, Layer::file(path, text)?, false, options)
}
