//! How do many pieces of host data become one buffer on the device?

use std::sync::Arc;

use super::buffer::{Buffer, BufferUse};
use super::commands::Recorder;
use super::device::Device;
use super::error::Error;

/// The largest staging buffer: big enough that a copy is bandwidth and not overhead, small enough
/// that a scene of gigabytes is never in memory twice over.
pub(super) const STAGING_BYTES: u64 = 32 << 20;

/// Fills a buffer from its start to its end, piece by piece.
pub struct Upload {
    device: Arc<Device>,
    buffer: Buffer,
    staging: Buffer,
    staged: u64,
    copied: u64,
}

impl Upload {
    /// A new buffer of `bytes`, to be filled by exactly that much. A buffer of no bytes gets 16,
    /// and they are zero: a binding must be valid even if nothing reads it.
    ///
    /// # Errors
    /// Beyond the device's limits, or no memory.
    pub fn new(
        device: &Arc<Device>,
        name: &str,
        usage: BufferUse,
        bytes: u64,
    ) -> Result<Self, Error> {
        let buffer = Buffer::new(device, name, usage, bytes.max(16))?;
        let chunk = buffer.bytes().min(STAGING_BYTES);
        let staging_name = format!("{name}: staging");
        let staging = Buffer::new(device, &staging_name, BufferUse::Staging, chunk)?;
        Ok(Self {
            device: Arc::clone(device),
            buffer,
            staging,
            staged: 0,
            copied: 0,
        })
    }

    /// Appends `data`.
    ///
    /// # Errors
    /// A failed copy.
    pub fn write(&mut self, mut data: &[u8]) -> Result<(), Error> {
        while !data.is_empty() {
            let room = usize::try_from(self.staging.bytes() - self.staged).unwrap_or(usize::MAX);
            let (now, later) = data.split_at(data.len().min(room));
            self.staging.write(self.staged, now)?;
            self.staged += now.len() as u64;
            data = later;
            if self.staged == self.staging.bytes() {
                self.flush()?;
            }
        }
        Ok(())
    }

    /// The filled buffer; what was not written is zero.
    ///
    /// # Errors
    /// A failed copy.
    pub fn finish(mut self) -> Result<Buffer, Error> {
        const ZEROS: [u8; 16] = [0; 16];
        while self.copied + self.staged < self.buffer.bytes() {
            let left = self.buffer.bytes() - self.copied - self.staged;
            self.write(&ZEROS[..left.min(16) as usize])?;
        }
        self.flush()?;
        Ok(self.buffer)
    }

    fn flush(&mut self) -> Result<(), Error> {
        if self.staged == 0 {
            return Ok(());
        }
        let mut recorder = Recorder::new(&self.device, "upload")?;
        recorder.copy_buffer(&self.staging, &mut self.buffer, self.copied, self.staged);
        recorder.submit()?;
        self.copied += self.staged;
        self.staged = 0;
        Ok(())
    }
}
