//! GeoJSON mapper state: the layout under construction, and the names that features share.

use std::collections::{HashMap, HashSet};

use guideway_layout::{GeoOrigin, Layout, Level};

use super::declared::{Declared, NODE_TYPES, NODES, PATH_TYPES, PATHS, STATIONS};
use super::extension::Reference;
use super::unit::Unit;
use crate::ReadError;
use crate::builder::{Builder, PlaceFn};
use crate::node_rows::NodeRows;
use crate::source::Source;

/// Layout under construction from the features of a file.
pub(super) struct Mapper<'a> {
    pub(super) builder: Builder<'a>,
    pub(super) unit: Unit,
    /// True for a route graph of Nav2.
    pub(super) is_graph: bool,
    /// Rows of the nodes by identifier.
    pub(super) nodes: NodeRows,
    /// Rows of the nodes of a route graph whose identifier is not their number.
    pub(super) numbered: HashMap<String, u32>,
    /// Rows of the levels by identifier.
    levels: HashMap<String, u32>,
    /// Row of each feature that is a node, a path or a station.
    pub(super) rows: Rows,
    /// Draw rank of each path.
    pub(super) ranks: Vec<i32>,
    /// Number of geometries per type.
    pub(super) counts: Vec<(String, u64)>,
    /// Number of positions in lines.
    pub(super) line_vertices: u64,
    /// Number of positions with a height.
    pub(super) heights: u64,
    pub(super) declared: Declared,
    pub(super) column_limit: usize,
    /// Names of the columns per table.
    pub(super) columns: [HashSet<String>; 5],
}

/// Row of each feature of a kind, in file order; `None` for one that is not in the layout.
#[derive(Default)]
pub(super) struct Rows {
    pub(super) nodes: Vec<Option<u32>>,
    pub(super) paths: Vec<Option<u32>>,
    pub(super) stations: Vec<Option<u32>>,
}

impl<'a> Mapper<'a> {
    /// Makes an empty layout for a file of `file_bytes` bytes.
    pub(super) fn new(source: Source<'a>, file_bytes: usize) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            unit: Unit::Meters,
            is_graph: false,
            nodes: NodeRows::default(),
            numbered: HashMap::new(),
            levels: HashMap::new(),
            rows: Rows::default(),
            ranks: Vec::new(),
            counts: Vec::new(),
            line_vertices: 0,
            heights: 0,
            declared: Declared::default(),
            column_limit: Self::column_limit(0, 0),
            columns: Default::default(),
        }
    }

    /// Sets the unit of the positions, and the place on earth that comes with it.
    pub(super) fn set_unit(&mut self, unit: Unit) {
        self.builder.layout.geo_origin = unit.origin();
        self.unit = unit;
    }

    /// Sets the place on earth of a file in meters.
    pub(super) fn set_origin(&mut self, origin: Option<GeoOrigin>) {
        self.builder.layout.geo_origin = origin;
    }

    /// Appends a level.
    pub(super) fn push_level(&mut self, level: Level) {
        let levels = &mut self.builder.layout.levels;
        let row = levels.len() as u32;
        self.levels.entry(level.id.clone()).or_insert(row);
        levels.push(level);
    }

    /// Returns the index of a level. One that the file does not list is appended.
    pub(super) fn level(&mut self, level: Option<&Reference>) -> Result<Option<u32>, ReadError> {
        let levels = self.builder.layout.levels.len() as u32;
        Ok(match level {
            None => None,
            Some(&Reference::Row(row)) => (row < levels).then_some(row),
            Some(Reference::Id(id)) => match self.levels.get(id) {
                Some(&row) => Some(row),
                None => {
                    self.builder.check_text(id)?;
                    self.push_level(Level {
                        id: id.clone(),
                        ..Level::default()
                    });
                    Some(levels)
                }
            },
        })
    }

    /// Returns the row of a node, or reports that it does not exist.
    pub(super) fn node(
        &mut self,
        node: Option<&Reference>,
        by: &str,
        at: PlaceFn<'_>,
    ) -> Option<u32> {
        let node = node?;
        let row = match node {
            Reference::Row(row) => self.rows.nodes.get(*row as usize).copied().flatten(),
            Reference::Id(id) => {
                let nodes = &self.builder.layout.nodes;
                let numbered = self.numbered.get(id).copied();
                numbered.or_else(|| self.nodes.get(nodes, id))
            }
        };
        if row.is_none() {
            let name = match node {
                Reference::Row(row) => format!("number {row}"),
                Reference::Id(id) => id.clone(),
            };
            self.builder.report_unknown_node(&name, by, at);
        }
        row
    }

    /// Sets draw ranks and declared units, and returns the layout.
    pub(super) fn into_layout(mut self) -> Layout {
        if self.ranks.iter().any(|&rank| rank != 0) {
            self.builder.layout.paths.set_rank(self.ranks);
        }
        for (owner, table) in [PATHS, PATH_TYPES, NODES, NODE_TYPES, STATIONS] {
            self.declared
                .set_units(owner, self.builder.attributes(table));
        }
        self.builder.layout
    }
}
