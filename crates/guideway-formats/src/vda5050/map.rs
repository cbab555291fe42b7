//! VDA 5050 mapping: adds the levels, nodes and edges of an order to the layout.

use guideway_layout::{Code, Layout, Level, Place};

use super::mapper::Mapper;
use super::model::{Node, Position, Root};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::json::{Field, field_place, items};

impl Mapper<'_> {
    /// Maps the root object to a layout.
    pub(super) fn map(mut self, root: &Root<'_>) -> Result<Layout, ReadError> {
        let at_root: PlaceFn<'_> = &|| Place::element("the root");
        self.builder.check_repeated(root.repeated, at_root);
        self.map_version(root)?;
        for (i, node) in items(&root.nodes) {
            self.map_node(node, &|| Place::element(format!("nodes[{i}]")))?;
        }
        for (i, edge) in items(&root.edges) {
            self.map_edge(edge, &|| Place::element(format!("edges[{i}]")))?;
        }
        let edges = items(&root.edges).filter_map(|(_, edge)| edge.get());
        let counts = [
            ("nodes", items(&root.nodes).count()),
            ("edges", items(&root.edges).count()),
            (
                "trajectories",
                edges.filter(|e| e.trajectory.get().is_some()).count(),
            ),
        ];
        self.builder.layout.provenance.counts =
            counts.map(|(name, n)| (name.to_owned(), n as u64)).to_vec();
        Ok(self.builder.layout)
    }

    /// Sets the version: the stated one, unless the keys of the edges contradict it.
    fn map_version(&mut self, root: &Root<'_>) -> Result<(), ReadError> {
        let at: PlaceFn<'_> = &|| Place::element("version");
        let stated = self.builder.text(&root.version, at)?.unwrap_or_default();
        let edges = || items(&root.edges).filter_map(|(_, edge)| edge.get());
        let names_nodes = edges().any(|e| !e.start.is_absent() || !e.end.is_absent());
        let has_edges = edges().next().is_some();
        let (majors, found): (&[&str], _) = match (names_nodes, has_edges) {
            (true, _) => (&["1", "2"], "1.1 to 2.1"),
            (false, true) => (&["3"], "3.0"),
            (false, false) => (&["1", "2", "3"], "1.1 to 3.0"),
        };
        let fits = majors.contains(&stated.split('.').next().unwrap_or_default());
        if !fits && !stated.is_empty() {
            let message =
                || format!("the order states version `{stated}`, but its structure is {found}");
            let remedy = "None needed: the structure decides the version";
            self.builder.report(Code::Version, at, message, remedy);
        }
        let provenance = &mut self.builder.layout.provenance;
        crate::Format::Vda5050
            .name()
            .clone_into(&mut provenance.format);
        let version = if fits { stated } else { found };
        version.clone_into(&mut provenance.format_version);
        Ok(())
    }

    fn map_node(&mut self, node: &Field<Node<'_>>, at: PlaceFn<'_>) -> Result<(), ReadError> {
        let Some(node) = self.builder.record(node, at) else {
            return Ok(());
        };
        self.builder.check_repeated(node.repeated, at);
        let id = self.builder.id(&node.id, at, "nodeId")?;
        let at_position: PlaceFn<'_> = &|| field_place(at, "nodePosition");
        let Some(position) = self.builder.record(&node.position, at_position) else {
            return Ok(());
        };
        self.builder.check_repeated(position.repeated, at_position);
        let Some(point) = self.builder.point(&position.x, &position.y, at_position) else {
            return Ok(());
        };
        let level = self.level(position, at_position)?;
        let sequence = self.sequence(&node.sequence, at);
        let nodes = &self.builder.layout.nodes;
        let known = self.nodes.get(nodes, &id);
        if let Some(row) = known.filter(|&row| nodes.position_m(row) == point) {
            // The order passes the node again.
            self.sequence.extend(sequence.map(|number| (number, row)));
            return Ok(());
        }
        let row = self.builder.push_node(&id, point, level)?;
        self.nodes.insert(&self.builder.layout.nodes, row);
        self.sequence.extend(sequence.map(|number| (number, row)));
        let row = row as usize;
        self.set_sequence(Table::Nodes, row, sequence)?;
        let (of_node, of_position) = (&node.attributes, &position.attributes);
        self.builder.set_attributes(Table::Nodes, row, of_node)?;
        self.builder.set_attributes(Table::Nodes, row, of_position)
    }

    fn level(
        &mut self,
        position: &Position<'_>,
        at: PlaceFn<'_>,
    ) -> Result<Option<u32>, ReadError> {
        let id = self
            .builder
            .text(&position.map_id, &|| field_place(at, "mapId"))?;
        let Some(id) = id else { return Ok(None) };
        if let Some(&level) = self.maps.get(id) {
            return Ok(Some(level));
        }
        let levels = &mut self.builder.layout.levels;
        let level = levels.len() as u32;
        levels.push(Level {
            id: id.to_owned(),
            ..Level::default()
        });
        self.maps.insert(id.to_owned(), level);
        Ok(Some(level))
    }
}
