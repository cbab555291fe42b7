//! What a frame finds: lines, and which tiles they may touch.

use guideway_scene::RenderError;
use wgpu::BufferUsages;

use super::NAME;
use super::params::{Found, LINE_WORDS};
use super::touched::KeptLines;
use crate::device::{DeviceBuffer, Gpu, Memory};

const LINE_BYTES: u64 = size_of::<[u32; LINE_WORDS]>() as u64;
const WORD_BYTES: u64 = size_of::<u32>() as u64;

/// Buffers of a fixed size: what does not fit is counted, and drawn again with more room.
pub(super) struct Room {
    pub(super) size: Size,
    pub(super) lines: DeviceBuffer,
    pub(super) line_ranks: DeviceBuffer,
    pub(super) reference_list: DeviceBuffer,
    pub(super) kept: Option<KeptLines>,
}

/// How much room there is to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Size {
    pub(super) lines: u32,
    pub(super) references: u32,
    /// Whether lines have ranks.
    pub(super) has_ranks: bool,
}

impl Size {
    /// Enough for the first look at so many strokes.
    pub(super) fn first(strokes: u32, has_ranks: bool) -> Self {
        let lines = strokes.saturating_mul(2).saturating_add(1024);
        Self {
            lines,
            references: lines.saturating_add(lines / 2),
            has_ranks,
        }
    }

    /// As much of it as there can be.
    pub(super) fn within(self, gpu: &Gpu, memory: &Memory) -> Self {
        let fit = |bytes: u64| u32::try_from(gpu.binding_bytes() / bytes).unwrap_or(u32::MAX);
        let fitted = Self {
            lines: self.lines.min(fit(LINE_BYTES)),
            references: self.references.min(fit(WORD_BYTES)),
            ..self
        };
        let share = memory.spare_bytes() as f64 / fitted.bytes() as f64;
        let scale = |n: u32| (f64::from(n) * share.min(1.0)) as u32;
        Self {
            lines: scale(fitted.lines).max(1),
            references: scale(fitted.references).max(1),
            ..self
        }
    }

    /// Enough for what was found, and some more.
    pub(super) fn for_found(self, found: &Found) -> Self {
        let grown = |room: u32, needed: u32| {
            if needed > room {
                needed.saturating_add(needed / 32)
            } else {
                room
            }
        };
        Self {
            lines: grown(self.lines, found.lines),
            references: grown(self.references, found.references),
            ..self
        }
    }

    pub(super) fn holds(self, found: &Found) -> bool {
        found.lines <= self.lines && found.references <= self.references
    }

    pub(super) fn bytes(self) -> u64 {
        u64::from(self.lines) * LINE_BYTES
            + (self.ranks() + u64::from(self.references)) * WORD_BYTES
    }

    /// Ranks that there is room for: one where there are none, for a shader has to be shown some.
    fn ranks(self) -> u64 {
        u64::from(if self.has_ranks { self.lines } else { 1 })
    }

    /// Whether a shader may see each of the buffers whole.
    pub(super) fn fits(self, gpu: &Gpu) -> bool {
        let most = gpu.binding_bytes();
        u64::from(self.lines) * LINE_BYTES <= most
            && u64::from(self.references) * WORD_BYTES <= most
    }

    /// The error for a band that is too much, though it has only one row of tiles.
    pub(super) fn refused(self, memory: &Memory) -> RenderError {
        RenderError::Budget {
            method: NAME,
            what: "the lines of one row of tiles",
            needed_bytes: memory.held_bytes() + self.bytes(),
            budget_bytes: memory.held_bytes() + memory.spare_bytes(),
        }
    }
}

impl Room {
    pub(super) fn new(memory: &mut Memory, size: Size) -> Result<Self, RenderError> {
        let storage = BufferUsages::STORAGE;
        let lines = u64::from(size.lines);
        Ok(Self {
            size,
            lines: memory.zeros("the lines", lines * LINE_BYTES, storage)?,
            line_ranks: memory.zeros("the lines", size.ranks() * WORD_BYTES, storage)?,
            reference_list: reference_list(memory, size)?,
            kept: None,
        })
    }

    /// With room for so much. Lines stay unless they need more.
    pub(super) fn grown(self, memory: &mut Memory, size: Size) -> Result<Self, RenderError> {
        if size.lines != self.size.lines {
            drop(self);
            return Self::new(memory, size);
        }
        drop(self.reference_list);
        Ok(Self {
            size,
            reference_list: reference_list(memory, size)?,
            ..self
        })
    }
}

fn reference_list(memory: &mut Memory, size: Size) -> Result<DeviceBuffer, RenderError> {
    let bytes = u64::from(size.references) * WORD_BYTES;
    memory.zeros("the lists of the tiles", bytes, BufferUsages::STORAGE)
}
