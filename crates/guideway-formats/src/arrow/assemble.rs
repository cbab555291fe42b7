//! Path assembly: joins the rows of all batches to paths, and decides which rows are drawn or
//! refused. It skips the rows of other elements.

use std::ops::Range;

use guideway_layout::{Geometry, Hulls, Limits};

use super::batch::Batch;
use super::column_names::PATHS_VERSION;
use super::control_polygons::ControlPolygons;
use super::element::Element;
use super::fault::Fault;
use super::numbering::Numbering;
use super::point_store::PointStore;
use super::row_kinds::RowKinds;
use crate::Problem;
use crate::input::Input;

/// Curves of all drawn rows, joined to paths.
#[derive(Debug, Default)]
pub(super) struct PathAssembler {
    /// An empty list of control points is a path without a curve, not a fault.
    allows_empty: bool,
    points: PointStore,
    run_ends: Vec<u32>,
    /// Last run of each path, once a row continues another; until then every run is a path.
    path_ends: Option<Vec<u32>>,
    /// Rows of the table that begin a drawn path and are not assigned to a batch yet, ascending.
    drawn: Vec<Range<usize>>,
    /// Rows that begin a refused path, with the reason, likewise.
    refused: Vec<(usize, Fault)>,
    /// Numbers of the refused paths among all paths.
    refused_numbers: Vec<u32>,
    /// Numbers of the paths that were not read, and how many they are.
    skipped_numbers: Vec<Range<u32>>,
    skipped_paths: u32,
    rows: usize,
    last: LastPath,
}

/// State of the path of the last row, which the next batch may continue.
#[derive(Clone, Copy, Debug, Default)]
enum LastPath {
    #[default]
    None,
    Drawn {
        row: usize,
        first_run: usize,
    },
    Refused,
}

impl PathAssembler {
    /// Makes an assembler for a version of the table.
    pub(super) fn new(version: u32) -> Self {
        Self {
            allows_empty: version > PATHS_VERSION,
            ..Self::default()
        }
    }

    /// Reserves memory for an estimated number of points and rows.
    pub(super) fn reserve(&mut self, polygons: &ControlPolygons, points: usize, rows: usize) {
        self.points = PointStore::with_capacity(&polygons.coordinates, points, rows);
    }

    /// Appends a batch with one path per row.
    pub(super) fn add(
        &mut self,
        polygons: &ControlPolygons,
        kinds: &RowKinds,
        input: &Input<'_>,
        limits: &Limits,
    ) -> Result<(), Problem> {
        self.check_limits(polygons, limits)?;
        let faults = self.points.load(polygons, input, limits)?;
        let mut faults = faults.into_iter().peekable();
        for rows in kinds.rows(Element::Path) {
            while faults.next_if(|fault| fault.0 < rows.start).is_some() {}
            let mut from = rows.start;
            while let Some((row, fault)) = faults.next_if(|fault| fault.0 < rows.end) {
                self.add_rows(polygons, from..row);
                self.add_fault(row, fault);
                from = row + 1;
            }
            self.add_rows(polygons, from..rows.end);
        }
        self.rows += polygons.len();
        // Here, while the points are in the processor cache.
        self.points.append_hulls(&self.run_ends);
        Ok(())
    }

    /// Appends a batch with rows that continue the path of the row before.
    ///
    /// A fault of one row refuses the whole path: a partial path would mislead.
    pub(super) fn add_parts(
        &mut self,
        polygons: &ControlPolygons,
        kinds: &RowKinds,
        continues: &[bool],
        input: &Input<'_>,
        limits: &Limits,
    ) -> Result<(), Problem> {
        self.check_limits(polygons, limits)?;
        self.ensure_path_ends();
        let faults = self.points.load(polygons, input, limits)?;
        let mut faults = faults.into_iter().peekable();
        for (kind, rows) in kinds.runs() {
            if kind != Some(Element::Path) {
                while faults.next_if(|fault| fault.0 < rows.end).is_some() {}
                self.last = LastPath::None;
                continue;
            }
            for row in rows {
                let fault = faults.next_if(|f| f.0 == row).map(|f| f.1);
                self.add_part(polygons, row, continues[row], fault);
            }
        }
        self.rows += polygons.len();
        Ok(())
    }

    fn add_part(
        &mut self,
        polygons: &ControlPolygons,
        row: usize,
        continues: bool,
        fault: Option<Fault>,
    ) {
        match (continues, self.last, fault) {
            (true, LastPath::Refused, _) => {}
            (
                true,
                LastPath::Drawn {
                    row: first,
                    first_run,
                },
                Some(fault),
            ) => {
                self.remove_path(first_run);
                self.refuse(first, fault);
            }
            (true, LastPath::Drawn { .. }, None) => {
                self.points.accept(polygons.range(row));
                self.run_ends.push(self.points.len() as u32);
                if let Some(end) = self.path_ends.as_mut().and_then(|ends| ends.last_mut()) {
                    *end += 1;
                }
            }
            (_, _, Some(fault)) => self.add_fault(row, fault),
            (_, _, None) => self.add_rows(polygons, row..row + 1),
        }
    }

    /// Skips a batch without paths.
    pub(super) fn skip(&mut self, rows: usize) {
        self.rows += rows;
        self.last = LastPath::None;
    }

    /// Skips a batch with rows that begin `paths` paths, and that is not read. Numbers beyond
    /// those of 32 bits have no rows.
    pub(super) fn skip_paths(&mut self, rows: usize, paths: u32) {
        let start = self.next_number();
        let end = start.saturating_add(paths);
        if start < end {
            self.skipped_numbers.push(start..end);
        }
        self.skipped_paths += end - start;
        self.skip(rows);
    }

