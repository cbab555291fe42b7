//! Snapshot: the state of a document at one moment, for saving and checking in the background.

use std::sync::Arc;

use guideway_layout::{CheckOptions, Diagnostics, Layout, Member, NewPath, Origin, check};
use guideway_scene::Table;

use crate::PathSet;
use crate::document::Document;

/// The state of a document at one moment, to save while editing goes on.
#[derive(Clone, Debug)]
pub struct Snapshot {
    layout: Arc<Layout>,
    removed: Removed,
    state: u64,
}

impl Document {
    /// The present state. Costs a scan of the states, and no copy of the layout: the next edit
    /// copies it if the snapshot still exists.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            layout: self.scene.shared_layout(),
            removed: Removed {
                paths: self.scene.removed(Table::Paths).collect(),
                nodes: self.scene.removed(Table::Nodes).collect(),
                stations: self.scene.removed(Table::Stations).collect(),
            },
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
    /// the document, where removed elements still have one.
    pub fn findings(&self, options: &CheckOptions) -> Diagnostics {
        let old = &*self.layout;
        let mut found = match self.removed.is_empty() {
            true => check(old, options),
            false => check(&self.layout_to_check(), options),
        };
        if self.removed.has_places() {
            self.restore_rows(&mut found, &[Table::Nodes, Table::Stations]);
        }
        found.append(old.diagnostics.clone());
        found
    }

    /// Findings of another check, which gets the layout without removed elements. Rows are those
    /// of the document.
    pub fn findings_of(&self, check: impl FnOnce(&Layout) -> Diagnostics) -> Diagnostics {
        if self.removed.is_empty() {
            return check(&self.layout);
        }
        let mut found = check(&self.to_layout());
        self.restore_rows(&mut found, &Table::ALL);
        found
    }

    /// The layout of the document, where removed elements still have a row.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Replaces the rows of a layout that lacks the removed elements of some tables by those of the
    /// document.
    fn restore_rows(&self, found: &mut Diagnostics, tables: &[Table]) {
        for &of in tables {
            let rows = self.kept(of);
            let kind = format!("{} number ", of.element());
            found.change_places(|place| {
                let kept = |row: u32| rows.get(row as usize).map_or(row, |&row| row as u32);
                place.origin = place.origin.map(|origin| match (origin, of) {
                    (Origin::Member(Member::Path(row)), Table::Paths) => {
                        Origin::Member(Member::Path(kept(row)))
                    }
                    (Origin::Member(Member::Node(row)), Table::Nodes) => {
                        Origin::Member(Member::Node(kept(row)))
                    }
                    (Origin::Member(Member::Station(row)), Table::Stations) => {
                        Origin::Member(Member::Station(kept(row)))
                    }
                    (other, _) => other,
                });
                let number = place.element.strip_prefix(&*kind);
                let number = number.and_then(|number| number.parse::<u32>().ok());
                if let Some(row) = number.and_then(|number| number.checked_sub(1)) {
                    place.element = format!("{kind}{}", kept(row) + 1);
                }
            });
        }
    }

    /// The layout to check: with an empty path in the row of each removed one, and without removed
    /// nodes and stations.
    fn layout_to_check(&self) -> Layout {
        let old = &*self.layout;
        let mut paths = old.paths.clone();
        let empty = paths.push(&NewPath::default());
        let row = |row: usize| match self.removed.paths.contains(row as u32) {
            true => empty,
            false => row,
        };
        let rows: Vec<usize> = (0..old.paths.len()).map(row).collect();
        let mut layout = Layout {
            paths: paths.select(&rows, Some),
            nodes: old.nodes.clone(),
            stations: old.stations.clone(),
            levels: old.levels.clone(),
            geo_origin: old.geo_origin,
            ..Layout::default()
        };
        self.retain_places(&mut layout);
        layout
    }

    /// The layout without removed elements. What follows a removed element gets a new row.
    pub fn to_layout(&self) -> Layout {
        let mut layout = (*self.layout).clone();
        if !self.removed.paths.is_empty() {
            layout.retain_paths(&self.kept(Table::Paths));
        }
        self.retain_places(&mut layout);
        layout
    }

    /// Drops removed nodes and stations.
    fn retain_places(&self, layout: &mut Layout) {
        if self.removed.has_places() {
            let [nodes, stations] = [Table::Nodes, Table::Stations].map(|of| self.kept(of));
            layout.retain_nodes_and_stations(&nodes, &stations);
        }
    }

    /// The rows of the elements that exist, in the order of [`Self::to_layout`].
    pub fn kept(&self, of: Table) -> Vec<usize> {
        let removed = match of {
            Table::Paths => &self.removed.paths,
            Table::Nodes => &self.removed.nodes,
            Table::Stations => &self.removed.stations,
        };
        let rows = 0..of.row_count(&self.layout);
        rows.filter(|&row| !removed.contains(row as u32)).collect()
    }
}

/// Rows of removed elements.
#[derive(Clone, Debug, Default)]
struct Removed {
    paths: PathSet,
    nodes: PathSet,
    stations: PathSet,
}

impl Removed {
    fn is_empty(&self) -> bool {
        self.paths.is_empty() && !self.has_places()
    }

    /// Returns `true` if a node or a station is removed.
    fn has_places(&self) -> bool {
        !self.nodes.is_empty() || !self.stations.is_empty()
    }
}
