use std::ops::Range;

use guideway_layout::{Geometry, Hulls, Limits, add_boxes};
use guideway_spline::{Bounds, Point, Real};
use rayon::prelude::*;

use super::batch::Batch;
use super::polygons::{AT_ONCE, Coordinates, Fault, Polygons, pairs};
use crate::Problem;

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

#[derive(Debug, Default)]
enum Points {
    #[default]
    None,
    F32(Held<f32>),
    F64(Held<f64>),
}

#[derive(Debug, Default)]
struct Held<T> {
    points: Vec<Point<T>>,
    /// Where the runs lie, while each is a path.
    boxes: Vec<Bounds<T>>,
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
        self.points = match polygons.coordinates {
            Coordinates::F32(_) => Points::F32(Held::with_room(points, rows)),
            Coordinates::F64(_) => Points::F64(Held::with_room(points, rows)),
        };
    }

    /// Appends a batch whose rows are a path each.
    pub(super) fn add(&mut self, polygons: &Polygons, limits: &Limits) -> Result<(), Problem> {
        self.check_room(polygons, limits)?;
        let mut from = 0;
        for (row, fault) in polygons.faults(limits) {
            self.add_rows(polygons, from..row);
            self.refused.push((self.rows + row, fault));
            self.last = Last::Refused;
            from = row + 1;
        }
        self.add_rows(polygons, from..polygons.len());
        self.rows += polygons.len();
        // While the points that were added are still near.
        match &mut self.points {
            Points::None => {}
            Points::F32(held) => add_boxes(&mut held.boxes, &held.points, &self.run_ends),
            Points::F64(held) => add_boxes(&mut held.boxes, &held.points, &self.run_ends),
        }
        Ok(())
    }

    /// Appends a batch with rows that continue the path of the row before.
    ///
    /// A path is refused whole if one of its rows is: half a path would mislead.
    pub(super) fn add_parts(
        &mut self,
        polygons: &Polygons,
        continues: &[bool],
        limits: &Limits,
    ) -> Result<(), Problem> {
        self.check_room(polygons, limits)?;
        if self.path_ends.is_none() {
            self.path_ends = Some((1..=self.run_ends.len() as u32).collect());
        }
        let mut faults = polygons.faults(limits).into_iter().peekable();
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
                    self.add_run(polygons, row);
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
        let (geometry, hulls): (_, Hulls) = match self.points {
            Points::None => return Geometry::default(),
            Points::F32(held) => (
                Geometry::from_f32(held.points, self.run_ends),
                held.boxes.into(),
            ),
            Points::F64(held) => (
                Geometry::from_f64(held.points, self.run_ends),
                held.boxes.into(),
            ),
        };
        match self.path_ends {
            Some(path_ends) => geometry.with_path_ends(path_ends),
            None => geometry.with_hulls(hulls),
        }
    }

    fn check_room(&self, polygons: &Polygons, limits: &Limits) -> Result<(), Problem> {
        let rows = (self.rows + polygons.len()) as u64;
        let points = self.points.len() as u64 + polygons.point_count();
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
        match polygons.range_of_rows(rows.clone()) {
            Some(range) => {
                // `u32` holds it: the number of points was checked.
                let shift = self.points.len();
                let ends = rows.clone().map(|row| polygons.range(row).end);
                self.run_ends
                    .extend(ends.map(|end| (end - range.start + shift) as u32));
                self.points.extend(&polygons.coordinates, range);
            }
            None => rows.clone().for_each(|row| self.add_run(polygons, row)),
        }
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

    fn add_run(&mut self, polygons: &Polygons, row: usize) {
        self.points
            .extend(&polygons.coordinates, polygons.range(row));
        self.run_ends.push(self.points.len() as u32);
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

impl Points {
    fn len(&self) -> usize {
        match self {
            Self::None => 0,
            Self::F32(held) => held.points.len(),
            Self::F64(held) => held.points.len(),
        }
    }

    fn truncate(&mut self, len: usize) {
        match self {
            Self::None => {}
            Self::F32(held) => held.points.truncate(len),
            Self::F64(held) => held.points.truncate(len),
        }
    }

    fn extend(&mut self, coordinates: &Coordinates, range: Range<usize>) {
        match (self, coordinates) {
            (Self::F32(held), Coordinates::F32(c)) => extend(&mut held.points, c, range),
            (Self::F64(held), Coordinates::F64(c)) => extend(&mut held.points, c, range),
            // All batches of a file have one schema, and `reserve` saw the first of them.
            _ => unreachable!("one schema, one precision"),
        }
    }
}

impl<T: Real> Held<T> {
    fn with_room(points: usize, rows: usize) -> Self {
        Self {
            points: Vec::with_capacity(points),
            boxes: Vec::with_capacity(rows),
        }
    }
}

fn extend<T: Real>(out: &mut Vec<Point<T>>, coordinates: &[T], range: Range<usize>) {
    let pairs = pairs(coordinates, range);
    let point = |&[x, y]: &[T; 2]| Point::new(x, y);
    if pairs.len() <= AT_ONCE {
        out.extend(pairs.iter().map(point));
    } else {
        // Much of it is waiting for pages of memory.
        out.par_extend(pairs.par_iter().with_min_len(AT_ONCE).map(point));
    }
}
