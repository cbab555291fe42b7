//! What a layout has to have to be LIF: every path and node on a level, every path between two nodes, and
//! no two nodes of one name.

use std::borrow::Cow;

use guideway_layout::{Layout, Level, PathRef};
use guideway_spline::Point;
use hashbrown::HashMap;
use serde_json::Map;

use super::write_columns::{Version, column_json};
use super::write_objects::{ForTypes, NodeObject};
use crate::Losses;

/// Ends of paths without nodes share one if they are this near, in meters.
const JOINED_M: f64 = 1e-3;

/// Stands for all vehicle types, of which LIF asks for at least one by name.
pub(super) const ANY_TYPE: &str = "any";

pub(super) struct Network<'a> {
    levels: Vec<Cow<'a, Level>>,
    nodes: Vec<Node<'a>>,
    /// The nodes where each path begins and ends.
    ends: Vec<[u32; 2]>,
    /// What is on each level.
    on_levels: Vec<OnLevel>,
}

struct Node<'a> {
    id: Cow<'a, str>,
    position_m: Point<f64>,
    level: usize,
    /// Those that may use a path from or to it.
    types: Vec<&'a str>,
}

#[derive(Clone, Default)]
struct OnLevel {
    nodes: Vec<u32>,
    paths: Vec<u32>,
    stations: Vec<u32>,
}

impl<'a> Network<'a> {
    pub(super) fn of(layout: &'a Layout, losses: &mut Losses) -> Self {
        let mut levels: Vec<_> = layout.levels.iter().map(Cow::Borrowed).collect();
        let high = layout.levels.iter().filter(|l| l.elevation_m.is_some());
        losses.add("levels", high.count(), "elevations of levels");
        let on_none = on_no_level(layout);
        if on_none > 0 || levels.is_empty() {
            let mut names = Names::among(layout.levels.iter().map(|level| level.id.as_str()));
            let id = names.new_like("layout");
            let detail = format!("paths, nodes and stations on no level: they are put on `{id}`");
            losses.add("levels", on_none, detail);
            let name = None;
            levels.push(Cow::Owned(Level {
                id,
                name,
                elevation_m: None,
            }));
        }
        let mut network = Self {
            on_levels: vec![OnLevel::default(); levels.len()],
            levels,
            nodes: Vec::new(),
            ends: vec![[0; 2]; layout.paths.len()],
        };
        let mut names = Names::among((0..layout.nodes.len() as u32).map(|n| layout.nodes.id(n)));
        network.add_nodes(layout, &mut names, losses);
        network.add_paths(layout, &mut names, losses);
        for station in 0..layout.stations.len() as u32 {
            let level = network.level(layout.stations.level(station));
            network.on_levels[level].stations.push(station);
        }
        network
    }

    /// The index of a level here; what is on none is on the last.
    fn level(&self, level: Option<u32>) -> usize {
        let last = self.levels.len() - 1;
        level.map_or(last, |level| last.min(level as usize))
    }

    fn push_node(&mut self, id: Cow<'a, str>, position_m: Point<f64>, level: usize) -> u32 {
        let node = self.nodes.len() as u32;
        self.on_levels[level].nodes.push(node);
        self.nodes.push(Node {
            id,
            position_m,
            level,
            types: Vec::new(),
        });
        node
    }

    fn add_nodes(&mut self, layout: &'a Layout, names: &mut Names<'a>, losses: &mut Losses) {
        for node in 0..layout.nodes.len() as u32 {
            let id = names.take(layout.nodes.id(node));
            let level = self.level(layout.nodes.level(node));
            self.push_node(id, layout.nodes.position_m(node), level);
        }
        let detail = "nodes with a name used before: a number is added to it";
        losses.add("nodes", names.changed, detail);
    }

    fn add_paths(&mut self, layout: &'a Layout, names: &mut Names<'a>, losses: &mut Losses) {
        let mut joints = Joints::default();
        let (mut made, mut crossing, mut for_any) = (0, 0, 0);
        for path in layout.paths.iter() {
            let (Some(ends), row) = (path.ends(), path.row()) else {
                continue;
            };
            let level = self.level(level_of(layout, path));
            self.on_levels[level].paths.push(row as u32);
            let own = [path.start_node(), path.end_node()];
            let mut nodes = [0; 2];
            for (i, position) in [ends.0, ends.1].into_iter().enumerate() {
                let known = own[i].or_else(|| joints.near(level, position));
                nodes[i] = known.unwrap_or_else(|| {
                    made += 1;
                    let id = names.new_like(&format!("node {made}"));
                    let node = self.push_node(id.into(), position, level);
                    joints.add(level, position, node);
                    node
                });
            }
            self.ends[row] = nodes;
            let [start, end] = nodes.map(|node| self.nodes[node as usize].level);
            crossing += usize::from(start != end);
            let types = layout.paths.vehicle_types().of(row);
            for_any += usize::from(types.len() == 0);
            for name in path_types(layout, row) {
                for node in nodes {
                    let types = &mut self.nodes[node as usize].types;
                    if !types.contains(&name) {
                        types.push(name);
                    }
                }
            }
        }
        losses.add(
            "nodes",
            made,
            "nodes that are made where paths begin or end at none",
        );
        let detail = "paths between levels: readers take them for lifts and draw nothing";
        losses.add("paths between levels", crossing, detail);
        let detail = format!("paths for all vehicle types: they are for the type `{ANY_TYPE}`");
        losses.add("vehicle types", for_any, detail);
    }

    pub(super) fn levels(&self) -> impl Iterator<Item = &Level> {
        self.levels.iter().map(AsRef::as_ref)
    }

