//! Places all decorations of a picture so that labels keep clear of legend, title and scale bar.

use guideway_document::Document;
use guideway_document::decorations::{
    Corner, DecorationStyle, Label, MarkOptions, MarkedKinds, Marks, grid, marks, scale_bar,
};
use guideway_scene::{DrawList, Scene, Shading, Style, View};
use guideway_spline::{Bounds, Point};

use super::options::Decorations;
use super::place_legend::{colors_of, place_legend, place_scale_bar};
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
/// Cost: marks need an index of the scene, linear in its paths; all else is bounded by the picture.
pub(crate) fn place(
    decorations: &Decorations,
    scene: &Scene,
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
    match place_legend(decorations, (scene, paths.shading), view, style) {
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
    if let Some(bar) = place_scale_bar(decorations, scene, view, style) {
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
        let marks = visible_marks(decorations, scene, view, paths, style, &occupied);
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
    scene: &Scene,
    view: &View,
    paths: &Style,
    style: &DecorationStyle,
    occupied: &[Bounds<f64>],
) -> Marks {
    let document = Document::from_scene(scene.clone());
    let size = style.label_size();
    let options = MarkOptions {
        px_per_point: style.px_per_point,
        line_rule: paths.line_rule,
        arrows: decorations.has_arrows && !scene.layout().is_drawing(),
        symbols: decorations.has_nodes || decorations.has_stations,
        labels: decorations.has_labels.then_some(size),
        of: MarkedKinds::default(),
    };
    let mut marks = marks(&document, view, &options);
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
    use std::sync::Arc;

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
        let size = FrameSize::new(800, 600).unwrap();
        let view = View::new(size, Point::default(), 30.0).unwrap();
        let paths = Style::default();
        let style = DecorationStyle::for_picture(size, paths.background);
        place(decorations, &scene(), &view, &paths, &style)
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
    fn arrows_alone_have_no_labels() {
        let decorations = Decorations {
            has_arrows: true,
            ..Decorations::default()
        };
        let placed = placed(&decorations);
        assert!(!placed.marks.fills.is_empty() && placed.marks.texts.is_empty());
    }
}
