//! LIF nodes: maps a node with its properties per vehicle type.

use super::mapper::Mapper;
use super::members::OTHER;
use super::model::{NODE_PROPERTIES, Node, Position};
use super::type_entries::{TypesOfElement, other_cell};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::json::{LazyItem, OtherMembers, field_place, items};

impl Mapper<'_> {
    /// Maps a node; one without a position is left out.
    pub(super) fn map_node(
        &mut self,
        item: &LazyItem<'_, Node<'_>>,
        level: u32,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        self.counts.nodes += 1;
        let Some(node) = self.builder.record(&item.record, at) else {
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
        let row = self.builder.push_node(&id, point, Some(level))?;
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
        let row = row as usize;
        let mut other = OtherMembers::default();
        add_nested(&mut other, "nodePosition", position);
        let mut cells = self.cells(&node.attributes, &self.columns.node, &mut other, at)?;
        self.map_node_types(item, node, row, &mut other, at)?;
        cells.extend(other_cell(other, OTHER));
        for cell in &cells {
            cell.set(self, Table::Nodes, row)?;
        }
        Ok(())
    }

    /// Adds the entries of a node, whose row is the next one.
    fn map_node_types(
        &mut self,
        item: &LazyItem<'_, Node<'_>>,
        node: &Node<'_>,
        row: usize,
        other: &mut OtherMembers,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let mut types = TypesOfElement::default();
        let mut cells = Vec::new();
        for (v, list) in [&node.types_1, &node.types_2].into_iter().enumerate() {
            let key = NODE_PROPERTIES[v];
            self.builder.check_array(list, at, key);
            for (i, field) in items(list) {
                let at: PlaceFn<'_> = &|| field_place(at, &format!("{key}[{i}]"));
                let Some(entry) = self.builder.record(field, at) else {
                    continue;
                };
                self.builder.check_repeated(entry.repeated, at);
                let names = self.vehicle_types(&entry.vehicle_type, &entry.robot_types, at)?;
                if !types.add_all(names, cells.len()) {
                    self.report_surplus_entry(None, at);
                    other.add_item(key, item.array_item(key, i));
                    continue;
                }
                cells.push(self.type_cells(&entry.attributes, &self.columns.node_type[v], at)?);
            }
        }
        let types = types.list;
        let names: Vec<&str> = types.iter().map(|of| of.name.as_str()).collect();
        self.node_types.push(&names);
        let first = self.node_types.entries(row).start;
        self.set_type_cells([Table::Nodes, Table::NodeTypes], row, first, &types, &cells)
    }
}

/// Adds the members of a position that the format does not define.
fn add_nested(other: &mut OtherMembers, key: &str, position: &Position<'_>) {
    if position.attributes.has_other() {
        let mut nested = OtherMembers::default();
        position.attributes.add_other(&mut nested);
        if let Some(text) = nested.into_text() {
            other.add(None, key, &text);
        }
    }
}
