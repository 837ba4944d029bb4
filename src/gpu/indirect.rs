//! How does one command draw many objects?

use std::ops::Range;
use std::sync::Arc;

use ash::vk;
use bytemuck::{Pod, Zeroable};

use super::buffer::{Buffer, BufferUse};
use super::device::Device;
use super::error::Error;

/// One object as the device reads it: VkDrawIndexedIndirectCommand.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Pod, Zeroable)]
#[repr(C)]
struct Command {
    index_count: u32,
    instance_count: u32,
    first_index: u32,
    vertex_offset: i32,
    first_instance: u32,
}

const _: () = assert!(size_of::<Command>() == size_of::<vk::DrawIndexedIndirectCommand>());

/// The bytes from one command to the next.
pub(super) const STRIDE: u32 = size_of::<Command>() as u32;

/// One object of many.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct DrawCommand {
    /// Which indices.
    pub indices: Range<u32>,
    /// What is added to each.
    pub vertex_offset: i32,
    /// Its instance.
    pub instance: u32,
}

/// Draw commands on the device.
pub struct IndirectDraws {
    pub(super) buffer: Buffer,
    pub(super) count: u32,
    /// Where the last index stands that any of them reads, plus one.
    pub(super) indices_end: u32,
}

impl IndirectDraws {
    /// Uploads draws; nobody changes them afterwards, so that what was checked holds.
    ///
    /// # Panics
    /// An object's range runs backwards, or its instance cannot be counted.
    ///
    /// # Errors
    /// The device cannot draw so, has a limit below their number, or there is no memory.
    pub fn new(device: &Arc<Device>, name: &str, draws: &[DrawCommand]) -> Result<Self, Error> {
        let limit = match device.draws_indirect() {
            true => device.limits.max_draw_indirect_count,
            false => 0,
        };
        let count = u32::try_from(draws.len()).unwrap_or(u32::MAX);
        if count > limit {
            let what = format!("the objects of one command ('{name}')");
            return Err(device.beyond(what, draws.len() as u64, u64::from(limit)));
        }
        let commands: Vec<_> = draws.iter().map(command).collect();
        let bytes = bytemuck::cast_slice(&commands);
        Ok(Self {
            buffer: Buffer::with_data(device, name, BufferUse::Indirect, bytes)?,
            count,
            indices_end: draws.iter().map(|draw| draw.indices.end).max().unwrap_or(0),
        })
    }
}

fn command(draw: &DrawCommand) -> Command {
    let DrawCommand {
        indices,
        vertex_offset,
        instance,
    } = draw;
    assert!(indices.start <= indices.end && *instance < u32::MAX);
    Command {
        index_count: indices.end - indices.start,
        instance_count: 1,
        first_index: indices.start,
        vertex_offset: *vertex_offset,
        first_instance: *instance,
    }
}