    /// Returns the number of rows so far.
    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// Returns the number of rows whose fate is final: all except those of a path that may
    /// continue.
    pub(super) fn final_rows(&self) -> usize {
        match (&self.path_ends, self.last) {
            (Some(_), LastPath::Drawn { row, .. }) => row,
            _ => self.rows,
        }
    }

    /// Ends the last path: no rows follow.
    pub(super) fn end_rows(&mut self) {
        self.last = LastPath::None;
    }

    /// Assigns the drawn and refused rows to the next batch.
    pub(super) fn assign_rows(&mut self, batch: &mut Batch) {
        let Range { start, end } = batch.rows;
        let whole = self.drawn.partition_point(|rows| rows.end <= end);
        batch.drawn.extend(self.drawn.drain(..whole));
        if let Some(rows) = self.drawn.first_mut().filter(|rows| rows.start < end) {
            batch.drawn.push(rows.start..end);
            rows.start = end;
        }
        for rows in &mut batch.drawn {
            *rows = rows.start - start..rows.end - start;
        }
        let refused = self.refused.partition_point(|&(row, _)| row < end);
        let refused = self.refused.drain(..refused);
        batch
            .refused
            .extend(refused.map(|(row, fault)| (row - start, fault)));
    }

    /// Returns the geometry of all paths, and their rows by their numbers in the table.
    pub(super) fn into_geometry(self) -> (Geometry, Numbering) {
        let rows = self.drawn_paths();
        let numbering = Numbering::new(self.refused_numbers, self.skipped_numbers, rows);
        let (geometry, hulls): (Geometry, Hulls) = self.points.into_geometry(self.run_ends);
        let geometry = match self.path_ends {
            Some(path_ends) => geometry.with_path_ends(path_ends),
            None => geometry.with_hulls(hulls),
        };
        (geometry, numbering)
    }

    fn check_limits(&self, polygons: &ControlPolygons, limits: &Limits) -> Result<(), Problem> {
        let rows = (self.rows + polygons.len()) as u64;
        let points = (self.points.len() + polygons.range_of_rows(0..polygons.len()).len()) as u64;
        let over = |what, limit, actual| Problem::LimitReached {
            what,
            limit,
            actual,
        };
        if rows > limits.paths.min(u64::from(u32::MAX - 1)) {
            return Err(over("rows in the table", limits.paths, rows));
        }
        // Run ends have 32 bits.
        let limit = limits.control_points.min(u64::from(u32::MAX));
        if points > limit {
            return Err(over("control points", limit, points));
        }
        Ok(())
    }

    /// Allows paths with any number of runs.
    fn ensure_path_ends(&mut self) {
        let runs = self.run_ends.len() as u32;
        self.path_ends.get_or_insert_with(|| (1..=runs).collect());
    }

    /// Returns the number of paths that are drawn so far.
    fn drawn_paths(&self) -> usize {
        let ends = self.path_ends.as_ref();
        ends.map_or(self.run_ends.len(), Vec::len)
    }

    /// Appends a path whose curve has a fault: one without a curve, or a refused one.
    fn add_fault(&mut self, row: usize, fault: Fault) {
        if !self.allows_empty || fault != Fault::TooFew(0) {
            self.refuse(self.rows + row, fault);
            return;
        }
        self.ensure_path_ends();
        let runs = self.run_ends.len();
        if let Some(path_ends) = &mut self.path_ends {
            path_ends.push(runs as u32);
        }
        self.add_drawn(self.rows + row..self.rows + row + 1, runs);
    }

    /// Number of the next path of the table.
    fn next_number(&self) -> u32 {
        let read = self.drawn_paths() + self.refused_numbers.len();
        (read as u32).saturating_add(self.skipped_paths)
    }

    /// Refuses the path that begins with a row of the table.
    fn refuse(&mut self, row: usize, fault: Fault) {
        self.refused_numbers.push(self.next_number());
        self.refused.push((row, fault));
        self.last = LastPath::Refused;
    }

    /// Appends valid rows with one path each.
    fn add_rows(&mut self, polygons: &ControlPolygons, rows: Range<usize>) {
        if rows.is_empty() {
            return;
        }
        let first_run = self.run_ends.len();
        // No overflow of u32: the number of points was checked.
        polygons.add_ends(rows.clone(), self.points.len(), &mut self.run_ends);
        self.points.accept(polygons.range_of_rows(rows.clone()));
        if let Some(path_ends) = &mut self.path_ends {
            path_ends.extend(first_run as u32 + 1..=self.run_ends.len() as u32);
        }
        let last_run = self.run_ends.len() - 1;
        self.add_drawn(self.rows + rows.start..self.rows + rows.end, last_run);
    }

    /// Records rows of the table that begin drawn paths; the last one begins with run `last_run`.
    fn add_drawn(&mut self, table_rows: Range<usize>, last_run: usize) {
        self.last = LastPath::Drawn {
            row: table_rows.end - 1,
            first_run: last_run,
        };
        match self.drawn.last_mut() {
            Some(last) if last.end == table_rows.start => last.end = table_rows.end,
            _ => self.drawn.push(table_rows),
        }
    }

    /// Removes the last drawn path, which begins with this run.
    fn remove_path(&mut self, first_run: usize) {
        self.run_ends.truncate(first_run);
        let points = self.run_ends.last().map_or(0, |&end| end as usize);
        self.points.truncate(points);
        if let Some(path_ends) = &mut self.path_ends {
            path_ends.pop();
        }
        if let Some(last) = self.drawn.last_mut() {
            last.end -= 1;
            if last.start == last.end {
                self.drawn.pop();
            }
        }
    }
}
