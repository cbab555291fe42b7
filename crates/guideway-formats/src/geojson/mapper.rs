//! GeoJSON mapper state: the layout under construction, and the columns that features share.

use std::collections::HashSet;

use guideway_layout::Code;

use super::properties::{Properties, Property};
use super::unit::Unit;
use crate::ReadError;
use crate::builder::{Builder, PlaceFn, Table};
use crate::node_rows::NodeRows;
use crate::source::Source;

/// Largest number of columns per table; a file could else create columns without end.
const MAX_COLUMNS: usize = 64;

/// Layout under construction from the features of a file.
pub(super) struct Mapper<'a> {
    pub(super) builder: Builder<'a>,
    pub(super) unit: Unit,
    /// True for a route graph of Nav2.
    pub(super) is_graph: bool,
    /// Rows of the nodes of a route graph by identifier.
    pub(super) nodes: NodeRows,
    /// Number of geometries per type.
    pub(super) counts: Vec<(String, u64)>,
    /// Number of positions in lines.
    pub(super) line_vertices: u64,
    /// Number of positions with a height.
    pub(super) heights: u64,
    /// Names of the columns of paths and of nodes.
    columns: [HashSet<String>; 2],
}

impl<'a> Mapper<'a> {
    /// Makes an empty layout for a file of `file_bytes` bytes.
    pub(super) fn new(source: Source<'a>, file_bytes: usize) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            unit: Unit::Meters,
            is_graph: false,
            nodes: NodeRows::default(),
            counts: Vec::new(),
            line_vertices: 0,
            heights: 0,
            columns: [HashSet::new(), HashSet::new()],
        }
    }

    /// Sets a column per property, except those that the layout holds elsewhere.
    pub(super) fn set_properties(
        &mut self,
        table: Table,
        row: usize,
        properties: &Properties<'_>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let mut ignored = properties.ignored;
        for (name, property) in properties.iter() {
            let is_modeled = name == "id" || self.is_graph && matches!(name, "startid" | "endid");
            let Some(value) = property.value().filter(|_| !is_modeled) else {
                continue;
            };
            let columns = &mut self.columns[usize::from(matches!(table, Table::Nodes))];
            if !columns.contains(name) {
                if columns.len() == MAX_COLUMNS {
                    ignored += 1;
                    continue;
                }
                columns.insert(name.to_owned());
            }
            if let Property::Text(text) = property {
                self.builder.check_text(text)?;
            }
            self.builder.set(table, row, name, value)?;
        }
        if ignored > 0 {
            let message = || {
                format!(
                    "{ignored} properties exceed the limit of {MAX_COLUMNS} columns or of names"
                )
            };
            let remedy = "They are ignored; remove properties, or shorten their names";
            self.builder.report(Code::Attribute, at, message, remedy);
        }
        Ok(())
    }
}
