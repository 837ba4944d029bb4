//! May a file that a scene or an OBJ names be opened: is it there, plain, and inside the folder?

use std::fs::File;
use std::path::{Component, Path, PathBuf};

use super::error::Error;

/// The file `name` in `folder`: None where there is none. Absolute paths, `..` and links that lead
/// out of the folder are refused: a scene from a stranger must not read the user's other files.
pub(super) fn inside(folder: &Path, name: &str) -> Result<Option<PathBuf>, String> {
    if name.is_empty() {
        return Err("the name is empty".to_owned());
    }
    let relative = Path::new(name);
    let plain = |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
    if !relative.components().all(plain) || name.contains('\0') {
        return Err(
            "leads out of the folder: give a path inside the folder, without '..'".to_owned(),
        );
    }
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    let path = folder.join(relative);
    let (Ok(real_folder), Ok(real)) = (folder.canonicalize(), path.canonicalize()) else {
        return Ok(None);
    };
    if real.starts_with(real_folder) {
        Ok(Some(path))
    } else {
        Err("is a link that leads out of the folder: copy the file into it".to_owned())
    }
}

/// Opens a plain file; a folder, a pipe or a device is refused by name.
pub(super) fn open(path: &Path) -> Result<File, Error> {
    let kind = std::fs::metadata(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => Error::file(path, "there is no such file"),
        _ => Error::io(path, &error),
    })?;
    if kind.is_dir() {
        return Err(Error::file(path, "is a folder: name a file in it"));
    }
    if !kind.is_file() {
        return Err(Error::file(path, "is not a plain file"));
    }
    File::open(path).map_err(|error| Error::io(path, &error))
}