    pub(super) fn nodes_on(&self, level: usize) -> impl Iterator<Item = u32> {
        self.on_levels[level].nodes.iter().copied()
    }

    pub(super) fn paths_on(&self, level: usize) -> impl Iterator<Item = u32> {
        self.on_levels[level].paths.iter().copied()
    }

    pub(super) fn stations_on(&self, level: usize) -> impl Iterator<Item = u32> {
        self.on_levels[level].stations.iter().copied()
    }

    /// The name of a node; the rows of the layout's own are theirs here too.
    pub(super) fn node_id(&self, node: u32) -> &str {
        &self.nodes[node as usize].id
    }

    /// The nodes where a path begins and ends.
    pub(super) fn ends(&self, path: usize) -> [u32; 2] {
        self.ends[path]
    }

    pub(super) fn position_m(&self, node: u32) -> Point<f64> {
        self.nodes[node as usize].position_m
    }

    /// What is written of a node.
    pub(super) fn node(&self, layout: &'a Layout, row: u32, version: Version) -> NodeObject<'_> {
        let node = &self.nodes[row as usize];
        let column = |name| {
            let column = layout.nodes.attributes.get(name)?;
            column_json(&column.values, row as usize)
        };
        let map = || self.levels[node.level].id.as_str().into();
        NodeObject {
            id: &node.id,
            name: column("nodeName"),
            map: column("mapId").unwrap_or_else(map),
            position: node.position_m.into(),
            properties: ForTypes {
                version,
                types: match node.types.as_slice() {
                    [] => vec![ANY_TYPE],
                    types => types.to_vec(),
                },
                columns: Map::new(),
                trajectory: None,
            },
        }
    }
}

/// The vehicle types that a path is written for.
pub(super) fn path_types(layout: &Layout, path: usize) -> Vec<&str> {
    let types = layout.paths.vehicle_types().of(path);
    match types.len() {
        0 => vec![ANY_TYPE],
        _ => types.collect(),
    }
}

/// The level of a path, or else that of the node where it begins.
fn level_of(layout: &Layout, path: PathRef<'_>) -> Option<u32> {
    let of_start = || layout.nodes.level(path.start_node()?);
    path.level().or_else(of_start)
}

fn on_no_level(layout: &Layout) -> usize {
    let paths = layout
        .paths
        .iter()
        .filter(|p| level_of(layout, *p).is_none());
    let nodes = (0..layout.nodes.len() as u32).filter(|&n| layout.nodes.level(n).is_none());
    let stations = 0..layout.stations.len() as u32;
    let stations = stations.filter(|&s| layout.stations.level(s).is_none());
    paths.count() + nodes.count() + stations.count()
}

/// Names that no two things may share.
pub(super) struct Names<'a> {
    /// Every name there is, and how many things have it so far.
    taken: HashMap<Cow<'a, str>, u64>,
    /// How many had to be changed.
    pub(super) changed: usize,
}

impl<'a> Names<'a> {
    /// Among these names, others are made.
    pub(super) fn among(all: impl Iterator<Item = &'a str>) -> Self {
        Self {
            taken: all.map(|name| (Cow::Borrowed(name), 0)).collect(),
            changed: 0,
        }
    }

    /// The name of a thing: its own, or one like it if it was taken.
    pub(super) fn take(&mut self, name: &'a str) -> Cow<'a, str> {
        let count = self.taken.entry(Cow::Borrowed(name)).or_insert(0);
        *count += 1;
        if *count == 1 && !name.is_empty() {
            return Cow::Borrowed(name);
        }
        self.changed += 1;
        Cow::Owned(self.numbered(name))
    }

    /// A name that is nobody's: this one if it can be.
    pub(super) fn new_like(&mut self, name: &str) -> String {
        if self.taken.contains_key(name) {
            return self.numbered(name);
        }
        self.taken.insert(Cow::Owned(name.to_owned()), 1);
        name.to_owned()
    }

    fn numbered(&mut self, name: &str) -> String {
        let mut number = self.taken.get(name).copied().unwrap_or(0).max(2);
        loop {
            let numbered = format!("{name}~{number}");
            if !self.taken.contains_key(numbered.as_str()) {
                // The next one need not look at those before.
                self.taken.insert(Cow::Owned(name.to_owned()), number);
                self.taken.insert(Cow::Owned(numbered.clone()), 1);
                return numbered;
            }
            number += 1;
        }
    }
}

/// Nodes that were made, by the square that they are in. None is as near to another of its level as [`JOINED_M`], so that a square
/// has few.
#[derive(Default)]
struct Joints(HashMap<Square, Vec<(Point<f64>, u32)>>);

/// A level, and the column and row of a square.
type Square = (usize, i64, i64);

/// The side of a square: what is near is seldom in another one.
const SQUARE_M: f64 = 8.0 * JOINED_M;

impl Joints {
    fn near(&self, level: usize, position: Point<f64>) -> Option<u32> {
        let reach = Point::new(JOINED_M, JOINED_M);
        let [(_, left, low), (_, right, high)] =
            [position - reach, position + reach].map(|corner| square(level, corner));
        let around = (left..=right).flat_map(|x| (low..=high).map(move |y| (level, x, y)));
        let all = around.filter_map(|square| self.0.get(&square)).flatten();
        let near = all.filter(|(other, _)| other.distance(position) <= JOINED_M);
        near.map(|(_, node)| *node).min()
    }

    fn add(&mut self, level: usize, position: Point<f64>, node: u32) {
        let nodes = self.0.entry(square(level, position)).or_default();
        nodes.push((position, node));
    }
}

fn square(level: usize, position: Point<f64>) -> Square {
    let [x, y] = [position.x, position.y].map(|v| (v / SQUARE_M).floor() as i64);
    (level, x, y)
}
