//! May a file that a scene or an OBJ names be opened: is it there, plain, and inside the folder?

use std::fs::File;
use std::path::{Component, Path, PathBuf};

use super::error::Error;

/// What stands before the text of some UTF-8 files.
pub(super) const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// A file that may be opened.
pub(super) struct Found {
    /// As the user and the file write it: for messages.
    pub path: PathBuf,
    /// Without links: one for each file, however it is named.
    pub real: PathBuf,
}

/// The file `name` in `folder`: None where there is none. Absolute paths, `..` and links that lead
/// out of the folder are refused: a scene from a stranger must not read the user's other files.
pub(super) fn inside(folder: &Path, name: &str) -> Result<Option<Found>, String> {
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
    let path = folder.join(relative);
    let (Ok(real_folder), Ok(real)) = (shown(folder).canonicalize(), path.canonicalize()) else {
        return Ok(None);
    };
    if real.starts_with(real_folder) {
        Ok(Some(Found { path, real }))
    } else {
        Err("is a link that leads out of the folder: copy the file into it".to_owned())
    }
}

/// A folder by a name that the system knows: `.` for the current one, which as the parent of a bare
/// file name is empty.
pub(super) fn shown(folder: &Path) -> &Path {
    if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_current_folder_has_a_name_and_its_files_keep_theirs() {
        assert_eq!(shown(Path::new("")), Path::new("."));
        assert_eq!(shown(Path::new("a")), Path::new("a"));
        // Tests run in the folder of the package.
        let found = inside(Path::new(""), "Cargo.toml");
        let path = found.map(|found| found.map(|found| found.path));
        assert_eq!(path, Ok(Some(PathBuf::from("Cargo.toml"))));
    }
}
