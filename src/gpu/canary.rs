//! Do the validation layers answer at all?
//!
//! Silence proves nothing unless a known mistake breaks it. Each canary records one and throws the
//! recording away: nothing wrong ever reaches the device.

use std::sync::Arc;

use ash::vk;

use super::buffer::{Buffer, BufferUse};
use super::commands::Recorder;
use super::device::Device;
use super::error::Error;

/// A mistake that the layers must report.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Canary {
    /// Core validation: a copy that reads beyond its buffer (VUID-vkCmdCopyBuffer-size-00115).
    Core,
    /// Synchronization validation: two copies to the same place with no barrier between them
    /// (SYNC-HAZARD-WRITE-AFTER-WRITE).
    Synchronization,
}

impl Canary {
    /// Every canary.
    pub const ALL: &'static [Self] = &[Self::Core, Self::Synchronization];

    /// What kind of validation must hear it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Core => "core",
            Self::Synchronization => "synchronization",
        }
    }

    /// A part of the message that must come.
    pub fn expected(self) -> &'static str {
        match self {
            Self::Core => "VUID-vkCmdCopyBuffer-size-00115",
            Self::Synchronization => "SYNC-HAZARD-WRITE-AFTER-WRITE",
        }
    }

    /// Makes the mistake.
    ///
    /// # Errors
    /// No memory for two buffers of 16 bytes, or the driver fails.
    pub fn sing(self, device: &Arc<Device>) -> Result<(), Error> {
        let buffer = |usage| Buffer::new(device, "canary", usage, 16);
        let staging = buffer(BufferUse::Staging)?;
        let readback = buffer(BufferUse::Readback)?;
        let recorder = Recorder::new(device, "canary")?;
        match self {
            Self::Core => recorder.copy_without_checks(&staging, &readback, 32),
            Self::Synchronization => {
                recorder.copy_without_checks(&staging, &readback, 16);
                recorder.copy_without_checks(&staging, &readback, 16);
            }
        }
        Ok(())
    }
}

impl Recorder<'_> {
    /// What `copy_buffer` is without its checks and its barrier. Not to be submitted.
    fn copy_without_checks(&self, from: &Buffer, to: &Buffer, bytes: u64) {
        let region = vk::BufferCopy::default().size(bytes);
        // SAFETY: recorded and thrown away; the buffers outlive the recorder.
        unsafe {
            self.device
                .raw
                .cmd_copy_buffer(self.commands, from.raw, to.raw, &[region]);
        }
    }
}
