use std::ops::Range;

use guideway_layout::{Geometry, Hulls, Limits};

use super::batch::Batch;
use super::points::Points;
use super::polygons::{Fault, Polygons};
use crate::Problem;
use crate::input::Input;

/// The curves of all rows that can be drawn, joined to paths, and which rows these are.
#[derive(Debug, Default)]
pub(super) struct Gather {
    points: Points,
    run_ends: Vec<u32>,
    /// Set from the first row on that continues another; until then every run is a path.
    path_ends: Option<Vec<u32>>,
    /// Rows of the table that begin a drawn path, in order, of which no batch was told yet.
    kept: Vec<Range<usize>>,
    /// Likewise those that begin a refused path, with the reason.
    refused: Vec<(usize, Fault)>,
    rows: usize,
    last: Last,
}

/// What became of the path that the last row belongs to.
#[derive(Clone, Copy, Debug, Default)]
enum Last {
    #[default]
    Nothing,
    Drawn {
        row: usize,
        first_run: usize,
    },
    Refused,
}

impl Gather {
    /// Makes room for about so many points and rows in all.
    pub(super) fn reserve(&mut self, polygons: &Polygons, points: usize, rows: usize) {
        self.points = Points::with_room(&polygons.coordinates, points, rows);
    }

    /// Appends a batch whose rows are a path each.
    pub(super) fn add(
        &mut self,
        polygons: &Polygons,
        input: &Input<'_>,
        limits: &Limits,
    ) -> Result<(), Problem> {
        self.check_room(polygons, limits)?;
        let mut from = 0;
        for (row, fault) in self.points.bring(polygons, input, limits)? {
            self.add_rows(polygons, from..row);
            self.refused.push((self.rows + row, fault));
            self.last = Last::Refused;
            from = row + 1;
        }
        self.add_rows(polygons, from..polygons.len());
        self.rows += polygons.len();
        // While the points that were added are still near.
        self.points.add_boxes(&self.run_ends);
        Ok(())
    }

    /// Appends a batch with rows that continue the path of the row before.
    ///
    /// A path is refused whole if one of its rows is: half a path would mislead.
    pub(super) fn add_parts(
        &mut self,
        polygons: &Polygons,
        continues: &[bool],
        input: &Input<'_>,
        limits: &Limits,
    ) -> Result<(), Problem> {
        self.check_room(polygons, limits)?;
        if self.path_ends.is_none() {
            self.path_ends = Some((1..=self.run_ends.len() as u32).collect());
        }
        let faults = self.points.bring(polygons, input, limits)?;
        let mut faults = faults.into_iter().peekable();
        for (row, &continues) in continues.iter().enumerate() {
            let fault = faults.next_if(|f| f.0 == row).map(|f| f.1);
            match (continues, self.last, fault) {
                (true, Last::Refused, _) => {}
                (
                    true,
                    Last::Drawn {
                        row: first,
                        first_run,
                    },
                    Some(fault),
                ) => {
                    self.take_back(first_run);
                    self.refused.push((first, fault));
                    self.last = Last::Refused;
                }
                (_, _, Some(fault)) => {
                    self.refused.push((self.rows + row, fault));
                    self.last = Last::Refused;
                }
                (true, Last::Drawn { .. }, None) => {
                    self.points.take(polygons.range(row));
                    self.run_ends.push(self.points.len() as u32);
                    if let Some(end) = self.path_ends.as_mut().and_then(|ends| ends.last_mut()) {
                        *end += 1;
                    }
                }
                (_, _, None) => self.add_rows(polygons, row..row + 1),
            }
        }
        self.rows += polygons.len();
        Ok(())
    }

    /// Rows seen so far.
    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// So many rows stay what they are, whatever follows: all but those of a path that may go on and be refused.
    pub(super) fn settled_rows(&self) -> usize {
        match (&self.path_ends, self.last) {
            (Some(_), Last::Drawn { row, .. }) => row,
            _ => self.rows,
        }
    }

    /// No rows follow.
    pub(super) fn settle(&mut self) {
        self.last = Last::Nothing;
    }

    /// Tells the next batch what became of its rows.
    pub(super) fn tell(&mut self, batch: &mut Batch) {
        let Range { start, end } = batch.rows;
        let whole = self.kept.partition_point(|rows| rows.end <= end);
        batch.kept.extend(self.kept.drain(..whole));
        if let Some(rows) = self.kept.first_mut().filter(|rows| rows.start < end) {
            batch.kept.push(rows.start..end);
            rows.start = end;
        }
        for rows in &mut batch.kept {
            *rows = rows.start - start..rows.end - start;
        }
        let refused = self.refused.partition_point(|&(row, _)| row < end);
        let refused = self.refused.drain(..refused);
        batch
            .refused
            .extend(refused.map(|(row, fault)| (row - start, fault)));
    }

    pub(super) fn into_geometry(self) -> Geometry {
        let (geometry, hulls): (Geometry, Hulls) = self.points.into_geometry(self.run_ends);
        match self.path_ends {
            Some(path_ends) => geometry.with_path_ends(path_ends),
            None => geometry.with_hulls(hulls),
        }
    }

    fn check_room(&self, polygons: &Polygons, limits: &Limits) -> Result<(), Problem> {
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
        // Ends are kept in 32 bits.
        let most = limits.control_points.min(u64::from(u32::MAX));
        if points > most {
            return Err(over("control points", most, points));
        }
        Ok(())
    }

    /// Appends rows that are sound and a path each.
    fn add_rows(&mut self, polygons: &Polygons, rows: Range<usize>) {
        if rows.is_empty() {
            return;
        }
        let first_run = self.run_ends.len();
        // `u32` holds it: the number of points was checked.
        polygons.add_ends(rows.clone(), self.points.len(), &mut self.run_ends);
        self.points.take(polygons.range_of_rows(rows.clone()));
        if let Some(path_ends) = &mut self.path_ends {
            path_ends.extend(first_run as u32 + 1..=self.run_ends.len() as u32);
        }
        let table_rows = self.rows + rows.start..self.rows + rows.end;
        self.last = Last::Drawn {
            row: table_rows.end - 1,
            first_run: self.run_ends.len() - 1,
        };
        match self.kept.last_mut() {
            Some(last) if last.end == table_rows.start => last.end = table_rows.end,
            _ => self.kept.push(table_rows),
        }
    }

    /// Takes back the path drawn last, which begins with this run.
    fn take_back(&mut self, first_run: usize) {
        self.run_ends.truncate(first_run);
        let points = self.run_ends.last().map_or(0, |&end| end as usize);
        self.points.truncate(points);
        if let Some(path_ends) = &mut self.path_ends {
            path_ends.pop();
        }
        if let Some(last) = self.kept.last_mut() {
            last.end -= 1;
            if last.start == last.end {
                self.kept.pop();
            }
        }
    }
}
