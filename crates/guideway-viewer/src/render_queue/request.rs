//! The request for one picture: a view and a style.

use guideway_scene::{Style, View};

/// A picture to render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RenderRequest {
    pub(crate) view: View,
    pub(crate) style: Style,
}

impl RenderRequest {
    /// Returns `true` if the picture of `self` covers at least half of the area of `other`, in the
    /// same style. Such a picture is worth completing: the window shows it until `other` is
    /// rendered.
    pub(super) fn covers_half_of(&self, other: &Self) -> bool {
        let (a, b) = (self.view.world_bounds(), other.view.world_bounds());
        let overlap = |a: (f64, f64), b: (f64, f64)| (a.1.min(b.1) - a.0.max(b.0)).max(0.0);
        let shared = overlap((a.min.x, a.max.x), (b.min.x, b.max.x))
            * overlap((a.min.y, a.max.y), (b.min.y, b.max.y));
        let size = b.size();
        self.style == other.style && shared >= 0.5 * size.x * size.y
    }
}
