//! Places legend and scale bar in the emptiest corners, and tells if no corner is without paths.

use guideway_document::decorations::{Corner, DecorationStyle, legend, scale_bar_box};
use guideway_scene::density::{ToneMap, ToneScale};
use guideway_scene::{DrawList, FrameSize, Legend, Rgba, Scene, Shading, View};
use guideway_spline::Bounds;
use guideway_spline::uniform::to_bezier;

use super::options::Decorations;
use super::title::title;

/// A legend in its corner.
pub(crate) struct PlacedLegend {
    /// Its shapes; empty for density, whose numbers are known after rendering.
    pub(crate) list: DrawList,
    pub(crate) bounds: Bounds<f64>,
    pub(crate) corner: Corner,
    /// Number of segments of paths that may be below it; `usize::MAX` if another decoration is.
    pub(crate) covered: usize,
}

/// A scale bar in its corner.
pub(crate) struct PlacedBar {
    pub(crate) bounds: Bounds<f64>,
    pub(crate) corner: Corner,
    /// Number of segments of paths that may be below it.
    pub(crate) covered: usize,
}

/// The place of the scale bar: the lower corner with fewer segments of paths, else the left one.
/// `None` without a bar.
pub(crate) fn place_scale_bar(
    decorations: &Decorations,
    scene: &Scene,
    view: &View,
    style: &DecorationStyle,
) -> Option<PlacedBar> {
    if !decorations.has_scale_bar {
        return None;
    }
    let at = |corner| {
        let bounds = scale_bar_box(view, style, corner);
        PlacedBar {
            bounds,
            corner,
            covered: segments_in(scene, view, bounds),
        }
    };
    let placed = [Corner::LowerLeft, Corner::LowerRight].map(at);
    placed.into_iter().min_by_key(|placed| placed.covered)
}

/// The meaning of the colors of a picture; `None` if they have none. For density, the numbers are
/// those of a picture with one path.
pub(crate) fn colors_of(scene: &Scene, shading: Shading) -> Option<Legend> {
    match shading {
        Shading::Color => scene.legend().cloned(),
        Shading::Density(_) => Some(ToneScale::new(ToneMap::Log, Rgba::WHITE).legend()),
    }
}

/// The legend of density in the corner that [`place_legend`] found. Its box depends on its title
/// alone, which is wider than its numbers.
pub(crate) fn density_legend(
    colors: &Legend,
    corner: Corner,
    (decorations, size): (&Decorations, FrameSize),
    style: &DecorationStyle,
) -> Option<DrawList> {
    let top_px = decorations.title_band_px(style);
    Some(legend(colors, size, top_px, corner, style)?.0)
}

/// The legend of a picture in the corner with the fewest segments of paths, the first one of
/// several. `None` without a legend, or if it does not fit the picture.
///
/// Cost: O(control points).
pub(crate) fn place_legend(
    decorations: &Decorations,
    (scene, shading): (&Scene, Shading),
    view: &View,
    style: &DecorationStyle,
) -> Option<PlacedLegend> {
    if !decorations.has_legend {
        return None;
    }
    let colors = &colors_of(scene, shading)?;
    let size = view.size();
    let top_px = decorations.title_band_px(style);
    let mut occupied = Vec::new();
    if let Some(text) = &decorations.title {
        occupied.push(title(text, size, style).1);
    }
    let bar = place_scale_bar(decorations, scene, view, style);
    occupied.extend(bar.map(|bar| bar.bounds));
    let at = |corner| {
        let (list, bounds) = legend(colors, size, top_px, corner, style)?;
        let is_over = occupied.iter().any(|other| other.intersects(bounds));
        Some(PlacedLegend {
            list: match shading {
                Shading::Color => list,
                Shading::Density(_) => DrawList::default(),
            },
            bounds,
            corner,
            covered: match is_over {
                true => usize::MAX,
                false => segments_in(scene, view, bounds),
            },
        })
    };
    let placed = Corner::ALL.into_iter().filter_map(at);
    placed.min_by_key(|placed| placed.covered)
}

/// Number of segments that may be within a box of pixels: by the hulls of their Bezier curves.
fn segments_in(scene: &Scene, view: &View, box_px: Bounds<f64>) -> usize {
    let corners = [box_px.min, box_px.max].map(|corner| view.world_from_pixel(corner));
    let Some(box_m) = Bounds::of_points(corners) else {
        return 0;
    };
    let shown = scene.layout().paths.iter();
    shown
        .filter(|path| scene.shows_level(path.level()))
        .flat_map(|path| path.runs())
        .flat_map(|run| run.segments())
        .filter_map(|segment| Bounds::of_points(to_bezier(&segment)))
        .filter(|bounds| bounds.intersects(box_m))
        .count()
}
