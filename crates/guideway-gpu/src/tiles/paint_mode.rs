//! Paint mode: the kernel that draws the tiles of a scene, by its colors and shading.

use guideway_scene::Scene;

use super::constants::{LOOPS_PER_LINE, Samples};
use super::kernels::Kernels;
use super::layouts::FrameCounters;
use crate::device::Kernel;

/// Selects the kernel that draws tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PaintMode {
    /// One opaque color: lines need no order.
    SingleColor,
    /// Opaque paths in many colors.
    Opaque,
    /// Some paths are translucent.
    Translucent,
    /// Paths per pixel instead of colors.
    Density,
}

impl PaintMode {
    /// The mode that the colors of a scene need.
    pub(crate) fn of(scene: &Scene) -> Self {
        if !scene.is_opaque() {
            Self::Translucent
        } else if scene.common_color().is_some() {
            Self::SingleColor
        } else {
            Self::Opaque
        }
    }

    /// Upper bound of the loop iterations of a thread, by the counters of a window.
    pub(crate) fn loops(self, counters: &FrameCounters) -> u64 {
        match self {
            Self::SingleColor => u64::from(LOOPS_PER_LINE) * u64::from(counters.longest_list),
            // The shaders count, because the number depends on the covered samples. A quarter to
            // spare: a compiler may arrange loops differently.
            Self::Opaque | Self::Translucent | Self::Density => {
                u64::from(counters.max_loops) * 5 / 4
            }
        }
    }

    /// Returns `true` if whole lists are sorted before tiles are drawn.
    pub(crate) fn sorts_lists(self) -> bool {
        matches!(self, Self::Translucent | Self::Density)
    }

    /// The kernel that draws tiles.
    pub(crate) fn kernel(self, kernels: &Kernels, samples: Samples) -> &Kernel {
        let kernels = kernels.of_tiles(samples);
        match self {
            Self::SingleColor => &kernels.cover,
            Self::Opaque => &kernels.opaque,
            Self::Translucent => &kernels.translucent,
            Self::Density => &kernels.density,
        }
    }
}
