//! Snapshot: the state of a document at one moment, for saving and checking in the background.

use std::sync::Arc;

use guideway_layout::{
    Attribute, Attributes, Cells, CheckOptions, Diagnostics, Layout, NewPath, Paths, Value, Values,
    check,
};
use guideway_scene::PathState;
use guideway_spline::Runs;

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

    /// Diagnostics of the reader, and findings of [`check`] in the present state. Rows are those of
    /// the document, where removed paths still have one.
    pub fn findings(&self, options: &CheckOptions) -> Diagnostics {
        let old = &*self.layout;
        let mut found = old.diagnostics.clone();
        let is_unchanged = self.removed.is_empty() && self.moved_nodes.is_empty();
        found.append(if is_unchanged {
            check(old, options)
        } else {
            check(&self.layout_with_stable_rows(), options)
        });
        found
    }

    /// The layout to check, with an empty path in the row of each removed one.
    fn layout_with_stable_rows(&self) -> Layout {
        let old = &*self.layout;
        let mut paths = Paths::default();
        let mut runs = Runs::default();
        for row in 0..old.paths.len() {
            if self.removed.contains(row as u32) {
                paths.push(&NewPath::default());
            } else {
                push(&mut paths, &old.paths, row, &mut runs);
            }
        }
        Layout {
            paths,
            nodes: self.moved_nodes.nodes(old),
            stations: self.moved_nodes.stations(old),
            levels: old.levels.clone(),
            ..Layout::default()
        }
    }

    /// The layout without removed paths, with nodes and stations at their present positions. Paths
    /// after a removed one get new rows.
    pub fn to_layout(&self) -> Layout {
        let old = &*self.layout;
        Layout {
            provenance: old.provenance.clone(),
            paths: self.paths(),
            refused: old.refused.clone(),
            nodes: self.moved_nodes.nodes(old),
            stations: self.moved_nodes.stations(old),
            levels: old.levels.clone(),
            diagnostics: old.diagnostics.clone(),
        }
    }

    fn paths(&self) -> Paths {
        let old = &self.layout.paths;
        if self.removed.is_empty() {
            return old.clone();
        }
        let exists = |&row: &usize| !self.removed.contains(row as u32);
        let rows: Vec<usize> = (0..old.len()).filter(exists).collect();
        let mut paths = Paths::default();
        let mut runs = Runs::default();
        for &row in &rows {
            push(&mut paths, old, row, &mut runs);
        }
        if let Some(width_m) = old.width_m() {
            paths.set_width_m(rows.iter().map(|&row| width_m[row]).collect());
        }
        if let Some(color) = old.color_rgba() {
            paths.set_color_rgba(rows.iter().map(|&row| color[row]).collect());
        }
        if let Some(rank) = old.rank() {
            paths.set_rank(rows.iter().map(|&row| rank[row]).collect());
        }
        paths.attributes = select_rows(&old.attributes, &rows);
        paths
    }
}

/// Copies a path from `of` to the end of `paths`. `runs` is a reusable buffer.
fn push(paths: &mut Paths, of: &Paths, row: usize, runs: &mut Runs) {
    let path = of.get(row);
    path.copy_runs(runs);
    let types: Vec<&str> = of.vehicle_types().of(row).collect();
    paths.push(&NewPath {
        id: path.id(),
        runs,
        start_node: path.start_node(),
        end_node: path.end_node(),
        direction: path.direction(),
        level: path.level(),
        vehicle_types: &types,
    });
}

/// The attributes of the given rows, in this order.
fn select_rows(all: &Attributes, rows: &[usize]) -> Attributes {
    let mut attributes = Attributes::default();
    for column in all.iter() {
        attributes.insert(Attribute {
            values: select_values(&column.values, rows),
            ..column.clone()
        });
    }
    attributes
}

/// The values of the given rows, in this order.
fn select_values(values: &Values, rows: &[usize]) -> Values {
    fn pick<T: Copy + Default>(column: &Cells<T>, rows: &[usize]) -> Cells<T> {
        rows.iter().map(|&row| column.get(row)).collect()
    }
    match values {
        Values::Bool(column) => Values::Bool(pick(column, rows)),
        Values::Int(column) => Values::Int(pick(column, rows)),
        Values::Float(column) => Values::Float(pick(column, rows)),
        Values::Text { .. } => {
            let text = |&row: &usize| match values.get(row) {
                Some(Value::Text(text)) => Some(text),
                _ => None,
            };
            Values::Text {
                text: rows.iter().map(|row| text(row).unwrap_or("")).collect(),
                present: rows.iter().map(|row| text(row).is_some()).collect(),
            }
        }
    }
}
