//! Which GLSL files does the program carry, so that it can export them without the source tree?

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::include::directive;
use super::{Error, file_error};

/// Folders whose files are carried, with all that they include.
const FOLDERS: [&str; 2] = ["brdf", "compensated"];

/// The text of `sources.rs`: a constant of paths and texts, in the order of the paths.
///
/// # Errors
///
/// A file that is unreadable, or a path that leads nowhere.
pub fn rust(folder: &Path) -> Result<String, Error> {
    let mut files = BTreeMap::new();
    for name in FOLDERS {
        for path in glsl_in(folder, name)? {
            add(folder, &path, &mut files)?;
        }
    }
    let mut text = String::from(
        "/// Paths in the shader folder, and the files' texts.\npub const SOURCES: &[(&str, &str)] = &[\n",
    );
    for (path, source) in &files {
        text.push_str(&format!("    ({path:?}, {source:?}),\n"));
    }
    text.push_str("];\n");
    Ok(text)
}

/// The GLSL files of a folder of the shader folder; none where there is no such folder.
fn glsl_in(folder: &Path, name: &str) -> Result<Vec<String>, Error> {
    let inside = folder.join(name);
    if !inside.is_dir() {
        return Ok(Vec::new());
    }
    let unreadable = |error: std::io::Error| file_error(&inside, error.to_string());
    let mut paths = Vec::new();
    for item in fs::read_dir(&inside).map_err(unreadable)? {
        let file = item.map_err(unreadable)?.file_name();
        let file = file.to_string_lossy();
        if file.ends_with(".glsl") {
            paths.push(format!("{name}/{file}"));
        }
    }
    Ok(paths)
}

/// Adds a file and those that it includes.
fn add(folder: &Path, path: &str, files: &mut BTreeMap<String, String>) -> Result<(), Error> {
    if files.contains_key(path) {
        return Ok(());
    }
    let full = folder.join(path);
    let text = fs::read_to_string(&full).map_err(|error| file_error(&full, error.to_string()))?;
    files.insert(path.to_owned(), text.clone());
    for line in text.lines() {
        let found = directive(line).map_err(|why| file_error(&full, why))?;
        if let Some(included) = found {
            add(folder, included, files)?;
        }
    }
    Ok(())
}
