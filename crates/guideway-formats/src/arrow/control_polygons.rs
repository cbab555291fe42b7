//! Control polygons of a record batch: validates the list column of control points and finds the
//! rows that cannot be drawn.

use std::ops::{Range, Sub};

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type};
use arrow_array::{Array, ArrayRef, FixedSizeListArray};
use arrow_buffer::{NullBuffer, ScalarBuffer};
use arrow_schema::DataType;
use guideway_layout::Limits;
use guideway_spline::{Point, Real, greater};

use super::budget::Budget;
use super::column_names::CONTROL_POINTS;
use super::fault::Fault;
use super::list_array::{flat, unpacked};
use super::message_body::Body;
use super::point_items::{is_pair, is_point, pairs};
use super::problems::wrong_structure;
use crate::Problem;

/// Smallest number of control points of a cubic B-spline.
const MIN_POINTS: usize = 4;

/// Control polygons of a record batch: the points of all rows in sequence.
pub(super) struct ControlPolygons {
    rows: RowLayout,
    row_nulls: Option<NullBuffer>,
    /// Interleaved x and y of all points.
    pub(super) coordinates: Coordinates,
    /// Offset in the input of coordinates that were not read yet.
    pub(super) deferred: Option<usize>,
    /// Null buffers of points and coordinates, with the number of values per point.
    nulls: Vec<(NullBuffer, usize)>,
    /// Number of points with a third number.
    pub(super) heights: u64,
    len: usize,
}

/// Ranges of the points of each row.
enum RowLayout {
    /// Row `i` has the points `offsets[i]..offsets[i + 1]`.
    Offsets(ScalarBuffer<i32>),
    LargeOffsets(ScalarBuffer<i64>),
    /// The same number for each row.
    Fixed(usize),
}

/// Coordinates in the precision of the file.
pub(super) enum Coordinates {
    F32(ScalarBuffer<f32>),
    F64(ScalarBuffer<f64>),
}

impl Coordinates {
    /// Returns the bytes per point.
    pub(super) fn point_bytes(&self) -> usize {
        match self {
            Self::F32(_) => 8,
            Self::F64(_) => 16,
        }
    }
}

impl ControlPolygons {
    /// Interprets a list column of any kind as control polygons. A message has a body, in which
    /// coordinates may be deferred.
    pub(super) fn from_column(
        column: &ArrayRef,
        body: Option<&Body>,
        budget: &Budget,
    ) -> Result<Self, Problem> {
        let wrong_type = || {
            let expected = "list<fixed_size_list<float32 or float64, 2>>, or lists of points as \
                            list<number> or struct<x, y>";
            wrong_structure(CONTROL_POINTS, expected, &column.data_type().to_string())
        };
        let column = &flat(&unpacked(column, budget)?, budget)?;
        let (rows, items) = match column.data_type() {
            DataType::List(_) => {
                let list = column.as_list::<i32>();
                (
                    RowLayout::Offsets(list.offsets().inner().clone()),
                    list.values(),
                )
            }
            DataType::LargeList(_) => {
                let list = column.as_list::<i64>();
                let offsets = list.offsets().inner().clone();
                (RowLayout::LargeOffsets(offsets), list.values())
            }
            DataType::FixedSizeList(_, _) => {
                let list = column.as_fixed_size_list();
                (
                    RowLayout::Fixed(list.value_length() as usize),
                    list.values(),
                )
            }
            _ => return Err(wrong_type()),
        };
        let (points, heights) = match items.data_type() {
            item if is_pair(item) => (items.as_fixed_size_list().clone(), 0),
            item if is_point(item) => pairs(items, budget)?,
            _ => return Err(wrong_type()),
        };
        let (coordinates, deferred) = match points.values().data_type() {
            DataType::Float32 => {
                let values = points.values().as_primitive::<Float32Type>().values();
                let deferred = body.map(|body| body.deferred_offset(values)).transpose()?;
                (Coordinates::F32(values.clone()), deferred.flatten())
            }
            DataType::Float64 => {
                let values = points.values().as_primitive::<Float64Type>().values();
                let deferred = body.map(|body| body.deferred_offset(values)).transpose()?;
                (Coordinates::F64(values.clone()), deferred.flatten())
            }
            _ => return Err(wrong_type()),
        };
        Ok(Self {
            rows,
            row_nulls: non_empty_nulls(column.nulls()),
            coordinates,
            deferred,
            nulls: point_nulls(&points),
            heights,
            len: column.len(),
        })
    }

    pub(super) fn len(&self) -> usize {
        self.len
    }

    /// Returns the range of the points of a row. The decoder has checked that it is valid.
    pub(super) fn range(&self, row: usize) -> Range<usize> {
        match &self.rows {
            RowLayout::Offsets(o) => o[row] as usize..o[row + 1] as usize,
            RowLayout::LargeOffsets(o) => o[row] as usize..o[row + 1] as usize,
            RowLayout::Fixed(count) => row * count..(row + 1) * count,
        }
    }

