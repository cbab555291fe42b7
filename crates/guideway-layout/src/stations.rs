//! [`Stations`]: the table of stations, with one column per property.

use guideway_spline::{Affine, Point};

use crate::{Attributes, SourceSpans, TextColumn};

/// Named places where vehicles load, unload, park or charge.
#[derive(Clone, Debug, Default)]
pub struct Stations {
    ids: TextColumn,
    positions_m: Vec<Option<Point<f64>>>,
    nodes: Vec<Vec<u32>>,
    levels: Vec<Option<u32>>,
    /// Further columns.
    pub attributes: Attributes,
    /// Places of the stations in the text of their file.
    pub source: SourceSpans,
}

impl Stations {
    /// Appends a station with the nodes that serve it, and returns its row.
    pub fn push(
        &mut self,
        id: &str,
        position_m: Option<Point<f64>>,
        nodes: Vec<u32>,
        level: Option<u32>,
    ) -> u32 {
        self.ids.push(id);
        self.positions_m.push(position_m);
        self.nodes.push(nodes);
        self.levels.push(level);
        (self.ids.len() - 1) as u32
    }

    /// Number of stations.
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Returns `true` if there are no stations.
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Identifier of a station.
    pub fn id(&self, station: u32) -> &str {
        self.ids.get(station as usize)
    }

    /// Replaces the identifiers of some stations, in increasing order. Cost: O(all identifiers).
    pub fn set_ids(&mut self, ids: &[(u32, &str)]) {
        let rows: Vec<_> = ids.iter().map(|&(row, id)| (row as usize, id)).collect();
        self.ids.replace(&rows);
    }

    /// Position of a station, in meters, if the file states one.
    pub fn position_m(&self, station: u32) -> Option<Point<f64>> {
        self.positions_m[station as usize]
    }

    /// Moves a station to a position in meters, or removes its position.
    pub fn set_position_m(&mut self, station: u32, position_m: Option<Point<f64>>) {
        self.positions_m[station as usize] = position_m;
    }

    /// Maps all positions.
    pub(crate) fn transform(&mut self, by: Affine) {
        let positions_m = self.positions_m.iter_mut().flatten();
        positions_m.for_each(|p| *p = by.apply(*p));
    }

    /// Rows of the nodes that serve a station.
    pub fn nodes(&self, station: u32) -> &[u32] {
        &self.nodes[station as usize]
    }

    /// Sets the nodes that serve a station.
    pub fn set_nodes(&mut self, station: u32, nodes: Vec<u32>) {
        self.nodes[station as usize] = nodes;
    }

    /// Index of the level of a station.
    pub fn level(&self, station: u32) -> Option<u32> {
        self.levels[station as usize]
    }

    /// Maps the level of each station that has one.
    pub(crate) fn renumber_levels(&mut self, row: impl Fn(u32) -> Option<u32>) {
        let levels = self.levels.iter_mut();
        levels.for_each(|level| *level = level.and_then(&row));
    }

    /// Sets the level of a station.
    pub fn set_level(&mut self, station: u32, level: Option<u32>) {
        self.levels[station as usize] = level;
    }

    /// The given stations, in this order. `node` maps a row of a node to its new row, if it stays.
    ///
    /// # Panics
    /// When a row is not below [`Self::len`].
    #[must_use]
    pub fn select(&self, rows: &[usize], node: impl Fn(u32) -> Option<u32>) -> Self {
        let nodes = |&row: &usize| self.nodes[row].iter().filter_map(|&n| node(n)).collect();
        Self {
            ids: rows.iter().map(|&row| self.ids.get(row)).collect(),
            positions_m: rows.iter().map(|&row| self.positions_m[row]).collect(),
            nodes: rows.iter().map(nodes).collect(),
            levels: rows.iter().map(|&row| self.levels[row]).collect(),
            attributes: self.attributes.select(rows),
            source: self.source.select(rows),
        }
    }

    /// Heap bytes in use.
    pub fn heap_bytes(&self) -> usize {
        self.ids.heap_bytes()
            + self.positions_m.capacity() * size_of::<Option<Point<f64>>>()
            + self
                .nodes
                .iter()
                .map(|n| n.capacity() * size_of::<u32>())
                .sum::<usize>()
            + self.attributes.heap_bytes()
            + self.source.heap_bytes()
    }
}
