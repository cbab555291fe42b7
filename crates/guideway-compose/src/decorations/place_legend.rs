//! Places the legend in a corner without paths, and measures the room that it needs if there is
//! none.

use guideway_document::decorations::{Corner, DecorationStyle, legend, scale_bar_box};
use guideway_scene::{DrawList, Scene, View};
use guideway_spline::Bounds;
use guideway_spline::uniform::to_bezier;

use super::options::Decorations;
use super::title::title;

/// A legend in its corner.
pub(crate) struct PlacedLegend {
    pub(crate) list: DrawList,
    pub(crate) bounds: Bounds<f64>,
    /// True if no path and no other decoration is below it.
    pub(crate) is_free: bool,
}

/// The legend of a scene in the first corner without paths, else in the upper left one. `None`
/// without a legend, or if it does not fit the picture.
///
/// Cost: O(control points).
pub(crate) fn place_legend(
    decorations: &Decorations,
    scene: &Scene,
    view: &View,
    style: &DecorationStyle,
) -> Option<PlacedLegend> {
    let colors = scene.legend().filter(|_| decorations.has_legend)?;
    let size = view.size();
    let top_px = decorations.title_band_px(style);
    let mut occupied = Vec::new();
    if let Some(text) = &decorations.title {
        occupied.push(title(text, size, style).1);
    }
    if decorations.has_scale_bar {
        occupied.push(scale_bar_box(view, style));
    }
    let at = |corner| {
        let (list, bounds) = legend(colors, size, top_px, corner, style)?;
        let is_over = occupied.iter().any(|other| other.intersects(bounds));
        Some(PlacedLegend {
            list,
            bounds,
            is_free: !is_over && !has_path(scene, view, bounds),
        })
    };
    let placed = Corner::ALL.into_iter().filter_map(at);
    placed.reduce(|best, other| match best.is_free || !other.is_free {
        true => best,
        false => other,
    })
}

/// Returns whether a path may be within a box of pixels: by the hulls of its Bezier curves.
fn has_path(scene: &Scene, view: &View, box_px: Bounds<f64>) -> bool {
    let corners = [box_px.min, box_px.max].map(|corner| view.world_from_pixel(corner));
    let Some(box_m) = Bounds::of_points(corners) else {
        return false;
    };
    let shown = scene.layout().paths.iter();
    shown
        .filter(|path| scene.shows_level(path.level()))
        .flat_map(|path| path.runs())
        .flat_map(|run| run.segments())
        .filter_map(|segment| Bounds::of_points(to_bezier(&segment)))
        .any(|bounds| bounds.intersects(box_m))
}
