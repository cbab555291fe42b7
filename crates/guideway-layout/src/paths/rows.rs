//! Whole rows of paths: selects rows of a table, and appends one table to another.

use guideway_spline::Runs;

use super::table::{NONE, Paths};
use crate::Direction;
use crate::optional_column::{append, bytes_of, pick};

impl Paths {
    /// The given paths, in this order. `node` maps a row of a node to its new row, if it stays.
    ///
    /// # Panics
    /// When a row is not below [`Self::len`].
    #[must_use]
    pub fn select(&self, rows: &[usize], node: impl Fn(u32) -> Option<u32>) -> Self {
        let node = |row: u32| match row {
            NONE => NONE,
            row => node(row).unwrap_or(NONE),
        };
        let nodes = |column: &Option<Vec<u32>>| {
            let column = column.as_ref()?;
            Some(rows.iter().map(|&row| node(column[row])).collect())
        };
        Self {
            ids: rows.iter().map(|&row| self.ids.get(row)).collect(),
            geometry: self.geometry.select(rows.iter().copied()),
            start_nodes: nodes(&self.start_nodes),
            end_nodes: nodes(&self.end_nodes),
            directions: pick(&self.directions, rows),
            levels: pick(&self.levels, rows),
            vehicle_types: self.vehicle_types.select(rows),
            width_m: pick(&self.width_m, rows),
            color_rgba: pick(&self.color_rgba, rows),
            rank: pick(&self.rank, rows),
            written_curves: self.written_curves.select(rows),
            is_hilbert_ordered: false,
            attributes: self.attributes.select(rows),
            source: self.source.select(rows),
        }
    }

    /// Appends all paths of another table, whose nodes and levels are renumbered.
    pub(crate) fn append(
        &mut self,
        other: &Self,
        node: impl Fn(u32) -> u32,
        level: impl Fn(u32) -> u32,
    ) {
        let (first, rows) = (self.len(), other.len());
        self.is_hilbert_ordered = false;
        let mut runs = Runs::default();
        for path in other.iter() {
            path.copy_runs(&mut runs);
            self.ids.push(path.id());
            self.geometry.push(&runs);
            let written = other.written_curves.shared(path.row());
            self.written_curves.set(first + path.row(), written);
        }
        let node = |row| if row == NONE { NONE } else { node(row) };
        let level = |row| if row == NONE { NONE } else { level(row) };
        append(
            &mut self.start_nodes,
            first,
            &other.start_nodes,
            rows,
            NONE,
            node,
        );
        append(
            &mut self.end_nodes,
            first,
            &other.end_nodes,
            rows,
            NONE,
            node,
        );
        append(&mut self.levels, first, &other.levels, rows, NONE, level);
        let forward = Direction::Forward;
        append(
            &mut self.directions,
            first,
            &other.directions,
            rows,
            forward,
            |d| d,
        );
        append(
            &mut self.width_m,
            first,
            &other.width_m,
            rows,
            f32::NAN,
            |w| w,
        );
        append(
            &mut self.color_rgba,
            first,
            &other.color_rgba,
            rows,
            0,
            |c| c,
        );
        append(&mut self.rank, first, &other.rank, rows, 0, |r| r);
        self.vehicle_types.append(&other.vehicle_types);
        self.attributes.extend(first, &other.attributes);
    }

    /// Heap bytes in use.
    pub fn heap_bytes(&self) -> usize {
        self.ids.heap_bytes()
            + self.geometry.heap_bytes()
            + bytes_of(&self.start_nodes)
            + bytes_of(&self.end_nodes)
            + bytes_of(&self.directions)
            + bytes_of(&self.levels)
            + bytes_of(&self.width_m)
            + bytes_of(&self.color_rgba)
            + bytes_of(&self.rank)
            + self.vehicle_types.heap_bytes()
            + self.written_curves.heap_bytes()
            + self.attributes.heap_bytes()
            + self.source.heap_bytes()
    }
}
