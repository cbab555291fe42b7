//! LIF network of a layout: completes it to the rules of LIF, which require that each path and node
//! is on a level, each path connects two nodes, and node identifiers are unique.

use std::borrow::Cow;
use std::collections::HashSet;

use guideway_layout::{Layout, Level, PathRef};
use guideway_spline::Point;

use crate::Losses;
use crate::end_nodes::EndNodes;
use crate::lif::model::ANY_TYPE;
use crate::unique_names::UniqueNames;

/// Levels, nodes and path ends as written.
pub(in crate::lif) struct Network<'a> {
    levels: Vec<Cow<'a, Level>>,
    nodes: Vec<Node<'a>>,
    /// Start and end node per path.
    ends: Vec<[u32; 2]>,
    /// Rows of nodes, paths and stations per level.
    level_rows: Vec<LevelRows>,
}

struct Node<'a> {
    id: Cow<'a, str>,
    position_m: Point<f64>,
    level: usize,
    /// Vehicle types of the paths from or to it.
    types: Vec<&'a str>,
}

#[derive(Clone, Default)]
struct LevelRows {
    nodes: Vec<u32>,
    paths: Vec<u32>,
    stations: Vec<u32>,
}

impl<'a> Network<'a> {
    /// Completes the network of a layout; adds each change to the losses.
    pub(in crate::lif) fn complete(layout: &'a Layout, losses: &mut Losses) -> Self {
        let mut levels: Vec<_> = layout.levels.iter().map(Cow::Borrowed).collect();
        let elevated = layout.levels.iter().filter(|l| l.elevation_m.is_some());
        losses.add("levels", elevated.count(), "elevations of levels");
        let node_levels = levels_of_nodes(layout);
        let without_level = count_without_level(layout, &node_levels);
        if without_level > 0 || levels.is_empty() {
            let mut names = UniqueNames::new(layout.levels.iter().map(|level| level.id.as_str()));
            let id = names.make_unique("layout");
            let detail =
                format!("paths, nodes and stations without a level: written to the level `{id}`");
            losses.add("levels", without_level, detail);
            levels.push(Cow::Owned(Level {
                id,
                ..Level::default()
            }));
        }
        let on_node_level = layout.paths.iter().filter(|p| p.level().is_none());
        let on_node_level = on_node_level.filter(|p| level_of(layout, *p).is_some());
        let detail = "paths without a level: written to the level of their nodes";
        losses.add("levels", on_node_level.count(), detail);
        let stated = (0..).map(|node| layout.nodes.level(node));
        let on_path_level = node_levels.iter().zip(stated);
        let on_path_level = on_path_level.filter(|(level, stated)| **level != *stated);
        let detail = "nodes without a level: written to the level of their paths";
        losses.add("levels", on_path_level.count(), detail);
        let mut network = Self {
            level_rows: vec![LevelRows::default(); levels.len()],
            levels,
            nodes: Vec::new(),
            ends: vec![[0; 2]; layout.paths.len()],
        };
        let mut names =
            UniqueNames::new((0..layout.nodes.len() as u32).map(|n| layout.nodes.id(n)));
        network.add_nodes(layout, &node_levels, &mut names, losses);
        network.add_paths(layout, &mut names, losses);
        for station in 0..layout.stations.len() as u32 {
            let level = network.level(layout.stations.level(station));
            network.level_rows[level].stations.push(station);
        }
        network
    }

    /// Returns the index of a level as written; the last one is for rows without a level.
    pub(in crate::lif) fn level(&self, level: Option<u32>) -> usize {
        let last = self.levels.len() - 1;
        level.map_or(last, |level| last.min(level as usize))
    }

    fn push_node(&mut self, id: Cow<'a, str>, position_m: Point<f64>, level: usize) -> u32 {
        let node = self.nodes.len() as u32;
        self.level_rows[level].nodes.push(node);
        self.nodes.push(Node {
            id,
            position_m,
            level,
            types: Vec::new(),
        });
        node
    }

    fn add_nodes(
        &mut self,
        layout: &'a Layout,
        levels: &[Option<u32>],
        names: &mut UniqueNames<'a>,
        losses: &mut Losses,
    ) {
        for (node, &level) in (0..).zip(levels) {
            let id = names.take(layout.nodes.id(node));
            let level = self.level(level);
            self.push_node(id, layout.nodes.position_m(node), level);
        }
        let detail = "nodes with a repeated name: written with a number at the end";
        losses.add("nodes", names.renamed, detail);
    }

