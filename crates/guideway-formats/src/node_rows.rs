//! Node lookup: finds the row of a node by its identifier.

use std::hash::BuildHasher;

use guideway_layout::Nodes;
use hashbrown::{DefaultHashBuilder, HashTable};

/// The first row of each id. The ids stay in the table of nodes, so an entry takes four bytes.
#[derive(Default)]
pub(crate) struct NodeRows {
    rows: HashTable<u32>,
    /// Seeded at random, so that no file can contain names chosen to collide.
    hasher: DefaultHashBuilder,
}

impl NodeRows {
    /// Returns the first inserted row with this id.
    pub(crate) fn get(&self, nodes: &Nodes, id: &str) -> Option<u32> {
        let same = |&row: &u32| nodes.id(row) == id;
        self.rows.find(self.hasher.hash_one(id), same).copied()
    }

    /// Inserts a row under its id, unless an earlier row has that id.
    pub(crate) fn insert(&mut self, nodes: &Nodes, row: u32) {
        let id = nodes.id(row);
        let same = |&row: &u32| nodes.id(row) == id;
        let hash = |&row: &u32| self.hasher.hash_one(nodes.id(row));
        self.rows.entry(hash(&row), same, hash).or_insert(row);
    }
}

#[cfg(test)]
mod tests {
    use guideway_spline::Point;

    use super::*;

    #[test]
    fn get_returns_the_first_row_of_an_id() {
        let (mut nodes, mut rows) = (Nodes::default(), NodeRows::default());
        let names: Vec<String> = (0..1000).map(|i| format!("n{}", i % 700)).collect();
        for name in &names {
            let row = nodes.push(name, Point::new(0.0, 0.0), None);
            rows.insert(&nodes, row);
        }
        for (row, name) in names.iter().enumerate() {
            assert_eq!(rows.get(&nodes, name), Some(row as u32 % 700));
        }
        assert_eq!(rows.get(&nodes, "n700"), None);
    }
}
