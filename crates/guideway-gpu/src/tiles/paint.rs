use guideway_scene::Scene;

use super::kernels::Kernels;
use super::params::{Found, ROUNDS_A_LINE, Samples};
use crate::device::Kernel;

/// How the tiles are painted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Paint {
    /// One opaque color: no order is needed.
    One,
    Opaque,
    Translucent,
    Density,
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
    pub(super) fn rounds(self, found: &Found) -> u64 {
        match self {
            Self::One if found.rounds == 0 => u64::from(ROUNDS_A_LINE) * u64::from(found.longest),
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
        }
    }
}
