//! What do facets lose that reflect once, as a table that shaders read?

use std::path::Path;

use super::kept::Cache;
use crate::reference::kulla_conty::{COLUMNS, NUMBERS, ROWS, TABLE};

/// The table, from the folder of caches where it is kept there.
pub fn table(caches: Option<&Path>) -> Vec<f32> {
    let parameters = format!("{ROWS} rows, {COLUMNS} columns");
    // What is damaged is made anew in a moment: nobody need hear of it.
    let cache = Cache::new(caches, |_| {});
    let table: Vec<f32> = cache.get("ggx-missing", &parameters, || TABLE.values().to_vec());
    match table.len() {
        NUMBERS => table,
        _ => TABLE.values().to_vec(),
    }
}

/// As many zeros, where nobody reads it.
pub fn nothing() -> Vec<f32> {
    vec![0.0; NUMBERS]
}
