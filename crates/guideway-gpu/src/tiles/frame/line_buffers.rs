//! Buffers of lines and of the tile lists that refer to them.

use guideway_scene::RenderError;
use wgpu::BufferUsages;

use super::capacity::{Capacity, LINE_BYTES, WORD_BYTES};
use crate::device::{DeviceBuffer, Memory};

/// Lines, their draw ranks, and the references of all tile lists.
pub(crate) struct LineBuffers {
    pub(crate) capacity: Capacity,
    pub(crate) lines: DeviceBuffer,
    pub(crate) line_ranks: DeviceBuffer,
    pub(crate) references: DeviceBuffer,
}

impl LineBuffers {
    pub(crate) fn new(memory: &mut Memory, capacity: Capacity) -> Result<Self, RenderError> {
        let storage = BufferUsages::STORAGE;
        let lines = u64::from(capacity.lines);
        Ok(Self {
            capacity,
            lines: memory.zeros("the lines", lines * LINE_BYTES, storage)?,
            line_ranks: memory.zeros("the lines", capacity.ranks() * WORD_BYTES, storage)?,
            references: references(memory, capacity)?,
        })
    }

    /// Replaces the buffers by larger ones. Lines stay if their capacity does.
    pub(crate) fn grown(
        self,
        memory: &mut Memory,
        capacity: Capacity,
    ) -> Result<Self, RenderError> {
        if capacity.lines != self.capacity.lines {
            drop(self);
            return Self::new(memory, capacity);
        }
        drop(self.references);
        Ok(Self {
            capacity,
            references: references(memory, capacity)?,
            ..self
        })
    }
}

fn references(memory: &mut Memory, capacity: Capacity) -> Result<DeviceBuffer, RenderError> {
    let bytes = u64::from(capacity.references) * WORD_BYTES;
    memory.zeros("the lists of the tiles", bytes, BufferUsages::STORAGE)
}
