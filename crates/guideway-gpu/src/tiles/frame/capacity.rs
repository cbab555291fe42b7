//! Capacities of the line buffers. Kernels count beyond a capacity, and the window is drawn again
//! with larger buffers.

use guideway_scene::RenderError;

use crate::device::{Gpu, Memory};
use crate::tiles::constants::LINE_WORDS;
use crate::tiles::layouts::FrameCounters;
use crate::tiles::options::NAME;

pub(crate) const LINE_BYTES: u64 = size_of::<[u32; LINE_WORDS]>() as u64;
pub(crate) const WORD_BYTES: u64 = size_of::<u32>() as u64;

/// Lines or references that buffers grow to at once.
const MIN_GROWN: u32 = 1 << 16;

/// Number of lines and of references that fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Capacity {
    pub(crate) lines: u32,
    pub(crate) references: u32,
    /// True if lines have draw ranks.
    pub(crate) has_ranks: bool,
}

impl Capacity {
    /// An estimate for the first frame of a scene.
    pub(crate) fn of_strokes(strokes: u32, has_ranks: bool) -> Self {
        let lines = strokes.saturating_mul(2).saturating_add(1024);
        Self {
            lines,
            references: lines.saturating_add(lines / 2),
            has_ranks,
        }
    }

    /// Reduces the capacity to binding limits and the memory budget.
    pub(crate) fn within(self, gpu: &Gpu, memory: &Memory) -> Self {
        let fit = |bytes: u64| u32::try_from(gpu.max_binding_bytes() / bytes).unwrap_or(u32::MAX);
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

    /// Grows to what a window has counted, and slightly more. Two occlusion passes that overflow
    /// count too much: what the first does not draw hides nothing from the second. Then capacities
    /// double at most.
    pub(crate) fn grown_to(self, counters: &FrameCounters, uses_occlusion: bool) -> Self {
        let grown = |capacity: u32, needed: u32| {
            if needed <= capacity {
                return capacity;
            }
            let needed = needed.saturating_add(needed / 32);
            match uses_occlusion {
                true => needed.min(capacity.saturating_mul(2).max(MIN_GROWN)),
                false => needed,
            }
        };
        Self {
            lines: grown(self.lines, counters.lines),
            references: grown(self.references, counters.references),
            ..self
        }
    }

    /// Returns `true` if all that a window has counted fits.
    pub(crate) fn holds(self, counters: &FrameCounters) -> bool {
        counters.lines <= self.lines && counters.references <= self.references
    }

    /// Bytes of all buffers.
    pub(crate) fn bytes(self) -> u64 {
        u64::from(self.lines) * LINE_BYTES
            + (self.ranks() + u64::from(self.references)) * WORD_BYTES
    }

    /// Number of ranks: at least one, because a binding cannot be empty.
    pub(crate) fn ranks(self) -> u64 {
        u64::from(if self.has_ranks { self.lines } else { 1 })
    }

    /// Returns `true` if each buffer fits one binding.
    pub(crate) fn fits_bindings(self, gpu: &Gpu) -> bool {
        let limit = gpu.max_binding_bytes();
        u64::from(self.lines) * LINE_BYTES <= limit
            && u64::from(self.references) * WORD_BYTES <= limit
    }

    /// The error for a single row of tiles that exceeds the budget.
    pub(crate) fn over_budget(self, memory: &Memory) -> RenderError {
        RenderError::Budget {
            method: NAME,
            what: "the lines of one row of tiles",
            needed_bytes: memory.held_bytes() + self.bytes(),
            budget_bytes: memory.held_bytes() + memory.spare_bytes(),
        }
    }
}
