//! Places all decorations of a picture so that labels keep clear of legend, title and scale bar.

use std::sync::Arc;

use guideway_document::decorations::{
    Corner, DecorationStyle, Label, MarkOptions, MarkedKinds, Marks, grid, marks, scale_bar,
};
use guideway_document::{Document, Index};
use guideway_scene::{DrawList, Scene, Shading, Style, View};
use guideway_spline::{Bounds, Point};

use super::options::Decorations;
use super::place_legend::{colors_of, place_corners};
use super::route;
use super::title::title;
use super::zones;

/// Opacity of the paper behind the scale bar.
const PAPER_OPACITY: f64 = 0.9;

/// Decorations of one view, by layer.
#[derive(Default)]
pub(crate) struct PlacedDecorations {
    /// Below the paths.
    pub(crate) grid: DrawList,
    /// Over the grid.
    pub(crate) zones: DrawList,
    /// Over the paths.
    pub(crate) marks: DrawList,
    /// Over everything, with the label of each SVG group.
    pub(crate) margin: Vec<(DrawList, &'static str)>,
    /// Corner of the legend of density, which is drawn once its numbers are known.
    pub(crate) density_corner: Option<Corner>,
    /// Decorations that are left out, for the report.
    pub(crate) notes: Vec<String>,
}

/// Places the decorations of a scene in a view.
///
/// Cost: marks need an index of the layout, which is built, linear in its paths, where there is
/// none; all else is bounded by the picture.
pub(crate) fn place(
    decorations: &Decorations,
    (scene, index): (&Scene, Option<&Arc<Index>>),
    view: &View,
    paths: &Style,
    style: &DecorationStyle,
) -> PlacedDecorations {
    let mut placed = PlacedDecorations::default();
    let size = view.size();
    let mut occupied = Vec::new();
    if let Some(text) = &decorations.title {
        let (list, bounds) = title(text, size, style);
        occupied.push(bounds);
        placed.margin.push((list, "title"));
    }
    let corners = place_corners(decorations, (scene, paths.shading), view, style);
    match corners.legend {
        Some(placed_legend) => {
            occupied.push(placed_legend.bounds);
            let is_known = paths.shading == Shading::Color;
            placed.density_corner = (!is_known).then_some(placed_legend.corner);
            placed.margin.push((placed_legend.list, "legend"));
        }
        None if decorations.has_legend && colors_of(scene, paths.shading).is_some() => placed
            .notes
            .push("the legend is larger than the picture, so it is only in this report".to_owned()),
        None => {}
    }
    if let Some(bar) = corners.bar {
        occupied.push(bar.bounds);
        let mut list = DrawList::default();
        let paper = style.paper.with_opacity(PAPER_OPACITY);
        list.fill_rectangle(paper, bar.bounds.min, bar.bounds.max);
        list.append(scale_bar(view, style, bar.corner));
        placed.margin.push((list, "scale bar"));
    }
    let route = decorations.route.as_ref();
    let route = route.map(|route| route::draw(route, scene, view, paths, style));
    occupied.extend(route.iter().flat_map(|route| &route.occupied));
    if decorations.has_grid {
        placed.grid = grid(view, None, style);
    }
    if decorations.has_zones {
        placed.zones = zones::draw(scene, view, style);
    }
    if decorations.has_marks() {
        let scene = scene.clone();
        let document = match index {
            Some(index) => Document::with_index(scene, Arc::clone(index)),
            None => Document::from_scene(scene),
        };
        let marks = visible_marks(decorations, &document, view, paths, style, &occupied);
        if marks.left_out {
            placed.notes.push(
                "the view holds too many nodes, stations or paths for marks; some are left out: \
                 choose a larger --scale"
                    .to_owned(),
            );
        }
        placed.marks = marks.draw(style, |at_px| at_px);
    }
    if let Some(mut route) = route {
        route.band.append(std::mem::take(&mut placed.marks));
        placed.marks = route.band;
        placed.margin.push((route.ends, "route"));
    }
    placed
}

/// The requested marks of a view, without those that the boxes `occupied` hide.
fn visible_marks(
    decorations: &Decorations,
    document: &Document,
    view: &View,
    paths: &Style,
    style: &DecorationStyle,
    occupied: &[Bounds<f64>],
) -> Marks {
    let size = style.label_size();
    let options = MarkOptions {
        px_per_point: style.px_per_point,
        line_rule: paths.line_rule,
        arrows: decorations.has_arrows && !document.layout().is_drawing(),
        symbols: decorations.has_nodes || decorations.has_stations,
        labels: decorations.has_labels.then_some(size),
        of: MarkedKinds::default(),
    };
    let mut marks = marks(document, view, &options);
    if !decorations.has_nodes {
        marks.nodes.clear();
    }
    if !decorations.has_stations {
        marks.stations.clear();
    }
    let is_free = |at: Point<f64>| !occupied.iter().any(|bounds| bounds.contains(at));
    marks.arrows.retain(|arrow| is_free(arrow.at_px));
    marks.nodes.retain(|&at| is_free(at));
    marks.stations.retain(|&at| is_free(at));
    let is_clear = |label: &Label| {
        let boxes = size.label_boxes(label);
        let is_hit = |bounds: &Bounds<f64>| boxes.iter().any(|label| label.intersects(*bounds));
        !occupied.iter().any(is_hit)
    };
    marks.labels.retain(is_clear);
    marks
}

#[cfg(test)]
mod tests {
    use guideway_layout::{Layout, NewPath};
    use guideway_scene::{FrameSize, SceneOptions};
    use guideway_spline::Runs;

