//! How is what takes long to compute made once, and kept whole or not at all?

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::math::fnv::fnv1a;
use crate::render::OutputFile;

/// Changes with what is computed: what another version kept is made anew.
const VERSION: u32 = 1;

/// Results of the same version and parameters, on disk.
pub struct Cache {
    /// Where; nothing is kept without.
    folder: Option<PathBuf>,
    /// Told of what cannot be used.
    told: Box<dyn Fn(&str) + Sync>,
}

/// A file.
#[derive(Serialize, Deserialize)]
struct Kept {
    version: u32,
    parameters: String,
    /// FNV-1a of `data`.
    checksum: u64,
    /// JSON.
    data: String,
}

impl Cache {
    /// A cache in a folder, which is made when it is needed.
    pub fn new(folder: Option<&Path>, told: impl Fn(&str) + Sync + 'static) -> Self {
        Self {
            folder: folder.map(Path::to_owned),
            told: Box::new(told),
        }
    }

    /// What is kept under a name and its parameters; else it is made, and kept if that can be.
    pub fn get<T: Serialize + DeserializeOwned>(
        &self,
        name: &str,
        parameters: &str,
        make: impl FnOnce() -> T,
    ) -> T {
        let Some(folder) = &self.folder else {
            return make();
        };
        let path = folder.join(name).with_added_extension("json");
        match read(&path, parameters) {
            Ok(Some(value)) => return value,
            Ok(None) => {}
            Err(why) => (self.told)(&format!("{}: {why}: made anew", path.display())),
        }
        let value = make();
        if let Err(why) = write(&path, parameters, &value) {
            (self.told)(&format!("{}: not kept: {why}", path.display()));
        }
        value
    }
}

/// Nothing where there is no file.
fn read<T: DeserializeOwned>(path: &Path, parameters: &str) -> Result<Option<T>, String> {
    let bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error.to_string()),
    };
    let kept: Kept = serde_json::from_slice(&bytes).map_err(|_| "it is damaged or cut short")?;
    if kept.version != VERSION {
        return Err(format!("it is of version {}, not {VERSION}", kept.version));
    }
    if kept.parameters != parameters {
        return Err(format!("it is of {}, not of {parameters}", kept.parameters));
    }
    if fnv1a(kept.data.bytes()) != kept.checksum {
        return Err("its checksum is wrong".to_owned());
    }
    let value = serde_json::from_str(&kept.data).map_err(|error| error.to_string())?;
    Ok(Some(value))
}

fn write<T: Serialize>(path: &Path, parameters: &str, value: &T) -> std::io::Result<()> {
    let data = serde_json::to_string(value)?;
    let kept = Kept {
        version: VERSION,
        parameters: parameters.to_owned(),
        checksum: fnv1a(data.bytes()),
        data,
    };
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    OutputFile::create(path)?.commit(&serde_json::to_vec(&kept)?)
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex};

    use super::*;

    /// A cache in a folder of its own, and what it told.
    fn cache(folder: &Path) -> (Cache, Arc<Mutex<Vec<String>>>) {
        let heard = Arc::new(Mutex::new(Vec::new()));
        let told = Arc::clone(&heard);
        let cache = Cache::new(Some(folder), move |text| {
            told.lock().expect("no panic").push(text.to_owned());
        });
        (cache, heard)
    }

    #[test]
    fn what_was_made_once_is_not_made_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let (cache, heard) = cache(folder.path());
        let first: Vec<f64> = cache.get("a", "x = 1", || vec![0.1, 1.0 / 3.0]);
        let second: Vec<f64> = cache.get("a", "x = 1", || panic!("made twice"));
        assert_eq!(first, second);
        assert!(heard.lock().expect("no panic").is_empty());
    }

    #[test]
    fn what_is_damaged_cut_short_or_another_is_made_anew_and_told() {
        let folder = tempfile::tempdir().expect("a folder");
        let (cache, heard) = cache(folder.path());
        let path = folder.path().join("a.json");
        let make = |value: f64| cache.get("a", "x = 1", || vec![value]);
        make(1.0);
        let whole = std::fs::read_to_string(&path).expect("a file");
        let damages = [
            (whole[..whole.len() / 2].to_owned(), "cut short"),
            (whole.replace("[1.0]", "[2.0]"), "checksum"),
            (whole.replace("\"version\":1", "\"version\":0"), "version 0"),
            (whole.replace("x = 1", "x = 2"), "x = 2"),
            (String::new(), "cut short"),
        ];
        for (damaged, why) in damages {
            assert_ne!(damaged, whole, "{why}");
            std::fs::write(&path, damaged).expect("written");
            assert_eq!(make(3.0), [3.0], "{why}");
            let last = heard.lock().expect("no panic").pop().expect("told");
            assert!(last.contains(why) && last.contains("made anew"), "{last}");
            std::fs::write(&path, &whole).expect("written");
            assert_eq!(make(4.0), [1.0], "{why}");
        }
    }

    #[test]
    fn where_nothing_can_be_kept_it_is_made_all_the_same() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("file");
        std::fs::write(&file, "").expect("written");
        let (cache, heard) = cache(&file);
        assert_eq!(cache.get("a", "", || 7), 7);
        let told = heard.lock().expect("no panic");
        assert!(
            told.iter().any(|text| text.contains("not kept")),
            "{told:?}"
        );
    }
}
