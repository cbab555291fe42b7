//! From the records of a LIF file to a layout: levels, nodes, stations.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use guideway_layout::{Code, Layout, Level, Place};
use guideway_spline::Point;

use super::model::{self, Node, Position, RobotType, Root, Station};
use crate::ReadError;
use crate::builder::{Builder, PlaceFn, Table};
use crate::json::{Field, items, within};
use crate::node_rows::NodeRows;
use crate::source::Source;

/// Fills a layout from the records of a file.
pub(super) struct Mapper<'a> {
    pub(super) builder: Builder<'a>,
    /// The first node of each id.
    nodes: NodeRows,
    /// Nodes of later layouts whose ids were used before.
    repeated_nodes: HashMap<(u32, String), u32>,
    levels: HashSet<String>,
    /// Of the edges: nodes may name types that have no path.
    vehicle_types: HashSet<String>,
    counts: Counts,
}

#[derive(Default)]
struct Counts {
    nodes: usize,
    edges: usize,
    stations: usize,
    trajectories: usize,
}

/// One layout of the file, with its place in it.
struct Part<'r, 'a> {
    place: String,
    layout: &'r model::Layout<'a>,
}

impl<'a> Mapper<'a> {
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

    pub(super) fn map<'t>(mut self, root: &Root<'t>, file: &'t str) -> Result<Layout, ReadError> {
        let at_root: PlaceFn<'_> = &|| Place::element("the root");
        self.builder.check_repeated(root.repeated, at_root);
        self.map_version(root)?;
        let parts = self.parts(root)?;
        // All nodes come first, for an edge may lead to a node of a later layout.
        for (level, part) in parts.iter().enumerate() {
            self.map_level(part)?;
            let mut nodes = part.layout.nodes.items(file);
            while let Some((i, node)) = nodes.next(&mut self.builder)? {
                let at = || Place::element(format!("{}.nodes[{i}]", part.place));
                self.map_node(&node, level as u32, &at)?;
            }
        }
        for (level, part) in parts.iter().enumerate() {
            let mut edges = part.layout.edges.items(file);
            while let Some((i, edge)) = edges.next(&mut self.builder)? {
                let at = || Place::element(format!("{}.edges[{i}]", part.place));
                self.map_edge(&edge, level as u32, &at)?;
            }
            let mut stations = part.layout.stations.items(file);
            while let Some((i, station)) = stations.next(&mut self.builder)? {
                let at = || Place::element(format!("{}.stations[{i}]", part.place));
                self.map_station(&station, level as u32, &at)?;
            }
        }
        Ok(self.finish(parts.len()))
    }

    fn finish(mut self, layouts: usize) -> Layout {
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

    fn map_version(&mut self, root: &Root<'_>) -> Result<(), ReadError> {
        let version = if root.origins.is_absent() {
            "1.0"
        } else {
            "2.0"
        };
        let provenance = &mut self.builder.layout.provenance;
        crate::Format::Lif.name().clone_into(&mut provenance.format);
        version.clone_into(&mut provenance.format_version);
        self.builder.check_type(
            &root.meta,
            &|| Place::element("metaInformation"),
            "an object",
        );
        let Some(meta) = root.meta.get() else {
            return Ok(());
        };
        let at: PlaceFn<'_> = &|| Place::element("metaInformation.lifVersion");
        let stated = self.builder.text(&meta.lif_version, at)?;
        if let Some(stated) = stated.filter(|s| s.split('.').next() != version.split('.').next()) {
            let message =
                || format!("the file states version {stated}, its structure is {version}");
            let remedy = "Nothing to do: the structure counts";
            self.builder.report(Code::Version, at, message, remedy);
        }
        Ok(())
    }

    fn parts<'r, 't>(&mut self, root: &'r Root<'t>) -> Result<Vec<Part<'r, 't>>, ReadError> {
        let mut parts = Vec::new();
        self.collect(&root.layouts, "layouts", &mut parts);
        for (i, origin) in items(&root.origins) {
            let place = format!("origins[{i}]");
            let at: PlaceFn<'_> = &|| Place::element(place.as_str());
            if let Some(origin) = self.builder.record(origin, at) {
                self.builder.check_repeated(origin.repeated, at);
                self.builder.check_list(&origin.layouts, at, "layouts");
                self.collect(&origin.layouts, &format!("{place}.layouts"), &mut parts);
            }
        }
        for part in &parts {
            let at: PlaceFn<'_> = &|| Place::element(part.place.as_str());
            self.builder.check_repeated(part.layout.repeated, at);
            self.builder.check_list(&part.layout.nodes, at, "nodes");
            self.builder.check_list(&part.layout.edges, at, "edges");
            self.builder
                .check_list(&part.layout.stations, at, "stations");
        }
        Ok(parts)
    }

    fn collect<'r, 't>(
        &mut self,
        list: &'r Field<Vec<Field<model::Layout<'t>>>>,
        name: &str,
        parts: &mut Vec<Part<'r, 't>>,
    ) {
        for (i, layout) in items(list) {
            let place = format!("{name}[{i}]");
            if let Some(layout) = self
                .builder
                .record(layout, &|| Place::element(place.as_str()))
            {
                parts.push(Part { place, layout });
            }
        }
    }

    fn map_level(&mut self, part: &Part<'_, '_>) -> Result<(), ReadError> {
        let at: PlaceFn<'_> = &|| Place::element(part.place.as_str());
        let id = self.builder.id(&part.layout.id, at, "layoutId")?;
        let name = self
            .builder
            .text(&part.layout.name, &|| within(at, "layoutName"))?;
        let new = self.levels.insert(id.clone().into_owned());
        if !new {
            let message = || format!("the layoutId `{id}` is used more than once");
            let remedy = "Both are kept, and `--level` shows the first; rename one";
            self.builder.report(Code::DuplicateId, at, message, remedy);
        }
        self.builder.layout.levels.push(Level {
            id: id.into_owned(),
            name: name.map(str::to_owned),
            elevation_m: None,
        });
        Ok(())
    }

    fn map_node(
        &mut self,
        node: &Field<Node<'_>>,
        level: u32,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        self.counts.nodes += 1;
        let Some(node) = self.builder.record(node, at) else {
            return Ok(());
        };
        self.builder.check_repeated(node.repeated, at);
        let id = self.builder.id(&node.id, at, "nodeId")?;
        let Some(position) = self.position(&node.position, &|| within(at, "nodePosition"), true)
        else {
            return Ok(());
        };
        let row = self.builder.push_node(&id, position, Some(level))?;
        let nodes = &self.builder.layout.nodes;
        let first = self.nodes.get(nodes, &id);
        match first.map(|row| nodes.level(row)) {
            None => self.nodes.insert(nodes, row),
            Some(Some(other)) if other != level => {
                let key = (level, id.into_owned());
                self.repeated_nodes.entry(key).or_insert(row);
            }
            Some(_) => {}
        }
        let (name, map) = (&node.name, &node.map_id);
        self.builder
            .set_text(Table::Nodes, row as usize, "nodeName", name, at)?;
        self.builder
            .set_text(Table::Nodes, row as usize, "mapId", map, at)
    }

    /// The row of a node. Ids should be unique in a file; where they are not, the layout's own counts.
    pub(super) fn node(&self, id: &str, level: u32) -> Option<u32> {
        let own = if self.repeated_nodes.is_empty() {
            None
        } else {
            self.repeated_nodes.get(&(level, id.to_owned()))
        };
        own.copied()
            .or_else(|| self.nodes.get(&self.builder.layout.nodes, id))
    }

    fn map_station(
        &mut self,
        station: &Field<Station<'_>>,
        level: u32,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        self.counts.stations += 1;
        let Some(station) = self.builder.record(station, at) else {
            return Ok(());
        };
        self.builder.check_repeated(station.repeated, at);
        self.builder
            .check_list(&station.nodes, at, "interactionNodeIds");
        let id = self.builder.id(&station.id, at, "stationId")?;
        let mut nodes = Vec::new();
        for (i, name) in items(&station.nodes) {
            let at_name: PlaceFn<'_> = &|| within(at, &format!("interactionNodeIds[{i}]"));
            let Some(name) = self.builder.text(name, at_name)? else {
                continue;
            };
            match self.node(name, level) {
                Some(row) => nodes.push(row),
                None => self.builder.report_unknown_node(name, &id, at_name),
            }
        }
        let at_position: PlaceFn<'_> = &|| within(at, "stationPosition");
        let position = self.position(&station.position, at_position, false);
        let row = self
            .builder
            .push_station(&id, position, nodes, Some(level))? as usize;
        self.builder
            .set_text(Table::Stations, row, "stationName", &station.name, at)?;
        self.builder
            .set_text(Table::Stations, row, "stationType", &station.kind, at)?;
        let height = &station.height;
        self.builder
            .set_number(Table::Stations, row, "stationHeight", height, at)
    }

    pub(super) fn count_edge(&mut self) {
        self.counts.edges += 1;
    }

    pub(super) fn count_trajectory(&mut self) {
        self.counts.trajectories += 1;
    }

    /// The names of the vehicle types that one entry is for.
    pub(super) fn vehicle_types(
        &mut self,
        vehicle_type: &Field<Cow<'_, str>>,
        robot_types: &Field<Vec<Field<RobotType<'_>>>>,
        at: PlaceFn<'_>,
    ) -> Result<Vec<String>, ReadError> {
        let mut names = Vec::new();
        if let Some(name) = self
            .builder
            .text(vehicle_type, &|| within(at, "vehicleTypeId"))?
        {
            names.push(name.to_owned());
        }
        for (_, robot) in items(robot_types) {
            let Some(robot) = self
                .builder
                .record(robot, &|| within(at, "mobileRobotTypes"))
            else {
                continue;
            };
            let manufacturer = self
                .builder
                .text(&robot.manufacturer, &|| within(at, "manufacturer"))?;
            let series = self
                .builder
                .text(&robot.series, &|| within(at, "seriesName"))?;
            names.extend(model::robot_name(manufacturer, series));
        }
        for name in &names {
            if !self.vehicle_types.contains(name) {
                self.vehicle_types.insert(name.clone());
            }
        }
        Ok(names)
    }

    fn position(
        &mut self,
        field: &Field<Position>,
        at: PlaceFn<'_>,
        needed: bool,
    ) -> Option<Point<f64>> {
        if field.is_absent() && !needed {
            return None;
        }
        let position = self.builder.record(field, at)?;
        self.builder.check_repeated(position.repeated, at);
        self.builder.point(&position.x, &position.y, at)
    }
}
