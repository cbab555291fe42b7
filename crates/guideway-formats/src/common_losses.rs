//! Losses of every format but the model itself: the losses that a writer starts its list with.

use guideway_layout::Layout;

use crate::Losses;

/// Lists refused paths and paths without a curve.
pub(crate) fn common_losses(layout: &Layout) -> Losses {
    Losses::of_paths(layout, layout.refused.len())
}
