//! Objects of LIF: the nodes, edges and stations of a layout as JSON.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use guideway_layout::{Attributes, Layout, TypeEntries, Value};
use guideway_spline::Point;

use super::columns::{MemberColumns, Tables};
use super::edges::EdgeRef;
use super::network::{Network, path_types};
use crate::clamped::rounded;
use crate::json::{Members, Tree};
use crate::lif::members::{
    EDGE, EDGE_TYPE, NODE, NODE_TYPE, OTHER, STATION, STATION_POSITION, TYPE_OTHER,
};
use crate::lif::model::{ANY_TYPE, EDGE_PROPERTIES, NODE_PROPERTIES};
use crate::lif::version::Version;
use crate::trajectory_writer::TrajectoryWriter;

/// Makes the objects of a layout in a version.
pub(in crate::lif) struct Elements<'a> {
    pub(super) layout: &'a Layout,
    pub(super) network: &'a Network<'a>,
    pub(super) version: Version,
    /// True for a layout read from LIF, whose further members are written too.
    pub(super) is_from_lif: bool,
    pub(super) node: MemberColumns<'a>,
    pub(super) node_type: MemberColumns<'a>,
    pub(super) edge: MemberColumns<'a>,
    /// For edges in and against the direction of their paths.
    pub(super) edge_type: [MemberColumns<'a>; 2],
    pub(super) station: MemberColumns<'a>,
    pub(super) station_position: MemberColumns<'a>,
    pub(super) trajectories: TrajectoryWriter<'a>,
    /// Properties of the vehicle types.
    types: HashMap<&'a str, &'a Attributes>,
}

impl<'a> Elements<'a> {
    pub(in crate::lif) fn new(
        layout: &'a Layout,
        network: &'a Network<'a>,
        version: Version,
    ) -> Self {
        let is_from_lif = Version::of_layout(layout).is_some();
        let is_as_written = Version::of_layout(layout) == Some(version);
        let select = |names, of_element, of_entry, is_reverse| {
            let tables = Tables {
                of_element,
                of_entry,
            };
            MemberColumns::select(version, names, tables, is_reverse, is_as_written)
        };
        let (nodes, paths) = (&layout.nodes.attributes, &layout.paths.attributes);
        let node_types = Some(&layout.nodes.vehicle_types().attributes);
        let path_types = Some(&layout.paths.vehicle_types().attributes);
        let stations = &layout.stations.attributes;
        let edge_type = |is_reverse| select(EDGE_TYPE, paths, path_types, is_reverse);
        let types = layout.vehicle_types.iter();
        Self {
            types: types.map(|t| (t.id.as_str(), &t.attributes)).collect(),
            layout,
            network,
            version,
            is_from_lif,
            node: select(NODE, nodes, None, false),
            node_type: select(NODE_TYPE, nodes, node_types, false),
            edge: select(EDGE, paths, None, false),
            edge_type: [false, true].map(edge_type),
            station: select(STATION, stations, None, false),
            station_position: select(STATION_POSITION, stations, None, false),
            trajectories: TrajectoryWriter {
                layout,
                has_weights_from_1: version == Version::V1,
                is_as_written: is_from_lif,
            },
        }
    }

