//! Edits of paths: sets columns, and the properties of single paths.

use std::sync::Arc;

use guideway_spline::Affine;
use rayon::prelude::*;

use super::table::{NONE, Paths};
use crate::optional_column::{column_for, set};
use crate::row_visits::for_each_row;
use crate::{Direction, Geometry, OwnStyle, TypeEntries, WrittenCurve, WrittenCurves};

/// Styles up to which one thread sets them.
const FEW_STYLES: usize = 1 << 12;

/// Returns `true` if any of some styles has a property, by all threads if there are many.
fn any(styles: &[(u32, OwnStyle)], has: impl Fn(&OwnStyle) -> bool + Sync) -> bool {
    let of_some = |styles: &[(u32, OwnStyle)]| styles.iter().any(|(_, style)| has(style));
    match styles.len() {
        0..=FEW_STYLES => of_some(styles),
        _ => styles.par_chunks(FEW_STYLES).any(of_some),
    }
}

impl Paths {
    /// States that the rows follow a Hilbert curve, until rows are appended or selected.
    pub fn set_hilbert_ordered(&mut self) {
        self.is_hilbert_ordered = true;
    }

    /// Sets the stroke width of every path, in meters; NaN where the rule of the view decides.
    ///
    /// # Panics
    /// When the length is not [`Self::len`], as in the other setters of columns.
    pub fn set_width_m(&mut self, column: Vec<f32>) {
        assert_eq!(column.len(), self.len());
        self.width_m = Some(column);
    }

    /// Sets the color of every path, 0xRRGGBBAA; 0 where the rule of the view decides.
    pub fn set_color_rgba(&mut self, column: Vec<u32>) {
        assert_eq!(column.len(), self.len());
        self.color_rgba = Some(column);
    }

    /// Sets the draw rank of every path: higher ranks cover lower ones, equal ranks paint in file
    /// order.
    pub fn set_rank(&mut self, column: Vec<i32>) {
        assert_eq!(column.len(), self.len());
        self.rank = Some(column);
    }

    /// Sets the level of every path; `u32::MAX` means no level.
    pub fn set_levels(&mut self, column: Vec<u32>) {
        assert_eq!(column.len(), self.len());
        self.levels = Some(column);
    }

    /// Maps the level of each path that has one.
    pub(crate) fn renumber_levels(&mut self, row: impl Fn(u32) -> Option<u32>) {
        let levels = self.levels.iter_mut().flatten();
        for level in levels.filter(|level| **level != NONE) {
            *level = row(*level).unwrap_or(NONE);
        }
    }

    /// Sets the level of one path.
    ///
    /// # Panics
    /// When `path` is not below [`Self::len`], as in the other setters of one path.
    pub fn set_level(&mut self, path: usize, level: Option<u32>) {
        set(
            &mut self.levels,
            self.ids.len(),
            path,
            NONE,
            level.unwrap_or(NONE),
        );
    }

    /// Sets the rows of the first and the last node of one path.
    pub fn set_nodes(&mut self, path: usize, start: Option<u32>, end: Option<u32>) {
        let rows = self.ids.len();
        set(
            &mut self.start_nodes,
            rows,
            path,
            NONE,
            start.unwrap_or(NONE),
        );
        set(&mut self.end_nodes, rows, path, NONE, end.unwrap_or(NONE));
    }

    /// Replaces the row of each node by that which `node` returns, if it stays.
    pub(crate) fn renumber_nodes(&mut self, node: impl Fn(u32) -> Option<u32>) {
        let columns = [&mut self.start_nodes, &mut self.end_nodes];
        let rows = columns.into_iter().flatten().flatten();
        for row in rows.filter(|row| **row != NONE) {
            *row = node(*row).unwrap_or(NONE);
        }
    }

    /// Sets the directions in which vehicles drive along one path.
    pub fn set_direction(&mut self, path: usize, direction: Direction) {
        let rows = self.ids.len();
        set(
            &mut self.directions,
            rows,
            path,
            Direction::Forward,
            direction,
        );
    }

    /// Replaces the identifiers of some paths, in increasing order. Cost: O(all identifiers).
    pub fn set_ids(&mut self, ids: &[(usize, &str)]) {
        self.ids.replace(ids);
    }

