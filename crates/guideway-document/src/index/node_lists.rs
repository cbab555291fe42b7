//! Node adjacency: the paths or stations at each node.

use std::collections::{HashMap, HashSet};

/// Rows of the elements at each node, including removed elements. Compressed sparse rows for the
/// initial layout, plus a map of the lists that edits changed.
#[derive(Clone, Debug, Default)]
pub(super) struct NodeLists {
    /// End of each node's range in `rows`.
    ends: Vec<u32>,
    rows: Vec<u32>,
    /// Whole lists of the nodes at which edits changed something.
    changed: HashMap<u32, Vec<u32>>,
}

impl NodeLists {
    /// Lists of `node_count` nodes. `pairs` yields nodes with the rows of their elements, in
    /// increasing order of the rows; it is called twice.
    pub(super) fn new<P: Iterator<Item = (u32, u32)>>(
        node_count: usize,
        pairs: impl Fn() -> P,
    ) -> Self {
        let mut ends = vec![0; node_count];
        for (node, _) in pairs() {
            ends[node as usize] += 1;
        }
        let mut end = 0;
        let mut nexts = Vec::with_capacity(node_count);
        for count in &mut ends {
            nexts.push(end);
            end += *count;
            *count = end;
        }
        let mut rows = vec![0; end as usize];
        for (node, row) in pairs() {
            let next = &mut nexts[node as usize];
            rows[*next as usize] = row;
            *next += 1;
        }
        Self {
            ends,
            rows,
            changed: HashMap::new(),
        }
    }

    /// Adds elements: nodes, each with the row of an element.
    pub(super) fn add(&mut self, pairs: impl IntoIterator<Item = (u32, u32)>) {
        for (node, row) in pairs {
            self.list_mut(node).push(row);
        }
    }

    /// Takes elements off the nodes at which they are.
    pub(super) fn remove(&mut self, pairs: &[(u32, u32)]) {
        let rows: HashSet<u32> = pairs.iter().map(|(_, row)| *row).collect();
        let nodes: HashSet<u32> = pairs.iter().map(|(node, _)| *node).collect();
        for node in nodes {
            self.list_mut(node).retain(|row| !rows.contains(row));
        }
    }

    pub(super) fn at(&self, node: u32) -> &[u32] {
        match self.changed.get(&node) {
            Some(list) => list,
            None => self.initial(node),
        }
    }

    fn initial(&self, node: u32) -> &[u32] {
        let node = node as usize;
        let end = self.ends.get(node).copied().unwrap_or(0) as usize;
        let first = node.checked_sub(1).and_then(|before| self.ends.get(before));
        let first = (first.copied().unwrap_or(0) as usize).min(end);
        &self.rows[first..end]
    }

    fn list_mut(&mut self, node: u32) -> &mut Vec<u32> {
        let initial = match self.changed.contains_key(&node) {
            true => Vec::new(),
            false => self.initial(node).to_vec(),
        };
        self.changed.entry(node).or_insert(initial)
    }
}
