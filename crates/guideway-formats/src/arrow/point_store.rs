//! Point store: control points of all drawn paths in the precision of the file, loaded batch by
//! batch on several threads.
//!
//! ```text
//! points: |== accepted ==|== loaded batch ==|-- capacity --|
//!                        ^ loaded_from: accepted rows move down to the end of `accepted`
//! ```

use std::ops::Range;

use bytemuck::{Pod, cast_slice, cast_slice_mut, zeroed_vec};
use guideway_layout::{Geometry, Hulls, Limits, append_hulls};
use guideway_spline::{Bounds, Point, Real};
use rayon::prelude::*;

use super::control_polygons::{ControlPolygons, Coordinates, all_within};
use super::fault::Fault;
use crate::Problem;
use crate::input::Input;

/// Points per task of a thread.
const TASK_POINTS: usize = 1 << 14;

/// Page size of most systems.
const PAGE_BYTES: usize = 1 << 12;

/// Points of all drawn paths, and those of a loaded batch whose rows are not accepted yet.
#[derive(Debug, Default)]
pub(super) enum PointStore {
    #[default]
    None,
    F32(TypedPoints<f32>),
    F64(TypedPoints<f64>),
}

#[derive(Debug)]
pub(super) struct TypedPoints<T> {
    /// Accepted points, the loaded batch, and spare capacity.
    points: Vec<Point<T>>,
    /// Number of accepted points.
    accepted: usize,
    /// Start of the loaded batch.
    loaded_from: usize,
    /// Index within the batch of its first point.
    first: usize,
    /// Bounding boxes of the runs, while each run is a path.
    boxes: Vec<Bounds<T>>,
}

impl PointStore {
    /// Makes a store with capacity for an estimated number of points and rows.
    pub(super) fn with_capacity(of: &Coordinates, points: usize, rows: usize) -> Self {
        match of {
            Coordinates::F32(_) => Self::F32(TypedPoints::with_capacity(points, rows)),
            Coordinates::F64(_) => Self::F64(TypedPoints::with_capacity(points, rows)),
        }
    }

    /// Returns the number of accepted points.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::None => 0,
            Self::F32(typed) => typed.accepted,
            Self::F64(typed) => typed.accepted,
        }
    }

    /// Keeps the first `len` accepted points.
    pub(super) fn truncate(&mut self, len: usize) {
        match self {
            Self::None => {}
            Self::F32(typed) => typed.accepted = len,
            Self::F64(typed) => typed.accepted = len,
        }
    }

    /// Loads the points of all rows of a batch, from the input if deferred. Returns the rows that
    /// cannot be drawn.
    pub(super) fn load(
        &mut self,
        polygons: &ControlPolygons,
        input: &Input<'_>,
        limits: &Limits,
    ) -> Result<Vec<(usize, Fault)>, Problem> {
        if matches!(self, Self::None) {
            *self = Self::with_capacity(&polygons.coordinates, 0, 0);
        }
        match (self, &polygons.coordinates) {
            (Self::F32(typed), Coordinates::F32(c)) => typed.load(polygons, c, input, limits),
            (Self::F64(typed), Coordinates::F64(c)) => typed.load(polygons, c, input, limits),
            // The schema fixes the precision of all batches.
            _ => unreachable!("one schema, one precision"),
        }
    }

    /// Accepts a range of the loaded points; ranges must ascend.
    pub(super) fn accept(&mut self, range: Range<usize>) {
        match self {
            Self::None => {}
            Self::F32(typed) => typed.accept(range),
            Self::F64(typed) => typed.accept(range),
        }
    }

    /// Computes the bounding boxes of the runs that have none yet.
    pub(super) fn append_hulls(&mut self, ends: &[u32]) {
        match self {
            Self::None => {}
            Self::F32(typed) => {
                append_hulls(&mut typed.boxes, &typed.points[..typed.accepted], ends);
            }
            Self::F64(typed) => {
                append_hulls(&mut typed.boxes, &typed.points[..typed.accepted], ends);
            }
        }
    }

    /// Returns the geometry of paths of one run each with these ends, and their bounding boxes.
    pub(super) fn into_geometry(self, ends: Vec<u32>) -> (Geometry, Hulls) {
        match self {
            Self::None => (Geometry::default(), Vec::<Bounds<f32>>::new().into()),
            Self::F32(typed) => {
                let (points, boxes) = typed.into_parts();
                (Geometry::from_f32(points, ends), boxes.into())
            }
            Self::F64(typed) => {
                let (points, boxes) = typed.into_parts();
                (Geometry::from_f64(points, ends), boxes.into())
            }
        }
    }
}

impl<T: Real + Pod> TypedPoints<T> {
    fn with_capacity(points: usize, rows: usize) -> Self {
        Self {
            // Untouched zero pages take no memory.
            points: zeroed_vec(points),
            accepted: 0,
            loaded_from: 0,
            first: 0,
            boxes: Vec::with_capacity(rows),
        }
    }

    fn load(
        &mut self,
        polygons: &ControlPolygons,
        coordinates: &[T],
        input: &Input<'_>,
        limits: &Limits,
    ) -> Result<Vec<(usize, Fault)>, Problem> {
        let range = polygons.range_of_rows(0..polygons.len());
        (self.loaded_from, self.first) = (self.accepted, range.start);
        let end = self.accepted + range.len();
        if self.points.len() < end {
            self.points.resize(end, Point::default());
        }
        let loaded = &mut self.points[self.loaded_from..end];
        let tasks = loaded.par_chunks_mut(TASK_POINTS).enumerate();
        let are_within = tasks.map(|(task, points)| -> Result<bool, Problem> {
            let first = range.start + task * TASK_POINTS;
            match polygons.deferred {
                Some(at) => {
                    // Touching each page first is cheaper than page faults inside the read call.
                    let pages = points.chunks_mut(PAGE_BYTES / size_of::<Point<T>>());
                    pages.for_each(|page| page[0] = Point::default());
                    input.read(at + first * size_of::<Point<T>>(), cast_slice_mut(points))?;
                }
                None => {
                    let values = first * 2..(first + points.len()) * 2;
                    points.copy_from_slice(cast_slice(&coordinates[values]));
                }
            }
            Ok(all_within(points, limits))
        });
        let are_within = are_within.try_reduce(|| true, |a, b| Ok(a & b))?;
        Ok(polygons.faults(loaded, are_within, limits))
    }

    fn accept(&mut self, range: Range<usize>) {
        let from = self.loaded_from + range.start - self.first;
        let to = self.accepted;
        self.accepted += range.len();
        // Without refused rows the points are in place already.
        if from != to {
            self.points.copy_within(from..from + range.len(), to);
        }
    }

    fn into_parts(mut self) -> (Vec<Point<T>>, Vec<Bounds<T>>) {
        self.points.truncate(self.accepted);
        (self.points, self.boxes)
    }
}
