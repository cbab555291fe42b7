//! Losses of every format but the model itself: the losses that a writer starts its list with.

use guideway_layout::Layout;

use crate::Losses;

/// Lists refused paths, paths without a curve, and the members of a LIF file that the model does
/// not hold.
pub(crate) fn common_losses(layout: &Layout) -> Losses {
    let mut losses = Losses::of_paths(layout, layout.refused.len());
    let detail = "layouts, nodes, edges and stations of LIF: members that the model does not hold, \
                  such as actions and descriptions";
    losses.add("LIF", crate::lif::count_unmodeled(layout), detail);
    losses
}
