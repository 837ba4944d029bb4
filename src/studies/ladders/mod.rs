//! How far is each tier from the truth that it stands for?
//!
//! Matte bases are held against Oren and Nayar's V-cavities, facets against the Smith microsurface of their slopes, both with every
//! bounce; Fresnel terms against Fresnel's equations, of metals integrated over wavelength.

mod diffuse;
mod fit;
mod fresnel;
mod specular;

use std::path::Path;

use crate::report::ModelRow;
use crate::studies::Cache;

/// Truths of the plan, for a bar.
pub const TRUTHS: u64 = diffuse::TRUTHS + specular::TRUTHS;
/// Draws the paths of all truths.
pub const SEED: u64 = 1;
/// Steps of a truth.
pub use crate::reference::truth::STEPS;

/// Paths of each angle of the light: 0.3 % of statistical error.
pub const PATHS: usize = 1 << 17;

/// All rows. Truths of so many paths come from `cache`, or are made and kept there. `progress` hears of each step.
pub fn errors(cache: &Cache, paths: usize, progress: &(dyn Fn(u64) + Sync)) -> Vec<ModelRow> {
    let mut rows = diffuse::rows(cache, paths, progress);
    rows.extend(specular::rows(cache, paths, progress));
    rows.extend(fresnel::rows());
    rows
}

/// The folder of truths in a folder of caches.
pub fn folder(caches: &Path) -> std::path::PathBuf {
    caches.join("truths")
}
