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

/// Legend and scale bar of a picture.
pub(crate) struct PlacedCorners {
    /// `None` without a legend, or if it does not fit the picture.
    pub(crate) legend: Option<PlacedLegend>,
    /// `None` without a bar.
    pub(crate) bar: Option<PlacedBar>,
}

/// The meaning of the colors of a picture; `None` if they have none. For density, the numbers are
/// those of a picture with one path.
pub(crate) fn colors_of(scene: &Scene, shading: Shading) -> Option<Legend> {
    match shading {
        Shading::Color => scene.legend().cloned(),
        Shading::Density(_) => Some(ToneScale::new(ToneMap::Log, Rgba::WHITE).legend()),
    }
}

/// The legend of density in the corner that [`place_corners`] found. Its box depends on its title
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

/// The scale bar in the lower corner with fewer segments of paths, else the left one, and the
/// legend in the corner with the fewest segments, the first one of several.
///
/// Cost: O(paths + control points of those near a corner).
pub(crate) fn place_corners(
    decorations: &Decorations,
    (scene, shading): (&Scene, Shading),
    view: &View,
    style: &DecorationStyle,
) -> PlacedCorners {
    let (size, top_px) = (view.size(), decorations.title_band_px(style));
    let bar_corners = [Corner::LowerLeft, Corner::LowerRight].into_iter();
    let bars = bar_corners.filter(|_| decorations.has_scale_bar);
    let mut bars: Vec<PlacedBar> = bars
        .map(|corner| PlacedBar {
            bounds: scale_bar_box(view, style, corner),
            corner,
            covered: 0,
        })
        .collect();
    let colors = colors_of(scene, shading).filter(|_| decorations.has_legend);
    let legend_in = |corner| {
        let (list, bounds) = legend(colors.as_ref()?, size, top_px, corner, style)?;
        Some(PlacedLegend {
            list: match shading {
                Shading::Color => list,
                Shading::Density(_) => DrawList::default(),
            },
            bounds,
            corner,
            covered: 0,
        })
    };
    let mut legends: Vec<PlacedLegend> = Corner::ALL.into_iter().filter_map(legend_in).collect();

    let boxes = bars.iter().map(|bar| bar.bounds);
    let boxes: Vec<_> = boxes.chain(legends.iter().map(|of| of.bounds)).collect();
    let counts = segments_in(scene, view, &boxes);
    let (of_bars, of_legends) = counts.split_at(bars.len());
    for (bar, &covered) in bars.iter_mut().zip(of_bars) {
        bar.covered = covered;
    }
    let bar = bars.into_iter().min_by_key(|bar| bar.covered);
    let title = decorations.title.as_ref();
    let title_px = title.map(|text| title_box(text, size, style));
    let occupied = [title_px, bar.as_ref().map(|bar| bar.bounds)];
    for (legend, &covered) in legends.iter_mut().zip(of_legends) {
        let mut occupied = occupied.iter().flatten();
        let is_over = occupied.any(|other| other.intersects(legend.bounds));
        legend.covered = if is_over { usize::MAX } else { covered };
    }
    let legend = legends.into_iter().min_by_key(|legend| legend.covered);
    PlacedCorners { legend, bar }
}

fn title_box(text: &str, size: FrameSize, style: &DecorationStyle) -> Bounds<f64> {
    title(text, size, style).1
}

/// Number of segments that may be within each of some boxes of pixels: by the hulls of their Bezier
/// curves.
fn segments_in(scene: &Scene, view: &View, boxes_px: &[Bounds<f64>]) -> Vec<usize> {
    let in_world = |of: &Bounds<f64>| {
        let [a, b] = [of.min, of.max].map(|corner| view.world_from_pixel(corner));
        Bounds { min: a, max: a }.union(Bounds { min: b, max: b })
    };
    let boxes_m: Vec<_> = boxes_px.iter().map(in_world).collect();
    let paths = &scene.layout().paths;
    let mut counts = vec![0; boxes_m.len()];
    for row in paths_near(scene, &boxes_m) {
        let path = paths.get(row as usize);
        if !scene.shows_level(path.level()) {
            continue;
        }
        for segment in path.runs().flat_map(|run| run.segments()) {
            let Some(hull) = Bounds::of_points(to_bezier(&segment)) else {
                continue;
            };
            for (count, of) in counts.iter_mut().zip(&boxes_m) {
                *count += usize::from(hull.intersects(*of));
            }
        }
    }
    counts
}

/// The paths whose control points are in the same place as one of some boxes. The points of a
/// Bezier curve are within those of its spline but for rounding, which the boxes are grown by.
fn paths_near(scene: &Scene, boxes_m: &[Bounds<f64>]) -> Vec<u32> {
    let grown = |of: &Bounds<f64>| {
        let farthest = [of.min.x, of.min.y, of.max.x, of.max.y];
        let farthest_m = farthest
            .into_iter()
            .fold(0.0, |all: f64, at| all.max(at.abs()));
        of.inflated(8.0 * f64::EPSILON * farthest_m)
    };
    let grown: Vec<_> = boxes_m.iter().map(grown).collect();
    scene.hulls().meeting(&grown)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use guideway_layout::{Layout, NewPath};
    use guideway_scene::SceneOptions;
    use guideway_spline::{Point, Runs};

    use super::*;

    /// 20 by 20 bows, 1 m apart.
    fn bows() -> Scene {
        let mut layout = Layout::default();
        for i in 0..400 {
            let at = Point::new(f64::from(i % 20), f64::from(i / 20));
            let points = [(0.0, 0.0), (0.2, 0.9), (0.6, -0.8), (0.9, 0.4), (0.3, 0.5)];
            let mut runs = Runs::default();
            runs.push(&points.map(|(x, y)| at + Point::new(x, y)));
            layout.paths.push(&NewPath {
                runs: &runs,
                ..NewPath::default()
            });
        }
        Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap()
    }

    #[test]
    fn segments_in_corners_are_counted_by_a_look_at_the_paths_near_them() {
        let scene = bows();
        let size = FrameSize::new(400, 400).unwrap();
        let view = View::new(size, Point::new(10.0, 10.0), 20.0).unwrap();
        let corner = |x: f64, y: f64| Bounds {
            min: Point::new(x, y),
            max: Point::new(x + 70.0, y + 30.0),
        };
        let boxes = [corner(0.0, 0.0), corner(330.0, 0.0), corner(330.0, 370.0)];
        let counts = segments_in(&scene, &view, &boxes);
        for (of, count) in boxes.iter().zip(counts) {
            let paths = scene.layout().paths.iter();
            let segments = paths
                .flat_map(|path| path.runs())
                .flat_map(|run| run.segments());
            let hulls = segments.filter_map(|segment| {
                let points = to_bezier(&segment).map(|p| view.pixel_from_world(p));
                Bounds::of_points(points)
            });
            let expected = hulls.filter(|hull| hull.intersects(*of)).count();
            assert!(count == expected && count > 4, "{count}, not {expected}");
        }
        let [a, b] = [boxes[0].min, boxes[0].max].map(|at| view.world_from_pixel(at));
        let box_m = Bounds::of_points([a, b]).unwrap();
        let near = paths_near(&scene, &[box_m]).len();
        assert!((4..40).contains(&near), "{near} of 400 paths");
    }
}
