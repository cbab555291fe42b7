use guideway_scene::Scene;

use super::kernels::Kernels;
use super::params::{Found, ROUNDS_A_LINE, Samples, TILE_PX};
use crate::device::Kernel;

/// How the tiles are painted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Paint {
    /// One opaque color: no order is needed.
    One,
    Opaque,
    Translucent,
    Density,
    /// Not colors, but which path lies on top.
    Ids,
    /// No pixels at all: marks the paths that reach into the picture.
    Touch,
}

impl Paint {
    /// What the colors of a scene make necessary.
    pub(super) fn of(scene: &Scene) -> Self {
        if !scene.is_opaque() {
            Self::Translucent
        } else if scene.common_color().is_some() {
            Self::One
        } else {
            Self::Opaque
        }
    }

    /// Times that a thread goes round its loops, at most and with some to spare, by what a frame has found.
    pub(super) fn rounds(self, found: &Found, samples: Samples) -> u64 {
        // Words of the row of samples that a thread has of a tile.
        let words = u64::from(samples.a_row() * TILE_PX / u32::BITS);
        let longest = u64::from(found.longest);
        match self {
            Self::One if found.rounds == 0 => u64::from(ROUNDS_A_LINE) * longest,
            Self::Touch => 0,
            // For each line its words, twice, and the pixels that it covers.
            Self::Ids => longest * (2 + 2 * words + u64::from(TILE_PX)),
            // Counted, for it depends on what the lines cover. A compiler may count otherwise.
            Self::One | Self::Opaque | Self::Translucent | Self::Density => {
                u64::from(found.rounds) * 5 / 4
            }
        }
    }

    /// Whether whole lists are brought into order before.
    pub(super) fn needs_order(self) -> bool {
        matches!(self, Self::Translucent | Self::Density)
    }

    pub(super) fn kernel(self, kernels: &Kernels, samples: Samples) -> &Kernel {
        let painters = kernels.painters(samples);
        match self {
            Self::One => &painters.cover,
            Self::Opaque => &painters.opaque,
            Self::Translucent => &painters.translucent,
            Self::Density => &painters.density,
            Self::Ids => &painters.ids,
            Self::Touch => &kernels.touch,
        }
    }
}
