//! Tables of nodes and stations, with one column per property, and the levels they lie on.

use guideway_spline::{Affine, Point};

use crate::{Attributes, TextColumn};

/// A floor of a building, or one layout of a file that has several.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Level {
    /// Identifier in the file.
    pub id: String,
    /// Human-readable name.
    pub name: Option<String>,
    /// Height above the ground in meters, if the file states it.
    pub elevation_m: Option<f64>,
}

/// Named points where paths begin, end and meet.
#[derive(Clone, Debug, Default)]
pub struct Nodes {
    ids: TextColumn,
    positions_m: Vec<Point<f64>>,
    levels: Vec<Option<u32>>,
    /// Further columns of the file.
    pub attributes: Attributes,
}

impl Nodes {
    /// Appends a node and returns its row.
    pub fn push(&mut self, id: &str, position_m: Point<f64>, level: Option<u32>) -> u32 {
        self.ids.push(id);
        self.positions_m.push(position_m);
        self.levels.push(level);
        (self.ids.len() - 1) as u32
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Whether there are no nodes.
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Identifier of a node.
    pub fn id(&self, node: u32) -> &str {
        self.ids.get(node as usize)
    }

    /// Position of a node, in meters.
    pub fn position_m(&self, node: u32) -> Point<f64> {
        self.positions_m[node as usize]
    }

    /// Maps all positions.
    pub(crate) fn transform(&mut self, by: Affine) {
        self.positions_m.iter_mut().for_each(|p| *p = by.apply(*p));
    }

    /// Index of the level of a node.
    pub fn level(&self, node: u32) -> Option<u32> {
        self.levels[node as usize]
    }

    /// Heap bytes in use.
    pub fn heap_bytes(&self) -> usize {
        self.ids.heap_bytes()
            + self.positions_m.capacity() * size_of::<Point<f64>>()
            + self.levels.capacity() * size_of::<Option<u32>>()
            + self.attributes.heap_bytes()
    }
}

/// Named places where vehicles load, unload, park or charge.
#[derive(Clone, Debug, Default)]
pub struct Stations {
    ids: TextColumn,
    positions_m: Vec<Option<Point<f64>>>,
    nodes: Vec<Vec<u32>>,
    levels: Vec<Option<u32>>,
    /// Further columns of the file.
    pub attributes: Attributes,
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

    /// Whether there are no stations.
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Identifier of a station.
    pub fn id(&self, station: u32) -> &str {
        self.ids.get(station as usize)
    }

    /// Position of a station, in meters, if the file states one.
    pub fn position_m(&self, station: u32) -> Option<Point<f64>> {
        self.positions_m[station as usize]
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

    /// Index of the level of a station.
    pub fn level(&self, station: u32) -> Option<u32> {
        self.levels[station as usize]
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
    }
}