    /// A node without its entries per vehicle type.
    pub(in crate::lif) fn node(&self, node: u32) -> Tree<'a> {
        let mut members: Members<'a> = vec![text("nodeId", self.network.node_id(node))];
        let is_known = (node as usize) < self.layout.nodes.len();
        if is_known {
            self.node.add_to(&mut members, node as usize, None);
        }
        let position = point(self.network.position_m(node));
        members.push(("nodePosition".into(), Tree::Object(position)));
        let mut tree = Tree::Object(members);
        if is_known {
            self.merge_other(
                &mut tree,
                &self.layout.nodes.attributes,
                node as usize,
                OTHER,
            );
        }
        tree
    }

    /// Adds the level of a node as its map, before its position, if it states no map.
    fn add_map(&self, tree: &mut Tree<'a>, node: u32) {
        let level = self.network.level_of_node(node);
        let level = self.network.levels().nth(level);
        let (Tree::Object(members), Some(level)) = (tree, level) else {
            return;
        };
        if members.iter().all(|(name, _)| name != "mapId") {
            let mut names = members.iter().map(|(name, _)| name);
            let at = names.position(|name| name == "nodePosition").unwrap_or(0);
            members.insert(at, text("mapId", level.id.as_str()));
        }
    }

    /// The vehicle types of a node, with the entry of each that has one: those of the node, then
    /// those of its paths.
    pub(in crate::lif) fn node_types(&self, node: u32) -> Vec<(&'a str, Option<usize>)> {
        let mut types: Vec<(&str, Option<usize>)> = Vec::new();
        if (node as usize) < self.layout.nodes.len() {
            let own = self.layout.nodes.vehicle_types();
            let entries = own.entries(node as usize);
            types.extend(entries.map(|entry| (own.type_of(entry), Some(entry))));
        }
        add_missing(&mut types, self.network.types_of_node(node));
        if types.is_empty() {
            types.push((ANY_TYPE, None));
        }
        types
    }

    /// The properties of a node for a vehicle type, without its name.
    pub(in crate::lif) fn node_type(&self, node: u32, entry: Option<usize>) -> Tree<'a> {
        let own = self.layout.nodes.vehicle_types();
        let mut members = Vec::new();
        let row = node as usize;
        if row >= own.len() {
            return Tree::Object(members);
        }
        self.node_type.add_to(&mut members, row, entry);
        let mut tree = Tree::Object(members);
        self.merge_type_other(&mut tree, &self.layout.nodes.attributes, own, row, entry);
        tree
    }

    /// A node as a whole.
    pub(in crate::lif) fn whole_node(&self, node: u32) -> Tree<'a> {
        let mut tree = self.node(node);
        self.add_map(&mut tree, node);
        let types = self.node_types(node).into_iter();
        let types = types.map(|(name, entry)| (name, self.node_type(node, entry)));
        let entries = self.entries(types.collect());
        self.add_entries(&mut tree, NODE_PROPERTIES, entries);
        tree
    }

    /// An edge without its entries per vehicle type.
    pub(in crate::lif) fn edge(&self, edge: &EdgeRef<'a>) -> Tree<'a> {
        let row = edge.path as usize;
        let [start, end] = self.ends(edge).map(|node| self.network.node_id(node));
        let mut members: Members<'a> = vec![
            ("edgeId".into(), Tree::Text(edge.id.clone())),
            text("startNodeId", start),
            text("endNodeId", end),
        ];
        self.edge.add_to(&mut members, row, None);
        let mut tree = Tree::Object(members);
        self.merge_other(&mut tree, &self.layout.paths.attributes, row, OTHER);
        tree
    }

    /// Start and end node of an edge.
    fn ends(&self, edge: &EdgeRef<'_>) -> [u32; 2] {
        let mut ends = self.network.ends(edge.path as usize);
        if edge.is_reverse {
            ends.reverse();
        }
        ends
    }

    /// The properties of a path for a vehicle type, without its name and the trajectory.
    pub(in crate::lif) fn edge_type(
        &self,
        path: u32,
        entry: Option<usize>,
        is_reverse: bool,
    ) -> Tree<'a> {
        let row = path as usize;
        let mut members = Vec::new();
        self.edge_type[usize::from(is_reverse)].add_to(&mut members, row, entry);
        let is_required = self.version == Version::V1
            && members.iter().all(|(name, _)| name != "rotationAllowed");
        if is_required {
            members.push(("rotationAllowed".into(), Tree::Bool(false)));
        }
        let mut tree = Tree::Object(members);
        let own = self.layout.paths.vehicle_types();
        self.merge_type_other(&mut tree, &self.layout.paths.attributes, own, row, entry);
        tree
    }

    /// The trajectory of a path; `None` for the straight line between its nodes.
    pub(in crate::lif) fn trajectory(&self, path: u32, is_reverse: bool) -> Option<Tree<'a>> {
        let ends = self.network.ends(path as usize);
        let ends = ends.map(|node| self.network.position_m(node));
        let path = self.layout.paths.get(path as usize);
        self.trajectories.trajectory(path, ends, is_reverse)
    }

    /// An edge as a whole.
    pub(in crate::lif) fn whole_edge(&self, edge: &EdgeRef<'a>) -> Tree<'a> {
        let mut tree = self.edge(edge);
        let mut entries = Vec::new();
        for path in edge.paths() {
            let trajectory = self.trajectory(path, edge.is_reverse);
            let own = self.layout.paths.vehicle_types();
            let rows = own.entries(path as usize);
            let has_entries = !rows.is_empty();
            let rows = rows.map(Some).chain((!has_entries).then_some(None));
            let names = path_types(self.layout, path as usize).into_iter();
            let types = names.zip(rows).map(|(name, entry)| {
                let mut tree = self.edge_type(path, entry, edge.is_reverse);
                if let (Tree::Object(members), Some(curve)) = (&mut tree, &trajectory) {
                    members.push(("trajectory".into(), curve.clone()));
                }
                (name, tree)
            });
            entries.extend(self.entries(types.collect()));
        }
        self.add_entries(&mut tree, EDGE_PROPERTIES, entries);
        tree
    }

    /// The entries of vehicle types: one per type in 1.0, one per distinct properties in 2.0.
    pub(in crate::lif) fn entries(&self, types: Vec<(&'a str, Tree<'a>)>) -> Vec<Tree<'a>> {
        if self.version == Version::V1 {
            let entries = types.into_iter().map(|(name, properties)| {
                with_members(vec![text("vehicleTypeId", name)], properties)
            });
            return entries.collect();
        }
        let mut groups: Vec<(Vec<&str>, Tree<'a>)> = Vec::new();
        for (name, properties) in types {
            match groups.last_mut() {
                Some((names, known)) if *known == properties => names.push(name),
                _ => groups.push((vec![name], properties)),
            }
        }
        let entries = groups.into_iter().map(|(names, properties)| {
            let robots = names.into_iter().map(|name| self.robot(name)).collect();
            let robots = ("mobileRobotTypes".into(), Tree::Array(robots));
            with_members(vec![robots], properties)
        });
        entries.collect()
    }

    /// A vehicle type of 2.0.
    fn robot(&self, name: &'a str) -> Tree<'a> {
        let attributes = self.types.get(name).copied();
        let part = |key| match attributes?.value(0, key)? {
            Value::Text(text) => Some(text),
            _ => None,
        };
        let (first, rest) = name.split_once(' ').unwrap_or(("", name));
        let mut tree = Tree::Object(vec![
            text("manufacturer", part("manufacturer").unwrap_or(first)),
            text("seriesName", part("seriesName").unwrap_or(rest)),
        ]);
        if let Some(attributes) = attributes {
            self.merge_other(&mut tree, attributes, 0, OTHER);
        }
        tree
    }

    /// Adds the array of entries to an element, before members that the format does not define.
    fn add_entries(&self, tree: &mut Tree<'a>, keys: [&'static str; 2], entries: Vec<Tree<'a>>) {
        let Tree::Object(members) = tree else {
            return;
        };
        let key = self.version.select(keys);
        match members.iter_mut().find(|(name, _)| name == key) {
            // Entries that the layout does not use.
            Some((_, Tree::Raw(surplus))) => {
                let mut all = Tree::Object(vec![(key.into(), Tree::Array(entries))]);
                if let Cow::Borrowed(surplus) = surplus {
                    all.merge_item(key, surplus);
                }
                members.retain(|(name, _)| name != key);
                if let Tree::Object(all) = all {
                    members.extend(all);
                }
            }
            _ => members.push((key.into(), Tree::Array(entries))),
        }
    }

    /// A station.
    pub(in crate::lif) fn station(&self, station: u32) -> Tree<'a> {
        let (stations, row) = (&self.layout.stations, station as usize);
        let nodes = stations.nodes(station).iter();
        let nodes = nodes.map(|&node| Tree::Text(self.network.node_id(node).into()));
        let mut members: Members<'a> = vec![
            text("stationId", stations.id(station)),
            ("interactionNodeIds".into(), Tree::Array(nodes.collect())),
        ];
        self.station.add_to(&mut members, row, None);
        if let Some(position) = stations.position_m(station) {
            let mut position = point(position);
            self.station_position.add_to(&mut position, row, None);
            members.push(("stationPosition".into(), Tree::Object(position)));
        }
        let mut tree = Tree::Object(members);
        self.merge_other(&mut tree, &stations.attributes, row, OTHER);
        tree
    }

    /// Merges members of the file that the format does not define.
    pub(in crate::lif) fn merge_other(
        &self,
        tree: &mut Tree<'a>,
        attributes: &'a Attributes,
        row: usize,
        column: &str,
    ) {
        if let (true, Some(Value::Json(text))) = (self.is_from_lif, attributes.value(row, column)) {
            tree.merge(text);
        }
    }

    fn merge_type_other(
        &self,
        tree: &mut Tree<'a>,
        attributes: &'a Attributes,
        entries: &'a TypeEntries,
        row: usize,
        entry: Option<usize>,
    ) {
        self.merge_other(tree, attributes, row, TYPE_OTHER);
        if let Some(entry) = entry {
            self.merge_other(tree, &entries.attributes, entry, TYPE_OTHER);
        }
    }
}

/// Adds the names that a list of types lacks, each once.
pub(in crate::lif) fn add_missing<'a>(
    types: &mut Vec<(&'a str, Option<usize>)>,
    names: &[&'a str],
) {
    let mut known: HashSet<&str> = types.iter().map(|(name, _)| *name).collect();
    let missing = names.iter().filter(|name| known.insert(name));
    types.extend(missing.map(|&name| (name, None)));
}

pub(super) fn text<'a>(
    key: &'static str,
    text: impl Into<Cow<'a, str>>,
) -> (Cow<'a, str>, Tree<'a>) {
    (key.into(), Tree::Text(text.into()))
}

fn with_members<'a>(mut first: Members<'a>, rest: Tree<'a>) -> Tree<'a> {
    if let Tree::Object(rest) = rest {
        first.extend(rest);
    }
    Tree::Object(first)
}

/// The members of a position, with a resolution of one micrometer.
fn point<'a>(position: Point<f64>) -> Members<'a> {
    let number = |meters| Tree::Number(rounded(meters));
    vec![
        ("x".into(), number(position.x)),
        ("y".into(), number(position.y)),
    ]
}
