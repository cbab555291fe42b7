use std::sync::Arc;

use guideway_layout::{
    Attribute, Attributes, Cells, CheckOptions, Diagnostics, Layout, NewPath, Paths, Value, Values,
    check,
};
use guideway_scene::PathState;
use guideway_spline::Runs;

use crate::moved_nodes::MovedNodes;
use crate::{Document, PathSet};

/// A document as it was at one moment, to be written while it is edited on.
#[derive(Clone, Debug)]
pub struct Snapshot {
    layout: Arc<Layout>,
    removed: PathSet,
    moved_nodes: MovedNodes,
    state: u64,
}

impl Document {
    /// What there is now. It takes next to no time; the first edit after it takes a copy of the layout, unless
    /// the snapshot is gone by then.
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

    /// The layout as it is now: see [`Snapshot::to_layout`].
    pub fn to_layout(&self) -> Layout {
        self.snapshot().to_layout()
    }
}

impl Snapshot {
    /// [`Document::state`] at that moment.
    pub fn state(&self) -> u64 {
        self.state
    }

    /// What its reader found, and what is odd in it as it is. PathSet are those of the document, where a removed path
    /// still has one.
    pub fn findings(&self, options: &CheckOptions) -> Diagnostics {
        let old = &*self.layout;
        let mut found = old.diagnostics.clone();
        let is_as_read = self.removed.is_empty() && self.moved_nodes.is_empty();
        found.append(if is_as_read {
            check(old, options)
        } else {
            check(&self.with_rows_kept(), options)
        });
        found
    }

    /// What there is to be found odd, with nothing where a path was removed.
    fn with_rows_kept(&self) -> Layout {
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

    /// The layout: removed paths left out, moved nodes and stations at their places, rows numbered anew.
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
        let is_there = |&row: &usize| !self.removed.contains(row as u32);
        let rows: Vec<usize> = (0..old.len()).filter(is_there).collect();
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
        paths.attributes = of_rows(&old.attributes, &rows);
        paths
    }
}

/// Adds a path of other ones, by runs that are used again.
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

/// The attributes of some rows, in this order.
fn of_rows(all: &Attributes, rows: &[usize]) -> Attributes {
    let mut attributes = Attributes::default();
    for column in all.iter() {
        attributes.insert(Attribute {
            values: chosen(&column.values, rows),
            ..column.clone()
        });
    }
    attributes
}

/// The values of some rows, in this order.
fn chosen(values: &Values, rows: &[usize]) -> Values {
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
