//! Which drivers has the system told the Vulkan loader of?

use std::path::{Path, PathBuf};

/// The folders where Linux loaders look for drivers (Vulkan loader, "Linux driver discovery").
const FOLDERS: &[&str] = &[
    "/usr/local/etc/vulkan/icd.d",
    "/usr/local/share/vulkan/icd.d",
    "/etc/vulkan/icd.d",
    "/usr/share/vulkan/icd.d",
];

/// The driver files in those folders and in the user's own, sorted within each.
pub fn driver_files() -> Vec<PathBuf> {
    let own = dirs::data_dir().map(|folder| folder.join("vulkan/icd.d"));
    FOLDERS
        .iter()
        .map(PathBuf::from)
        .chain(own)
        .flat_map(|folder| json_files(&folder))
        .collect()
}

fn json_files(folder: &Path) -> Vec<PathBuf> {
    // A folder that is not there holds no files.
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "json"))
        .collect();
    files.sort();
    files
}
