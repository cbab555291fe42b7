//! LIF mapping: adds the levels, nodes, edges and stations of a file to the layout.

use guideway_layout::{Code, Layout, Level, Place};
use guideway_spline::Point;

use super::mapper::Mapper;
use super::model::{self, Node, Position, Root, Station};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::json::{Field, field_place, items};

/// A layout record with its place in the file. Each maps to a level.
struct LayoutEntry<'r, 'a> {
    place: String,
    record: &'r model::Layout<'a>,
}

impl Mapper<'_> {
    /// Maps the root object to a layout; `file` is the whole text, which the lazy arrays refer to.
    pub(super) fn map<'t>(mut self, root: &Root<'t>, file: &'t str) -> Result<Layout, ReadError> {
        let at_root: PlaceFn<'_> = &|| Place::element("the root");
        self.builder.check_repeated(root.repeated, at_root);
        self.map_version(root)?;
        let layouts = self.layouts(root)?;
        // All nodes come first: an edge may lead to a node of a later layout.
        for (level, entry) in layouts.iter().enumerate() {
            self.map_level(entry)?;
            let mut nodes = entry.record.nodes.items(file);
            while let Some((i, node)) = nodes.next(&mut self.builder)? {
                let at = || Place::element(format!("{}.nodes[{i}]", entry.place));
                self.map_node(&node, level as u32, &at)?;
            }
        }
        for (level, entry) in layouts.iter().enumerate() {
            let mut edges = entry.record.edges.items(file);
            while let Some((i, edge)) = edges.next(&mut self.builder)? {
                let at = || Place::element(format!("{}.edges[{i}]", entry.place));
                self.map_edge(&edge, level as u32, &at)?;
            }
            let mut stations = entry.record.stations.items(file);
            while let Some((i, station)) = stations.next(&mut self.builder)? {
                let at = || Place::element(format!("{}.stations[{i}]", entry.place));
                self.map_station(&station, level as u32, &at)?;
            }
        }
        Ok(self.finish(layouts.len()))
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
                || format!("the file states version {stated}, but its structure is {version}");
            let remedy = "None needed: the structure decides the version";
            self.builder.report(Code::Version, at, message, remedy);
        }
        Ok(())
    }

    fn layouts<'r, 't>(
        &mut self,
        root: &'r Root<'t>,
    ) -> Result<Vec<LayoutEntry<'r, 't>>, ReadError> {
        let mut layouts = Vec::new();
        self.collect(&root.layouts, "layouts", &mut layouts);
        for (i, origin) in items(&root.origins) {
            let place = format!("origins[{i}]");
            let at: PlaceFn<'_> = &|| Place::element(place.as_str());
            if let Some(origin) = self.builder.record(origin, at) {
                self.builder.check_repeated(origin.repeated, at);
                self.builder.check_array(&origin.layouts, at, "layouts");
                self.collect(&origin.layouts, &format!("{place}.layouts"), &mut layouts);
            }
        }
        for entry in &layouts {
            let at: PlaceFn<'_> = &|| Place::element(entry.place.as_str());
            self.builder.check_repeated(entry.record.repeated, at);
            self.builder.check_array(&entry.record.nodes, at, "nodes");
            self.builder.check_array(&entry.record.edges, at, "edges");
            self.builder
                .check_array(&entry.record.stations, at, "stations");
        }
        Ok(layouts)
    }

    fn collect<'r, 't>(
        &mut self,
        list: &'r Field<Vec<Field<model::Layout<'t>>>>,
        name: &str,
        layouts: &mut Vec<LayoutEntry<'r, 't>>,
    ) {
        for (i, layout) in items(list) {
            let place = format!("{name}[{i}]");
            if let Some(record) = self
                .builder
                .record(layout, &|| Place::element(place.as_str()))
            {
                layouts.push(LayoutEntry { place, record });
            }
        }
    }

    fn map_level(&mut self, entry: &LayoutEntry<'_, '_>) -> Result<(), ReadError> {
        let at: PlaceFn<'_> = &|| Place::element(entry.place.as_str());
        let id = self.builder.id(&entry.record.id, at, "layoutId")?;
        let name = self
            .builder
            .text(&entry.record.name, &|| field_place(at, "layoutName"))?;
        let new = self.levels.insert(id.clone().into_owned());
        if !new {
            let message = || format!("the layoutId `{id}` occurs more than once");
            let remedy = "Both levels are read and `--level` shows the first; rename one";
            self.builder.report(Code::DuplicateId, at, message, remedy);
        }
        self.builder.layout.levels.push(Level {
            id: id.into_owned(),
            name: name.map(str::to_owned),
            elevation_m: None,
            attributes: guideway_layout::Attributes::default(),
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
        let Some(position) =
            self.position(&node.position, &|| field_place(at, "nodePosition"), true)
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
            .check_array(&station.nodes, at, "interactionNodeIds");
        let id = self.builder.id(&station.id, at, "stationId")?;
        let mut nodes = Vec::new();
        for (i, name) in items(&station.nodes) {
            let at_name: PlaceFn<'_> = &|| field_place(at, &format!("interactionNodeIds[{i}]"));
            let Some(name) = self.builder.text(name, at_name)? else {
                continue;
            };
            match self.node(name, level) {
                Some(row) => nodes.push(row),
                None => self.builder.report_unknown_node(name, &id, at_name),
            }
        }
        let at_position: PlaceFn<'_> = &|| field_place(at, "stationPosition");
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
