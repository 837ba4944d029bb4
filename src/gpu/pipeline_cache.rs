//! What did earlier runs compile, so that this one need not?
//!
//! One file a device and driver in the user's cache folder. The file is treated as hostile: a
//! driver that trusts its header could be led astray by a damaged body, so the file carries a
//! checksum of its own, and anything that does not fit is dropped and made again.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ash::vk;

use super::device::{CacheKey, Device};
use super::error::{Error, Named};
use crate::math::fnv::fnv1a;

/// Larger files are not read: pipelines of this project take a few hundred KiB.
const MAX_BYTES: u64 = 256 << 20;
const MAGIC: &[u8; 8] = b"umberPC1";

/// A pipeline cache, optionally kept in a file.
pub struct PipelineCache {
    /// Drivers synchronise its use by themselves.
    pub(super) raw: vk::PipelineCache,
    file: Option<PathBuf>,
    loaded: usize,
    device: Arc<Device>,
}

impl PipelineCache {
    /// A cache filled from `folder`, where there is one and its file fits this device and driver.
    ///
    /// # Errors
    /// The driver fails. A missing or damaged file is no error.
    pub fn open(device: &Arc<Device>, folder: Option<&Path>) -> Result<Self, Error> {
        let file = folder.map(|folder| folder.join(file_name(&device.cache_key)));
        let content = file.as_deref().and_then(read).unwrap_or_default();
        // A driver that refuses what an earlier version of it wrote starts from nothing.
        let (raw, loaded) = match create(device, &content) {
            Ok(raw) => (raw, content.len()),
            Err(_) => (create(device, &[]).named("vkCreatePipelineCache")?, 0),
        };
        device.name(raw, "pipeline cache");
        Ok(Self {
            raw,
            file,
            loaded,
            device: Arc::clone(device),
        })
    }

    pub(super) fn is_of(&self, device: &Arc<Device>) -> bool {
        Arc::ptr_eq(&self.device, device)
    }

    /// Writes the cache back, whole or not at all, where its content changed in size. A cache that
    /// cannot be kept costs time at the next start and nothing else, so no error is reported.
    pub fn save(&self) {
        let Some(file) = &self.file else { return };
        // SAFETY: the cache lives, and reading it is synchronised by the driver.
        let content = unsafe { self.device.raw.get_pipeline_cache_data(self.raw) };
        if let Ok(content) = content
            && content.len() != self.loaded
        {
            // See above: a failed write is a slower next start.
            let _ = write(file, &content);
        }
    }
}

impl Drop for PipelineCache {
    fn drop(&mut self) {
        // SAFETY: pipelines do not need the cache once they exist, and nobody else has it.
        unsafe { self.device.raw.destroy_pipeline_cache(self.raw, None) };
    }
}

fn create(device: &Device, content: &[u8]) -> Result<vk::PipelineCache, vk::Result> {
    let info = vk::PipelineCacheCreateInfo::default().initial_data(content);
    // SAFETY: the data is empty or passed its checksum, so that a driver of this device wrote it.
    unsafe { device.raw.create_pipeline_cache(&info, None) }
}

fn file_name(key: &CacheKey) -> String {
    let uuid: String = key.uuid.iter().map(|byte| format!("{byte:02x}")).collect();
    format!("pipelines-{:04x}-{:04x}-{uuid}.bin", key.vendor, key.device)
}

/// The content of a cache file, or nothing where it is absent, too large or damaged.
fn read(file: &Path) -> Option<Vec<u8>> {
    if std::fs::metadata(file).ok()?.len() > MAX_BYTES {
        return None;
    }
    let bytes = std::fs::read(file).ok()?;
    let rest = bytes.strip_prefix(MAGIC)?;
    let (checksum, content) = rest.split_first_chunk::<8>()?;
    (u64::from_le_bytes(*checksum) == fnv1a(content.iter().copied())).then(|| content.to_vec())
}

fn write(file: &Path, content: &[u8]) -> std::io::Result<()> {
    let folder = file.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)?;
    let mut beside = tempfile::NamedTempFile::new_in(folder)?;
    beside.write_all(MAGIC)?;
    beside.write_all(&fnv1a(content.iter().copied()).to_le_bytes())?;
    beside.write_all(content)?;
    beside.persist(file)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_and_damage_is_found() -> std::io::Result<()> {
        let folder = tempfile::tempdir()?;
        let file = folder.path().join("sub").join("cache.bin");
        let content: Vec<u8> = (0..=255).collect();
        write(&file, &content)?;
        assert_eq!(read(&file), Some(content));
        let good = std::fs::read(&file)?;
        for damaged in [&good[..20], &good[1..], &[][..]] {
            std::fs::write(&file, damaged)?;
            assert_eq!(read(&file), None, "{} bytes", damaged.len());
        }
        let mut flipped = good;
        flipped[100] ^= 1;
        std::fs::write(&file, flipped)?;
        assert_eq!(read(&file), None);
        assert_eq!(read(&folder.path().join("absent")), None);
        Ok(())
    }
}
