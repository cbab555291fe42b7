use std::collections::HashMap;

use guideway_layout::{Layout, PathRef};

/// Which paths begin or end at a node, removed ones among them.
#[derive(Clone, Debug, Default)]
pub(super) struct Joints {
    /// Where the rows of each node end, in `rows`.
    ends: Vec<u32>,
    rows: Vec<u32>,
    /// PathSet that came later.
    added: HashMap<u32, Vec<u32>>,
}

impl Joints {
    pub(super) fn new(layout: &Layout) -> Self {
        let mut ends = vec![0; layout.nodes.len()];
        for node in layout.paths.iter().flat_map(nodes_of) {
            ends[node as usize] += 1;
        }
        let mut end = 0;
        for count in &mut ends {
            end += *count;
            *count = end;
        }
        // From the back, so that each list ends where it is to end and is in order.
        let mut firsts = ends.clone();
        let mut rows = vec![0; end as usize];
        for row in (0..layout.paths.len()).rev() {
            for node in nodes_of(layout.paths.get(row)) {
                let first = &mut firsts[node as usize];
                *first -= 1;
                rows[*first as usize] = row as u32;
            }
        }
        Self {
            ends,
            rows,
            added: HashMap::new(),
        }
    }

    pub(super) fn add(&mut self, path: PathRef<'_>) {
        for node in nodes_of(path) {
            self.added.entry(node).or_default().push(path.row() as u32);
        }
    }

    pub(super) fn paths_at(&self, node: u32) -> impl Iterator<Item = u32> {
        let node = node as usize;
        let end = self.ends.get(node).copied().unwrap_or(0) as usize;
        let first = node.checked_sub(1).and_then(|before| self.ends.get(before));
        let first = (first.copied().unwrap_or(0) as usize).min(end);
        let added = self.added.get(&(node as u32));
        let added = added.map_or(&[][..], Vec::as_slice);
        self.rows[first..end].iter().chain(added).copied()
    }
}

/// The nodes of a path, each once.
pub(crate) fn nodes_of(path: PathRef<'_>) -> impl Iterator<Item = u32> {
    let end = path
        .end_node()
        .filter(|_| path.end_node() != path.start_node());
    path.start_node().into_iter().chain(end)
}
