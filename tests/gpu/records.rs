//! What did this driver do where drivers may differ? Kept for a reader, asserted by nobody.
//!
//! Rows go to `target/records/WHAT-DRIVER.json`, so that a green run leaves them too.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde_json::{Map, Value, json};

use crate::harness::Gpu;

/// Tests are threads of one process, and several add to one file.
static WRITING: Mutex<()> = Mutex::new(());

/// A folder beside the build, made where it is missing.
pub fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name(name);
    if let Err(error) = std::fs::create_dir_all(&folder) {
        panic!("{}: {error}", folder.display());
    }
    folder
}

/// Puts a row of counts into the file of `what` and this driver, in place of an older one of that
/// name, and prints it.
pub fn record(gpu: &Gpu, what: &str, row: &str, counts: &[(&str, usize)]) {
    let _one_at_a_time = WRITING.lock().unwrap_or_else(PoisonError::into_inner);
    let info = gpu.device.info();
    let driver: String = info
        .driver
        .chars()
        .map(|c| {
            if c.is_ascii_alphanumeric() {
                c.to_ascii_lowercase()
            } else {
                '-'
            }
        })
        .collect();
    let path = folder("records").join(format!("{what}-{driver}.json"));
    let old = std::fs::read(&path).ok();
    let old: Option<Value> = old.and_then(|bytes| serde_json::from_slice(&bytes).ok());
    let mut rows = match old.and_then(|mut old| old.get_mut("rows").map(Value::take)) {
        Some(Value::Object(rows)) => rows,
        _ => Map::new(),
    };
    let counts: Map<_, _> = counts
        .iter()
        .map(|(key, n)| ((*key).into(), json!(n)))
        .collect();
    println!("{row} on {}: {counts:?}; see {}", info.name, path.display());
    rows.insert(row.into(), counts.into());
    let text = json!({
        "schema": "umber.record/1",
        "device": info.name,
        "driver": info.driver,
        "driver_version": info.driver_version,
        "rows": rows,
    });
    if let Err(error) = std::fs::write(&path, format!("{text:#}\n")) {
        panic!("{}: {error}", path.display());
    }
}
