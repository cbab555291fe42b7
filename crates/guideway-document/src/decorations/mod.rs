//! What is drawn over the picture, in pixels: arrows, symbols, names and outlines.
//!
//! All of it is bounded by what a screen can show, however many paths there are: where a view holds more than
//! can be told apart there are no marks, and [`Marks::left_out`] says so.

mod apart;
mod arrows;
mod handles;
mod labels;
mod outline;
mod shapes;

use guideway_scene::View;
use guideway_scene::{LineRule, PathState};
use guideway_spline::Point;

use crate::{Document, ReversePairs};

use apart::{Apart, is_crowded};
pub use handles::{Handle, handles};
pub use labels::{Label, LabelSize};
pub use outline::{Outline, outline, path_outline};
pub use shapes::MarkKind;

/// Symbols and arrows nearer to each other than so many points lie over each other.
const SYMBOL: f64 = 8.0;

/// Most paths, nodes or stations of a view that still has marks for them.
pub const MAX_MARKED: usize = 2_000;

/// What is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkOptions {
    /// Pixels of the view to a point of the screen, which says how large marks are.
    pub px_per_point: f64,
    /// Which way vehicles go, along lines that are drawn by this rule.
    pub arrows: Option<LineRule>,
    /// Nodes and stations.
    pub symbols: bool,
    /// Names of paths, nodes and stations, of this size.
    pub labels: Option<LabelSize>,
}

/// An arrow on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrow {
    /// Its middle, in pixels.
    pub at_px: Point<f64>,
    /// Where it points; of length 1, y down.
    pub direction: Point<f64>,
    /// Whether it points back as well.
    pub is_two_way: bool,
    /// Half the width of the line that it lies on, in pixels.
    pub line_radius_px: f64,
}

/// Everything drawn over a view.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    /// Arrows along paths.
    pub arrows: Vec<Arrow>,
    /// Nodes, in pixels.
    pub nodes: Vec<Point<f64>>,
    /// Stations, in pixels.
    pub stations: Vec<Point<f64>>,
    /// Names, none over another.
    pub labels: Vec<Label>,
    /// Whether there are more paths or nodes in the view than can be told apart, so that theirs are left out.
    pub left_out: bool,
}

/// The marks of a view, for the paths that are shown.
pub fn marks(document: &Document, view: &View, options: &MarkOptions) -> Marks {
    let (scene, index, layout) = (document.scene(), document.index(), document.layout());
    let is_shown = |path: &u32| scene.state(*path) == PathState::Shown;
    let seen = view.world_bounds();
    let shown = index.paths_in(seen).filter(is_shown);
    let mut paths: Vec<u32> = shown.take(MAX_MARKED + 1).collect();
    let mut nodes: Vec<u32> = index.nodes_in(seen).take(MAX_MARKED + 1).collect();
    let all_stations = 0..layout.stations.len() as u32;
    let position = |station| document.station_position_m(station);
    let mut stations: Vec<(u32, Point<f64>)> = all_stations
        .filter_map(|station| Some((station, position(station)?)))
        .filter(|&(_, at)| seen.contains(at))
        .take(MAX_MARKED + 1)
        .collect();
    let mut left_out = [paths.len(), nodes.len(), stations.len()]
        .iter()
        .any(|&count| count > MAX_MARKED);
    let pixel = |at| view.pixel_from_world(at);
    let least_px = SYMBOL * options.px_per_point;
    for list in [&mut paths, &mut nodes] {
        if list.len() > MAX_MARKED {
            list.clear();
        }
        list.sort_unstable();
    }
    let node_px = |&node: &u32| pixel(document.node_position_m(node));
    let mut nodes_px: Vec<Point<f64>> = nodes.iter().map(node_px).collect();
    if is_crowded(&nodes_px, least_px) {
        left_out = true;
        nodes.clear();
        nodes_px.clear();
    }
    if stations.len() > MAX_MARKED {
        stations.clear();
    }
    let mut marks = Marks {
        left_out,
        ..Marks::default()
    };
    if let Some(line_rule) = options.arrows {
        // The first of a pair has the arrows of both.
        let twins = ReversePairs::among(document, &paths);
        let is_first = |path: &&u32| twins.of(**path).is_none_or(|twin| **path < twin);
        let of = |&path: &u32| {
            let is_pair = twins.of(path).is_some();
            let radius_px = line_rule.radius_px(scene.width_m(path), view.px_per_m());
            let path = layout.paths.get(path as usize);
            arrows::along(path, is_pair, radius_px, view, options.px_per_point)
        };
        let mut others = Apart::new(least_px);
        let arrows = paths.iter().filter(is_first).flat_map(of);
        let arrows = arrows.filter(|arrow| others.take(arrow.at_px));
        marks.arrows = arrows.take(2 * MAX_MARKED).collect();
    }
    if options.symbols {
        marks.nodes.clone_from(&nodes_px);
        marks.stations = stations.iter().map(|&(_, at)| pixel(at)).collect();
    }
    if let Some(size) = options.labels {
        let stations = stations
            .iter()
            .map(|&(s, at)| (layout.stations.id(s), pixel(at)));
        let names = nodes.iter().map(|&node| layout.nodes.id(node));
        let nodes = names.zip(nodes_px);
        let middles = paths.iter().filter_map(|&path| {
            let path = layout.paths.get(path as usize);
            let middle = arrows::middle(path, view, options.px_per_point)?;
            Some((path.id(), middle))
        });
        let symbols = marks.stations.iter().copied();
        let names = stations.chain(nodes).chain(middles);
        marks.labels = labels::place(names, symbols, size, view.size());
    }
    marks
}
