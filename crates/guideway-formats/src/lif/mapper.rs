//! LIF mapper state: the layout under construction, and the lookups that nodes and edges share.

use std::collections::{HashMap, HashSet};
use std::sync::OnceLock;

use guideway_layout::{Attributes, Layout, TypeEntries, VehicleType};

use super::members::{
    Column, EDGE, EDGE_TYPE, LAYOUT, META, NODE, NODE_TYPE, ORIGIN, STATION, STATION_POSITION,
    columns_of_any_version,
};
use super::version::Version;
use crate::builder::Builder;
use crate::input::Input;
use crate::json::Skeleton;
use crate::node_rows::NodeRows;
use crate::source::Source;

/// Layout under construction from the records of a file.
pub(super) struct Mapper<'a> {
    pub(super) builder: Builder<'a>,
    pub(super) columns: &'static Columns,
    /// First node of each id.
    pub(super) nodes: NodeRows,
    /// Nodes of later layouts with an id used before, by level and id.
    pub(super) repeated_nodes: HashMap<(u32, String), u32>,
    /// Entries of the nodes, until the types of their paths are known.
    pub(super) node_types: TypeEntries,
    /// Identifiers of the levels.
    pub(super) levels: HashSet<String>,
    /// Vehicle types of edges; nodes may name types without a path.
    pub(super) vehicle_types: HashSet<String>,
    /// Rows of the vehicle types with properties.
    type_rows: HashMap<String, usize>,
    pub(super) counts: Counts,
    pub(super) input: &'a Input<'a>,
    pub(super) skeleton: &'a Skeleton,
    /// True if the layout keeps the text, from which the lines of rows follow.
    pub(super) keeps_text: bool,
}

/// Columns of the members of each object; `None` for a member that a version lacks.
pub(super) struct Columns {
    pub(super) node: Vec<Option<Column>>,
    /// For entries of 1.0 and of 2.0.
    pub(super) node_type: [Vec<Option<Column>>; 2],
    pub(super) edge: Vec<Option<Column>>,
    /// For entries of 1.0 and of 2.0.
    pub(super) edge_type: [Vec<Option<Column>>; 2],
    pub(super) station: Vec<Option<Column>>,
    pub(super) station_position: Vec<Option<Column>>,
    pub(super) layout: Vec<Option<Column>>,
    pub(super) origin: Vec<Option<Column>>,
    pub(super) meta: Vec<Option<Column>>,
}

impl Columns {
    /// The columns, which are the same for all files.
    fn all() -> &'static Self {
        static ALL: OnceLock<Columns> = OnceLock::new();
        ALL.get_or_init(Self::new)
    }

    fn new() -> Self {
        let versions = [Version::V1, Version::V2];
        Self {
            node: columns_of_any_version(NODE),
            node_type: versions.map(|version| version.columns(NODE_TYPE)),
            edge: columns_of_any_version(EDGE),
            edge_type: versions.map(|version| version.columns(EDGE_TYPE)),
            station: columns_of_any_version(STATION),
            station_position: columns_of_any_version(STATION_POSITION),
            layout: columns_of_any_version(LAYOUT),
            origin: columns_of_any_version(ORIGIN),
            meta: columns_of_any_version(META),
        }
    }
}

/// Numbers of records, for the provenance of the layout.
#[derive(Default)]
pub(super) struct Counts {
    pub(super) nodes: usize,
    pub(super) edges: usize,
    pub(super) stations: usize,
    pub(super) trajectories: usize,
}

impl<'a> Mapper<'a> {
    /// Makes an empty layout for a file with its skeleton.
    pub(super) fn new(
        source: Source<'a>,
        input: &'a Input<'a>,
        skeleton: &'a Skeleton,
        keeps_text: bool,
    ) -> Self {
        Self {
            builder: Builder::new(source, input.len()),
            columns: Columns::all(),
            nodes: NodeRows::default(),
            repeated_nodes: HashMap::new(),
            node_types: TypeEntries::default(),
            levels: HashSet::new(),
            vehicle_types: HashSet::new(),
            type_rows: HashMap::new(),
            counts: Counts::default(),
            input,
            skeleton,
            keeps_text,
        }
    }

    /// Returns the layout, with the record counts in its provenance.
    pub(super) fn finish(mut self, layouts: usize) -> Layout {
        let counts = [
            ("layouts", layouts),
            ("nodes", self.counts.nodes),
            ("edges", self.counts.edges),
            ("stations", self.counts.stations),
            ("trajectories", self.counts.trajectories),
            ("vehicleTypes", self.vehicle_types.len()),
        ];
        self.builder.layout.provenance.counts =
            counts.map(|(name, n)| (name.to_owned(), n as u64)).to_vec();
        self.builder.layout
    }

    /// Returns the row of a node. An id that several layouts use refers to the node of this level.
    pub(super) fn node(&self, id: &str, level: u32) -> Option<u32> {
        let in_level = if self.repeated_nodes.is_empty() {
            None
        } else {
            self.repeated_nodes.get(&(level, id.to_owned()))
        };
        in_level
            .copied()
            .or_else(|| self.nodes.get(&self.builder.layout.nodes, id))
    }

    /// Attributes of a vehicle type, which is added if it is new.
    pub(super) fn vehicle_type_attributes(&mut self, name: &str) -> &mut Attributes {
        let types = &mut self.builder.layout.vehicle_types;
        let index = *self.type_rows.entry(name.to_owned()).or_insert_with(|| {
            types.push(VehicleType {
                id: name.to_owned(),
                attributes: Attributes::default(),
            });
            types.len() - 1
        });
        &mut types[index].attributes
    }
}
