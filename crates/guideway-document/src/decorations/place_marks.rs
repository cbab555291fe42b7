//! Places the marks of a view: collects what is visible, thins it out, and positions it.

use guideway_layout::{Layout, Value};
use guideway_scene::{LineRule, PathState, Table, View};
use guideway_spline::{Bounds, Point};

use super::arrows;
use super::declutter::{Declutter, is_crowded};
use super::draw_marks::arrow_box;
use super::labels::{self, Label, LabelPlaces, LabelSize, Name, Obstacles, Side};
use super::line_mask::LineMask;
use super::marks::{Arrow, MAX_MARKED, MarkOptions, MarkedKinds, Marks};
use crate::document::Document;
use crate::reverse_pairs::ReversePairs;

/// Diameter of a symbol, in points; marks nearer to each other overlap.
const SYMBOL_POINTS: f64 = 8.0;
/// Size of the symbol of a station, per unit of that of a node.
const STATION_SIZE: f64 = 1.5;
/// Largest part of a station's name that lines may cross: more than of other names, and less than
/// one line along it covers, which is a row of the five or six cells of its height.
const MAX_CROSSED_STATION: f64 = 0.15;
/// Largest part of a node's name that lines may cross: a corner of it.
const MAX_CROSSED_NODE: f64 = 0.12;
/// Largest part of a path's name that lines may cross.
const MAX_CROSSED_PATH: f64 = 0.03;

/// Places of the names of stations and nodes, the preferred one first.
const AROUND: &[Side] = &[
    Side::Right,
    Side::Left,
    Side::AboveRight,
    Side::BelowRight,
    Side::AboveLeft,
    Side::BelowLeft,
    Side::Above,
    Side::Below,
];

/// Places the marks of all shown paths, nodes and stations in a view.
pub fn marks(document: &Document, view: &View, options: &MarkOptions) -> Marks {
    let min_distance_px = SYMBOL_POINTS * options.px_per_point;
    let mut visible = Visible::new(document, view, min_distance_px);
    visible.keep(options.of);
    let mut marks = Marks {
        left_out: visible.left_out,
        line_radius_px: options.line_rule.radius_px(None, view.px_per_m()),
        ..Marks::default()
    };
    if options.arrows {
        let rule = options.line_rule;
        marks.arrows = visible.arrows(rule, options.px_per_point, min_distance_px);
    }
    if options.symbols {
        marks.nodes = visible.nodes.iter().map(|(_, at_px)| *at_px).collect();
        marks.stations = visible.stations.iter().map(|(_, at_px)| *at_px).collect();
        marks.links = visible.links(min_distance_px);
    }
    if let Some(size) = options.labels {
        let arrow_box = |arrow: &Arrow| arrow_box(arrow, options.px_per_point);
        let boxes: Vec<_> = marks.arrows.iter().filter_map(arrow_box).collect();
        marks.labels = visible.labels(&marks.stations, &boxes, size, options);
        // An arrow that a label hides in part would look like another symbol.
        let labels = marks
            .labels
            .iter()
            .flat_map(|label| size.label_boxes(label));
        let labels: Vec<_> = labels.collect();
        let is_hidden = |bounds| labels.iter().any(|label| label.intersects(bounds));
        let is_visible = |arrow: &Arrow| !arrow_box(arrow).is_some_and(is_hidden);
        marks.arrows.retain(is_visible);
    }
    marks
}

/// Returns `true` if a path is a wall or a door, along which no vehicle drives.
fn is_structure(layout: &Layout, path: u32) -> bool {
    let element = layout.paths.attributes.value(path as usize, "element");
    matches!(element, Some(Value::Text("wall" | "door")))
}

/// Returns `true` if a node is a corner of walls or doors, where no path ends that vehicles drive.
fn is_corner(document: &Document, node: u32) -> bool {
    let paths = document.index().paths_at(node);
    let mut paths = paths
        .filter(|path| document.scene().exists(Table::Paths, *path))
        .peekable();
    paths.peek().is_some() && paths.all(|path| is_structure(document.layout(), path))
}

/// The paths, nodes and stations of a view that get marks.
struct Visible<'d> {
    document: &'d Document,
    view: &'d View,
    /// Rows of shown paths; empty if too many.
    paths: Vec<u32>,
    /// Rows and pixel positions; empty if too many or crowded.
    nodes: Vec<(u32, Point<f64>)>,
    /// Rows and pixel positions; empty if too many or crowded.
    stations: Vec<(u32, Point<f64>)>,
    /// True if a list is empty because it has too many elements.
    left_out: bool,
}

impl<'d> Visible<'d> {
    fn new(document: &'d Document, view: &'d View, min_distance_px: f64) -> Self {
        let (scene, index) = (document.scene(), document.index());
        let bounds = view.world_bounds();
        let mut left_out = false;
        let mut few = |rows: &mut dyn Iterator<Item = u32>| {
            let mut rows: Vec<u32> = rows.take(MAX_MARKED + 1).collect();
            if rows.len() > MAX_MARKED {
                left_out = true;
                rows.clear();
            }
            rows.sort_unstable();
            rows
        };
        let is_shown = |path: &u32| scene.state(*path) == PathState::Shown;
        let paths = few(&mut index.paths_in(bounds).filter(is_shown));
        let layout = document.layout();
        let is_on_level = |node: &u32| document.shows_level(layout.nodes.level(*node));
        let is_corner = |node: &u32| is_corner(document, *node);
        let nodes = index.nodes_in(bounds).filter(is_on_level);
        let nodes = few(&mut nodes.filter(|node| !is_corner(node)));
        let station_m = |station: u32| document.station_position_m(station);
        let is_visible = |station: &u32| {
            scene.exists(Table::Stations, *station)
                && document.shows_level(layout.stations.level(*station))
                && station_m(*station).is_some_and(|at| bounds.contains(at))
        };
        let stations = 0..layout.stations.len() as u32;
        let stations = few(&mut stations.filter(is_visible));

        let pixel = |at| view.pixel_from_world(at);
        let node_px = |node| (node, pixel(document.node_position_m(node)));
        let mut nodes: Vec<_> = nodes.into_iter().map(node_px).collect();
        let positions_px: Vec<_> = nodes.iter().map(|(_, at_px)| *at_px).collect();
        if is_crowded(&positions_px, min_distance_px) {
            left_out = true;
            nodes.clear();
        }
        let station_px = |station| Some((station, pixel(station_m(station)?)));
        let mut stations: Vec<_> = stations.into_iter().filter_map(station_px).collect();
        let positions_px: Vec<_> = stations.iter().map(|(_, at_px)| *at_px).collect();
        if is_crowded(&positions_px, STATION_SIZE * min_distance_px) {
            left_out = true;
            stations.clear();
        }
        Self {
            document,
            view,
            paths,
            nodes,
            stations,
            left_out,
        }
    }