    /// Maps the curves of some paths: see [`Geometry::transform`].
    pub fn transform(&mut self, paths: impl IntoIterator<Item = usize>, by: Affine) {
        if self.written_curves.is_empty() {
            self.geometry.transform(paths, by);
            return;
        }
        let written_curves = &mut self.written_curves;
        let paths = paths
            .into_iter()
            .inspect(|&path| written_curves.transform(path, by));
        self.geometry.transform(paths, by);
    }

    /// Replaces the curves of some paths: see [`Geometry::replace_all`]. `written` has the curves
    /// among them that are kept as written, by their indices.
    pub fn replace_curves(&mut self, paths: &[u32], with: &Geometry, written: &WrittenCurves) {
        self.geometry.replace_all(paths, with);
        if self.written_curves.is_empty() && written.is_empty() {
            return;
        }
        for (i, &path) in paths.iter().enumerate() {
            self.written_curves.set(path as usize, written.shared(i));
        }
    }

    /// Sets the curve of a path as its file wrote it, beside its runs.
    pub fn set_written_curve(&mut self, path: usize, curve: WrittenCurve) {
        self.written_curves.set(path, Some(curve.into()));
    }

    /// Keeps the curve of a path as it was written, beside its runs.
    pub fn share_written_curve(&mut self, path: usize, curve: Arc<WrittenCurve>) {
        self.written_curves.set(path, Some(curve));
    }

    /// Sets the draw rank of one path.
    ///
    /// # Panics
    /// When the path is not below [`Self::len`].
    pub fn set_path_rank(&mut self, path: usize, rank: i32) {
        let rows = self.len();
        set(&mut self.rank, rows, path, 0, rank);
    }

    /// Copies the draw rank of a path to another one.
    ///
    /// # Panics
    /// When `to` is not below [`Self::len`].
    pub fn copy_rank(&mut self, from: usize, to: usize) {
        if let Some(ranks) = &mut self.rank {
            ranks[to] = ranks[from];
        }
    }

    /// Sets the styles of paths, by all threads where their rows ascend: see
    /// [`Self::set_own_style`]. If a path occurs twice, its last style counts.
    ///
    /// # Panics
    /// When a path is not below [`Self::len`].
    pub fn set_own_styles(&mut self, styles: &[(u32, OwnStyle)]) {
        let (rows, row) = (self.len(), |style: &(u32, OwnStyle)| style.0);
        let (width_m, color_rgba) = (&mut self.width_m, &mut self.color_rgba);
        let mut set_widths = || {
            let has_width = any(styles, |style| style.width_m.is_some());
            if let Some(column) = column_for(width_m, rows, f32::NAN, has_width) {
                for_each_row(column, styles, &row, &|width_m, (_, style)| {
                    *width_m = style.width_m.unwrap_or(f32::NAN);
                });
            }
        };
        let mut set_colors = || {
            let color = |style: &OwnStyle| style.color_rgba.unwrap_or(0);
            let has_color = any(styles, |style| color(style) != 0);
            if let Some(column) = column_for(color_rgba, rows, 0, has_color) {
                for_each_row(column, styles, &row, &|to, (_, style)| *to = color(style));
            }
        };
        if styles.len() > FEW_STYLES {
            rayon::join(set_widths, set_colors);
        } else {
            set_widths();
            set_colors();
        }
    }

    /// Sets the style of one path; properties that are `None` follow the rule of the view.
    ///
    /// # Panics
    /// When `path` is not below [`Self::len`].
    pub fn set_own_style(&mut self, path: usize, style: OwnStyle) {
        let rows = self.len();
        let width_m = style.width_m.unwrap_or(f32::NAN);
        if let Some(column) = column_for(&mut self.width_m, rows, f32::NAN, style.width_m.is_some())
        {
            column[path] = width_m;
        }
        let color = style.color_rgba.unwrap_or(0);
        if let Some(column) = column_for(&mut self.color_rgba, rows, 0, color != 0) {
            column[path] = color;
        }
    }

    /// The entries per vehicle type, to edit.
    pub fn vehicle_types_mut(&mut self) -> &mut TypeEntries {
        &mut self.vehicle_types
    }
}
