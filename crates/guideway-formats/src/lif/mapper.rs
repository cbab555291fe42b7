//! LIF mapper state: the layout under construction, and the lookups that nodes and edges share.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use guideway_layout::Layout;

use super::model::{RobotType, robot_name};
use crate::ReadError;
use crate::builder::{Builder, PlaceFn};
use crate::json::{Field, field_place, items};
use crate::node_rows::NodeRows;
use crate::source::Source;

/// Layout under construction from the records of a file.
pub(super) struct Mapper<'a> {
    pub(super) builder: Builder<'a>,
    /// First node of each id.
    pub(super) nodes: NodeRows,
    /// Nodes of later layouts with an id used before, by level and id.
    pub(super) repeated_nodes: HashMap<(u32, String), u32>,
    /// Identifiers of the levels.
    pub(super) levels: HashSet<String>,
    /// Vehicle types of edges; nodes may name types without a path.
    vehicle_types: HashSet<String>,
    pub(super) counts: Counts,
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
    /// Makes an empty layout for a file of `file_bytes` bytes.
    pub(super) fn new(source: Source<'a>, file_bytes: usize) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            nodes: NodeRows::default(),
            repeated_nodes: HashMap::new(),
            levels: HashSet::new(),
            vehicle_types: HashSet::new(),
            counts: Counts::default(),
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

    /// Returns the names of the vehicle types of an entry.
    pub(super) fn vehicle_types(
        &mut self,
        vehicle_type: &Field<Cow<'_, str>>,
        robot_types: &Field<Vec<Field<RobotType<'_>>>>,
        at: PlaceFn<'_>,
    ) -> Result<Vec<String>, ReadError> {
        let mut names = Vec::new();
        if let Some(name) = self
            .builder
            .text(vehicle_type, &|| field_place(at, "vehicleTypeId"))?
        {
            names.push(name.to_owned());
        }
        for (_, robot) in items(robot_types) {
            let Some(robot) = self
                .builder
                .record(robot, &|| field_place(at, "mobileRobotTypes"))
            else {
                continue;
            };
            let manufacturer = self
                .builder
                .text(&robot.manufacturer, &|| field_place(at, "manufacturer"))?;
            let series = self
                .builder
                .text(&robot.series, &|| field_place(at, "seriesName"))?;
            names.extend(robot_name(manufacturer, series));
        }
        for name in &names {
            if !self.vehicle_types.contains(name) {
                self.vehicle_types.insert(name.clone());
            }
        }
        Ok(names)
    }
}