    fn add_paths(&mut self, layout: &'a Layout, names: &mut UniqueNames<'a>, losses: &mut Losses) {
        let mut end_nodes = EndNodes::default();
        // The types that the nodes have so far.
        let mut known = HashSet::new();
        let (mut new_nodes, mut between_levels, mut for_any) = (0, 0, 0);
        for path in layout.paths.iter() {
            let (Some(ends), row) = (path.ends(), path.row()) else {
                continue;
            };
            let level = self.level(level_of(layout, path));
            self.level_rows[level].paths.push(row as u32);
            let stated = [path.start_node(), path.end_node()];
            let mut nodes = [0; 2];
            for (i, position) in [ends.0, ends.1].into_iter().enumerate() {
                let known = stated[i].or_else(|| end_nodes.near(level, position));
                nodes[i] = known.unwrap_or_else(|| {
                    new_nodes += 1;
                    let id = names.make_unique(&format!("node {new_nodes}"));
                    let node = self.push_node(id.into(), position, level);
                    end_nodes.add(level, position, node);
                    node
                });
            }
            self.ends[row] = nodes;
            let [start, end] = nodes.map(|node| self.nodes[node as usize].level);
            between_levels += usize::from(start != end);
            let types = layout.paths.vehicle_types().of(row);
            for_any += usize::from(types.len() == 0);
            for name in path_types(layout, row) {
                for node in nodes {
                    if known.insert((node, name)) {
                        self.nodes[node as usize].types.push(name);
                    }
                }
            }
        }
        losses.add(
            "nodes",
            new_nodes,
            "new nodes: written at path ends without a node",
        );
        Self::add_between_levels(between_levels, losses);
        let detail = format!("paths for all vehicle types: written for the type `{ANY_TYPE}`");
        losses.add("vehicle types", for_any, detail);
    }

    /// Adds the loss of paths between levels.
    pub(super) fn add_between_levels(count: usize, losses: &mut Losses) {
        let detail = "paths between levels: readers treat them as lifts and do not draw them";
        losses.add("paths", count, detail);
        let detail = "paths between levels: readers refuse to draw them";
        losses.add("refused paths", count, detail);
    }

    pub(in crate::lif) fn levels(&self) -> impl Iterator<Item = &Level> {
        self.levels.iter().map(AsRef::as_ref)
    }

    pub(in crate::lif) fn nodes_on(&self, level: usize) -> impl Iterator<Item = u32> {
        self.level_rows[level].nodes.iter().copied()
    }

    pub(in crate::lif) fn paths_on(&self, level: usize) -> impl Iterator<Item = u32> {
        self.level_rows[level].paths.iter().copied()
    }

    pub(in crate::lif) fn stations_on(&self, level: usize) -> impl Iterator<Item = u32> {
        self.level_rows[level].stations.iter().copied()
    }

    /// Returns the identifier of a node as written. Rows of layout nodes are the same here.
    pub(in crate::lif) fn node_id(&self, node: u32) -> &str {
        &self.nodes[node as usize].id
    }

    /// Returns whether a path connects two levels, so that readers do not draw it.
    pub(super) fn is_between_levels(&self, path: usize) -> bool {
        let [start, end] = self.ends[path].map(|node| self.nodes[node as usize].level);
        start != end
    }

    /// Returns the start and end node of a path.
    pub(in crate::lif) fn ends(&self, path: usize) -> [u32; 2] {
        self.ends[path]
    }

    pub(in crate::lif) fn position_m(&self, node: u32) -> Point<f64> {
        self.nodes[node as usize].position_m
    }

    /// Returns the index of the level of a node.
    pub(in crate::lif) fn level_of_node(&self, node: u32) -> usize {
        self.nodes[node as usize].level
    }

    /// Returns the vehicle types of the paths from and to a node.
    pub(in crate::lif) fn types_of_node(&self, node: u32) -> &[&'a str] {
        &self.nodes[node as usize].types
    }
}

/// Returns the vehicle types that a path is written for.
pub(in crate::lif) fn path_types(layout: &Layout, path: usize) -> Vec<&str> {
    let types = layout.paths.vehicle_types().of(path);
    match types.len() {
        0 => vec![ANY_TYPE],
        _ => types.collect(),
    }
}

/// Returns the level of a path, or else of its start node, or of its end node.
pub(in crate::lif) fn level_of(layout: &Layout, path: PathRef<'_>) -> Option<u32> {
    let of_nodes = || {
        let ends = [path.start_node(), path.end_node()].into_iter().flatten();
        ends.filter_map(|node| layout.nodes.level(node)).next()
    };
    path.level().or_else(of_nodes)
}

/// The level of each node, or else of the first of its paths that has one.
fn levels_of_nodes(layout: &Layout) -> Vec<Option<u32>> {
    let nodes = 0..layout.nodes.len() as u32;
    let mut levels: Vec<_> = nodes.map(|node| layout.nodes.level(node)).collect();
    for path in layout.paths.iter() {
        let level = level_of(layout, path);
        for node in [path.start_node(), path.end_node()].into_iter().flatten() {
            let own = &mut levels[node as usize];
            *own = own.or(level);
        }
    }
    levels
}

fn count_without_level(layout: &Layout, node_levels: &[Option<u32>]) -> usize {
    let paths = layout
        .paths
        .iter()
        .filter(|p| level_of(layout, *p).is_none());
    let nodes = node_levels.iter().filter(|level| level.is_none());
    let stations = 0..layout.stations.len() as u32;
    let stations = stations.filter(|&s| layout.stations.level(s).is_none());
    paths.count() + nodes.count() + stations.count()
}
