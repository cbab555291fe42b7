//! Site mapper state: the layout under construction, and the counts of a site.

use std::collections::{BTreeMap, HashSet};

use super::reader::SiteReader;
use crate::source::Source;

/// Graphs counted by number; the editor has nine.
const MAX_GRAPHS: usize = 64;

/// Fills a layout from a file.
pub(super) struct SiteMapper<'a, 'y> {
    pub(super) reader: SiteReader<'a, 'y>,
    pub(super) lift_names: HashSet<&'y str>,
    /// Number of bidirectional lanes.
    pub(super) bidirectional: u64,
    /// Number of lanes per graph.
    pub(super) graphs: BTreeMap<i64, u64>,
}

impl<'a, 'y> SiteMapper<'a, 'y> {
    pub(super) fn new(source: Source<'a>, file_bytes: usize) -> Self {
        Self {
            reader: SiteReader::new(source, file_bytes),
            lift_names: HashSet::new(),
            bidirectional: 0,
            graphs: BTreeMap::new(),
        }
    }

    /// Counts a lane of a graph.
    pub(super) fn count_graph(&mut self, graph: i64) {
        if self.graphs.len() < MAX_GRAPHS || self.graphs.contains_key(&graph) {
            *self.graphs.entry(graph).or_insert(0) += 1;
        }
    }
}
