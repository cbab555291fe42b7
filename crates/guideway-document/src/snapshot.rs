//! Snapshot: the state of a document at one moment, for saving and checking in the background.

use std::sync::Arc;

use guideway_layout::{CheckOptions, Diagnostics, Layout, NewPath, check};
use guideway_scene::PathState;

use crate::PathSet;
use crate::document::Document;
use crate::moved_nodes::MovedNodes;

/// The state of a document at one moment, to save while editing goes on.
#[derive(Clone, Debug)]
pub struct Snapshot {
    layout: Arc<Layout>,
    removed: PathSet,
    moved_nodes: MovedNodes,
    state: u64,
}

impl Document {
    /// The present state. Costs a scan of the path states, and no copy of the layout: the next edit
    /// copies it if the snapshot still exists.
    pub fn snapshot(&self) -> Snapshot {
        let has_removed = self.scene.path_count() < self.layout().path_count();
        let rows = 0..if has_removed {
            self.scene.row_count() as u32
        } else {
            0
        };
        let is_removed = |&row: &u32| self.scene.state(row) == PathState::Removed;
        Snapshot {
            layout: self.scene.shared_layout(),
            removed: rows.filter(is_removed).collect(),
            moved_nodes: self.moved_nodes.clone(),
            state: self.state(),
        }
    }

    /// The present layout. See [`Snapshot::to_layout`].
    pub fn to_layout(&self) -> Layout {
        self.snapshot().to_layout()
    }
}

impl Snapshot {
    /// [`Document::state`] at that moment.
    pub fn state(&self) -> u64 {
        self.state
    }

    /// Findings of [`check`] in the present state, and diagnostics of the reader. Rows are those of
    /// the document, where removed paths still have one.
    pub fn findings(&self, options: &CheckOptions) -> Diagnostics {
        let old = &*self.layout;
        let is_unchanged = self.removed.is_empty() && self.moved_nodes.is_empty();
        let mut found = if is_unchanged {
            check(old, options)
        } else {
            check(&self.layout_with_stable_rows(), options)
        };
        found.append(old.diagnostics.clone());
        found
    }

    /// The layout to check, with an empty path in the row of each removed one.
    fn layout_with_stable_rows(&self) -> Layout {
        let old = &*self.layout;
        let mut paths = old.paths.clone();
        let empty = paths.push(&NewPath::default());
        let row = |row: usize| match self.removed.contains(row as u32) {
            true => empty,
            false => row,
        };
        let rows: Vec<usize> = (0..old.paths.len()).map(row).collect();
        Layout {
            paths: paths.select(&rows, Some),
            nodes: self.moved_nodes.nodes(old),
            stations: self.moved_nodes.stations(old),
            levels: old.levels.clone(),
            geo_origin: old.geo_origin,
            ..Layout::default()
        }
    }

    /// The layout without removed paths, with nodes and stations at their present positions. Paths
    /// after a removed one get new rows.
    pub fn to_layout(&self) -> Layout {
        let mut layout = (*self.layout).clone();
        layout.nodes = self.moved_nodes.nodes(&self.layout);
        layout.stations = self.moved_nodes.stations(&self.layout);
        if !self.removed.is_empty() {
            layout.retain_paths(&self.rows());
        }
        layout
    }

    /// The rows of the paths that exist.
    fn rows(&self) -> Vec<usize> {
        let rows = 0..self.layout.paths.len();
        rows.filter(|&row| !self.removed.contains(row as u32))
            .collect()
    }
}