    use super::*;

    fn scene() -> Scene {
        let mut layout = Layout::default();
        for (id, y) in [("upper", 5.0), ("lower", -5.0)] {
            let mut runs = Runs::default();
            runs.push_line(Point::new(-10.0, y), Point::new(10.0, y));
            layout.paths.push(&NewPath {
                id,
                runs: &runs,
                ..NewPath::default()
            });
        }
        Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap()
    }

    fn placed(decorations: &Decorations) -> PlacedDecorations {
        placed_by(decorations, None)
    }

    fn placed_by(decorations: &Decorations, index: Option<&Arc<Index>>) -> PlacedDecorations {
        let size = FrameSize::new(800, 600).unwrap();
        let view = View::new(size, Point::default(), 30.0).unwrap();
        let paths = Style::default();
        let style = DecorationStyle::for_picture(size, paths.background);
        place(decorations, (&scene(), index), &view, &paths, &style)
    }

    #[test]
    fn no_decorations_place_nothing() {
        let placed = placed(&Decorations::default());
        assert!(placed.grid.is_empty() && placed.marks.is_empty() && placed.margin.is_empty());
    }

    #[test]
    fn site_places_every_layer() {
        let placed = placed(&Decorations::site("Site"));
        assert!(!placed.grid.is_empty() && !placed.marks.is_empty());
        let labels: Vec<_> = placed.margin.iter().map(|(_, label)| *label).collect();
        assert_eq!(labels, ["title", "scale bar"]);
        let texts: Vec<_> = placed.marks.texts.iter().map(|t| t.text.as_str()).collect();
        assert_eq!(texts, ["upper", "lower"]);
    }

    #[test]
    fn marks_are_found_by_the_index_that_is_given() {
        let names = |index: Index| {
            let placed = placed_by(&Decorations::site("Site"), Some(&Arc::new(index)));
            placed.marks.texts.len()
        };
        assert_eq!(names(Index::new(scene().layout())), 2);
        // The index of no paths: the scene was not indexed anew.
        assert_eq!(names(Index::default()), 0);
    }

    #[test]
    fn arrows_alone_have_no_labels() {
        let decorations = Decorations {
            has_arrows: true,
            ..Decorations::default()
        };
        let placed = placed(&decorations);
        assert!(!placed.marks.fills.is_empty() && placed.marks.texts.is_empty());
    }
}