    /// Keeps the elements of some kinds.
    fn keep(&mut self, of: MarkedKinds) {
        if !of.paths {
            self.paths.clear();
        }
        if !of.nodes {
            self.nodes.clear();
        }
        if !of.stations {
            self.stations.clear();
        }
    }

    /// The lines from stations to nodes that serve them, where symbols do not touch.
    fn links(&self, min_distance_px: f64) -> Vec<[Point<f64>; 2]> {
        let (scene, layout) = (self.document.scene(), self.document.layout());
        let of_station = |&(station, at_px): &(u32, Point<f64>)| {
            let nodes = layout.stations.nodes(station).iter();
            let nodes = nodes.filter(|&&node| scene.exists(Table::Nodes, node));
            let shown = nodes.filter(|&&node| self.document.shows_level(layout.nodes.level(node)));
            let ends = shown.map(move |&node| {
                let node_m = self.document.node_position_m(node);
                [at_px, self.view.pixel_from_world(node_m)]
            });
            ends.filter(move |[a, b]| a.distance(*b) > min_distance_px)
        };
        let links = self.stations.iter().flat_map(of_station);
        links.take(2 * MAX_MARKED).collect()
    }

    /// Arrows along the paths, thinned out. The first path of a reverse pair has the arrows of
    /// both.
    fn arrows(&self, rule: LineRule, px_per_point: f64, min_distance_px: f64) -> Vec<Arrow> {
        let (scene, layout) = (self.document.scene(), self.document.layout());
        let pairs = ReversePairs::among(self.document, &self.paths);
        let is_first = |path: &&u32| pairs.of(**path).is_none_or(|other| **path < other);
        let along = |&path: &u32| {
            let is_pair = pairs.of(path).is_some();
            let radius_px = rule.radius_px(scene.width_m(path), self.view.px_per_m());
            let path = layout.paths.get(path as usize);
            arrows::along(path, is_pair, radius_px, self.view, px_per_point)
        };
        let mut declutter = Declutter::new(min_distance_px);
        let is_driven = |path: &&u32| !is_structure(layout, **path);
        let driven = self.paths.iter().filter(is_first).filter(is_driven);
        let arrows = driven.flat_map(along);
        let arrows = arrows.filter(|arrow| declutter.place(arrow.at_px));
        arrows.take(2 * MAX_MARKED).collect()
    }

    /// Labels of stations, nodes and paths, in order of priority, clear of `symbols`, and those of
    /// paths clear of `arrows`. No line strikes a name through: one without a free place is left
    /// out. A node that a station stands on has the name of the station.
    fn labels(
        &self,
        symbols: &[Point<f64>],
        arrows: &[Bounds<f64>],
        size: LabelSize,
        options: &MarkOptions,
    ) -> Vec<Label> {
        let px_per_point = options.px_per_point;
        let (scene, layout) = (self.document.scene(), self.document.layout());
        let path = |row: u32| layout.paths.get(row as usize);
        let lines = self.paths.iter().map(|&row| path(row));
        let obstacles = Obstacles {
            symbols,
            arrows,
            lines: &LineMask::new(lines, self.view, px_per_point),
        };
        let stations = self.stations.iter().map(|&(row, at_px)| Name {
            text: layout.stations.id(row),
            at_px,
            places: LabelPlaces::Beside(AROUND),
            max_crossed: MAX_CROSSED_STATION,
            spares_arrows: false,
        });
        let mut free = Declutter::new(SYMBOL_POINTS * px_per_point);
        for (_, at_px) in &self.stations {
            free.place(*at_px);
        }
        let nodes = self.nodes.iter().filter(|(_, at_px)| free.place(*at_px));
        let nodes = nodes.map(|&(row, at_px)| Name {
            text: layout.nodes.id(row),
            at_px,
            places: LabelPlaces::Beside(AROUND),
            max_crossed: MAX_CROSSED_NODE,
            spares_arrows: false,
        });
        let driven = self.paths.iter().filter(|row| !is_structure(layout, **row));
        let paths = driven.filter_map(|&row| {
            let (at_px, direction) = arrows::middle(path(row), self.view, px_per_point)?;
            let width_m = scene.width_m(row);
            let line_radius_px = options.line_rule.radius_px(width_m, self.view.px_per_m());
            Some(Name {
                text: path(row).id(),
                at_px,
                places: LabelPlaces::Along {
                    direction,
                    line_radius_px,
                },
                max_crossed: MAX_CROSSED_PATH,
                spares_arrows: true,
            })
        });
        let names = stations.chain(nodes).chain(paths);
        labels::place(names, &obstacles, size, self.view.size())
    }
}
