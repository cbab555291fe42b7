//! [`Nodes`]: the table of nodes, with one column per property.

use guideway_spline::{Affine, Point};

use crate::{Attributes, SourceSpans, TextColumn, TypeEntries};

/// Named points where paths begin, end and meet.
#[derive(Clone, Debug, Default)]
pub struct Nodes {
    ids: TextColumn,
    positions_m: Vec<Point<f64>>,
    levels: Vec<Option<u32>>,
    vehicle_types: TypeEntries,
    /// Further columns.
    pub attributes: Attributes,
    /// Places of the nodes in the text of their file.
    pub source: SourceSpans,
}

impl Nodes {
    /// Appends a node for all vehicle types and returns its row.
    pub fn push(&mut self, id: &str, position_m: Point<f64>, level: Option<u32>) -> u32 {
        self.push_for_types(id, position_m, level, &[])
    }

    /// Appends a node with an entry per vehicle type and returns its row.
    pub fn push_for_types(
        &mut self,
        id: &str,
        position_m: Point<f64>,
        level: Option<u32>,
        vehicle_types: &[&str],
    ) -> u32 {
        self.ids.push(id);
        self.positions_m.push(position_m);
        self.levels.push(level);
        self.vehicle_types.push(vehicle_types);
        (self.ids.len() - 1) as u32
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Returns `true` if there are no nodes.
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Identifier of a node.
    pub fn id(&self, node: u32) -> &str {
        self.ids.get(node as usize)
    }

    /// Replaces the identifiers of some nodes, in increasing order. Cost: O(all identifiers).
    pub fn set_ids(&mut self, ids: &[(u32, &str)]) {
        let rows: Vec<_> = ids.iter().map(|&(node, id)| (node as usize, id)).collect();
        self.ids.replace(&rows);
    }

    /// Position of a node, in meters.
    pub fn position_m(&self, node: u32) -> Point<f64> {
        self.positions_m[node as usize]
    }

    /// Moves a node to a position in meters.
    pub fn set_position_m(&mut self, node: u32, position_m: Point<f64>) {
        self.positions_m[node as usize] = position_m;
    }

    /// Maps all positions.
    pub(crate) fn transform(&mut self, by: Affine) {
        self.positions_m.iter_mut().for_each(|p| *p = by.apply(*p));
    }

    /// Index of the level of a node.
    pub fn level(&self, node: u32) -> Option<u32> {
        self.levels[node as usize]
    }

    /// Maps the level of each node that has one.
    pub(crate) fn renumber_levels(&mut self, row: impl Fn(u32) -> Option<u32>) {
        let levels = self.levels.iter_mut();
        levels.for_each(|level| *level = level.and_then(&row));
    }

    /// Sets the level of a node.
    pub fn set_level(&mut self, node: u32, level: Option<u32>) {
        self.levels[node as usize] = level;
    }

    /// The vehicle types that have properties of their own at each node. Unlike a path, a node is
    /// open to all types, whatever its entries.
    pub fn vehicle_types(&self) -> &TypeEntries {
        &self.vehicle_types
    }

    /// The entries per vehicle type, to edit.
    pub fn vehicle_types_mut(&mut self) -> &mut TypeEntries {
        &mut self.vehicle_types
    }

    /// The given nodes, in this order.
    ///
    /// # Panics
    /// When a row is not below [`Self::len`].
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        Self {
            ids: rows.iter().map(|&row| self.ids.get(row)).collect(),
            positions_m: rows.iter().map(|&row| self.positions_m[row]).collect(),
            levels: rows.iter().map(|&row| self.levels[row]).collect(),
            vehicle_types: self.vehicle_types.select(rows),
            attributes: self.attributes.select(rows),
            source: self.source.select(rows),
        }
    }

    /// Appends all nodes of another table, whose levels are renumbered by `level`.
    pub(crate) fn append(&mut self, other: &Self, level: impl Fn(Option<u32>) -> Option<u32>) {
        let first = self.len();
        for node in 0..other.len() {
            self.ids.push(other.ids.get(node));
            self.levels.push(level(other.levels[node]));
        }
        self.positions_m.extend_from_slice(&other.positions_m);
        self.vehicle_types.append(&other.vehicle_types);
        self.attributes.extend(first, &other.attributes);
    }

    /// Heap bytes in use.
    pub fn heap_bytes(&self) -> usize {
        self.ids.heap_bytes()
            + self.positions_m.capacity() * size_of::<Point<f64>>()
            + self.levels.capacity() * size_of::<Option<u32>>()
            + self.vehicle_types.heap_bytes()
            + self.attributes.heap_bytes()
            + self.source.heap_bytes()
    }
}