    /// Returns the range of the points of several rows.
    pub(super) fn range_of_rows(&self, rows: Range<usize>) -> Range<usize> {
        if rows.is_empty() {
            return 0..0;
        }
        self.range(rows.start).start..self.range(rows.end - 1).end
    }

    /// Appends the ends of several rows; their first point gets index `first`.
    pub(super) fn add_ends(&self, rows: Range<usize>, first: usize, ends: &mut Vec<u32>) {
        let start = self.range_of_rows(rows.clone()).start;
        let end = |in_batch: usize| (in_batch - start + first) as u32;
        let next = rows.start + 1..rows.end + 1;
        match &self.rows {
            RowLayout::Offsets(o) => ends.extend(o[next].iter().map(|&o| end(o as usize))),
            RowLayout::LargeOffsets(o) => ends.extend(o[next].iter().map(|&o| end(o as usize))),
            RowLayout::Fixed(count) => ends.extend(next.map(|row| end(row * count))),
        }
    }

    /// Returns the smallest number of points per row.
    fn min_row_points(&self) -> usize {
        fn min_length<T: Copy + Ord + Sub<Output = T>>(offsets: &[T]) -> Option<T> {
            offsets
                .array_windows()
                .map(|&[start, end]| end - start)
                .min()
        }
        let min = match &self.rows {
            RowLayout::Offsets(o) => min_length(o).map(|min| min as usize),
            RowLayout::LargeOffsets(o) => min_length(o).map(|min| min as usize),
            RowLayout::Fixed(count) => Some(*count),
        };
        min.unwrap_or(usize::MAX)
    }

    /// Returns the rows that cannot be drawn, in ascending order. `points` are those of all rows,
    /// and `are_within` states whether all are within the limits.
    pub(super) fn faults<T: Real>(
        &self,
        points: &[Point<T>],
        are_within: bool,
        limits: &Limits,
    ) -> Vec<(usize, Fault)> {
        // Fast path: a valid file needs no test per row.
        let short = self.min_row_points() < MIN_POINTS;
        let nulls = self.row_nulls.is_some() || !self.nulls.is_empty();
        if are_within && !short && !nulls {
            return Vec::new();
        }
        (0..self.len)
            .filter_map(|row| Some((row, self.fault(row, points, limits)?)))
            .collect()
    }

    fn fault<T: Real>(&self, row: usize, points: &[Point<T>], limits: &Limits) -> Option<Fault> {
        if self.row_nulls.as_ref().is_some_and(|n| n.is_null(row)) {
            return Some(Fault::NoPoints);
        }
        let range = self.range(row);
        if range.len() < MIN_POINTS {
            return Some(Fault::TooFew(range.len()));
        }
        for (nulls, per_point) in &self.nulls {
            let mut values = range.start * per_point..range.end * per_point;
            if let Some(at) = values.position(|i| nulls.is_null(i)) {
                return Some(Fault::NoCoordinate(at / per_point));
            }
        }
        let first = self.range(0).start;
        let points = &points[range.start - first..range.end - first];
        if all_within(points, limits) {
            return None;
        }
        let limit = limit(limits);
        let is_far = |p: &Point<T>| greater(p.x.abs(), p.y.abs()) > limit;
        let non_finite = points.iter().position(|p| !p.is_finite());
        let far = || points.iter().position(is_far).map(Fault::OutOfRange);
        non_finite.map(Fault::NonFinite).or_else(far)
    }
}

/// Returns whether all coordinates are finite and within the limit.
pub(super) fn all_within<T: Real>(points: &[Point<T>], limits: &Limits) -> bool {
    let limit = limit::<T>(limits);
    // Comparison with NaN is false. The blocks let the compiler vectorize: a loop that may stop at
    // any point is not vectorized.
    for block in points.chunks(512) {
        let mut is_within = true;
        for p in block {
            is_within &= (-limit <= p.x) & (p.x <= limit) & (-limit <= p.y) & (p.y <= limit);
        }
        if !is_within {
            return false;
        }
    }
    true
}

/// Returns the coordinate limit, clamped to the largest finite number.
fn limit<T: Real>(limits: &Limits) -> T {
    T::of(limits.coordinate_m).min(T::max_value())
}

fn non_empty_nulls(nulls: Option<&NullBuffer>) -> Option<NullBuffer> {
    nulls.filter(|n| n.null_count() > 0).cloned()
}

/// Returns the null buffers of points (one value per point) and of coordinates (two).
fn point_nulls(points: &FixedSizeListArray) -> Vec<(NullBuffer, usize)> {
    let of_points = non_empty_nulls(points.nulls()).map(|n| (n, 1));
    let of_coordinates = non_empty_nulls(points.values().nulls()).map(|n| (n, 2));
    of_points.into_iter().chain(of_coordinates).collect()
}
