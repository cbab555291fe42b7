use std::ops::Range;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type};
use arrow_array::{Array, ArrayRef, FixedSizeListArray};
use arrow_buffer::{NullBuffer, ScalarBuffer};
use arrow_schema::DataType;
use guideway_layout::{Code, Limits};
use guideway_spline::Real;
use rayon::prelude::*;

use super::CONTROL_POINTS;
use super::schema::structure;
use crate::Problem;

/// So many points are gone through by one thread.
pub(super) const AT_ONCE: usize = 1 << 14;

/// The control polygons of one record batch.
pub(super) struct Polygons {
    rows: Rows,
    row_nulls: Option<NullBuffer>,
    /// Coordinates of all points, x and y in turn.
    pub(super) coordinates: Coordinates,
    /// Points and coordinates that have no value, if there are any.
    nulls: Vec<(NullBuffer, usize)>,
    len: usize,
}

/// Where the points of each row are.
enum Rows {
    /// Row after row: row `i` has the points `offsets[i]..offsets[i + 1]`.
    Offsets(ScalarBuffer<i32>),
    LargeOffsets(ScalarBuffer<i64>),
    /// Row after row, so many each.
    Fixed(usize),
    /// Anywhere: start and length of each row.
    Views(ScalarBuffer<i32>, ScalarBuffer<i32>),
    LargeViews(ScalarBuffer<i64>, ScalarBuffer<i64>),
}

/// The coordinates, in the precision of the file.
pub(super) enum Coordinates {
    F32(ScalarBuffer<f32>),
    F64(ScalarBuffer<f64>),
}

impl Coordinates {
    pub(super) fn point_count(&self) -> usize {
        match self {
            Self::F32(c) => c.len() / 2,
            Self::F64(c) => c.len() / 2,
        }
    }

    pub(super) fn point_bytes(&self) -> usize {
        match self {
            Self::F32(_) => 8,
            Self::F64(_) => 16,
        }
    }
}

/// Why the curve of a row cannot be drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fault {
    NoPoints,
    NoCoordinate(usize),
    TooFew(usize),
    NonFinite(usize),
    OutOfRange(usize),
}

impl Fault {
    pub(super) fn code(self) -> Code {
        match self {
            Self::NoPoints | Self::NoCoordinate(_) => Code::MissingField,
            Self::TooFew(_) => Code::TooFewPoints,
            Self::NonFinite(_) => Code::NonFinite,
            Self::OutOfRange(_) => Code::OutOfRange,
        }
    }

    pub(super) fn detail(self, limits: &Limits) -> String {
        match self {
            Self::NoPoints => "control_points is null".into(),
            Self::NoCoordinate(at) => format!("control point {at} is null"),
            Self::TooFew(count) => format!("{count} control points; a curve needs four"),
            Self::NonFinite(at) => format!("control point {at} is not finite"),
            Self::OutOfRange(at) => format!(
                "control point {at} is more than {} m from the origin",
                limits.coordinate_m
            ),
        }
    }
}

impl Polygons {
    /// The polygons of a column, whichever kind of list it is.
    pub(super) fn of(column: &ArrayRef) -> Result<Self, Problem> {
        let unfit = || {
            let expected = "list<fixed_size_list<float32 or float64, 2>>";
            structure(CONTROL_POINTS, expected, &column.data_type().to_string())
        };
        let (rows, items) = match column.data_type() {
            DataType::List(_) => {
                let list = column.as_list::<i32>();
                (Rows::Offsets(list.offsets().inner().clone()), list.values())
            }
            DataType::LargeList(_) => {
                let list = column.as_list::<i64>();
                let offsets = list.offsets().inner().clone();
                (Rows::LargeOffsets(offsets), list.values())
            }
            DataType::FixedSizeList(_, _) => {
                let list = column.as_fixed_size_list();
                (Rows::Fixed(list.value_length() as usize), list.values())
            }
            DataType::ListView(_) => {
                let list = column.as_list_view::<i32>();
                let rows = Rows::Views(list.offsets().clone(), list.sizes().clone());
                (rows, list.values())
            }
            DataType::LargeListView(_) => {
                let list = column.as_list_view::<i64>();
                let rows = Rows::LargeViews(list.offsets().clone(), list.sizes().clone());
                (rows, list.values())
            }
            _ => return Err(unfit()),
        };
        let points = items.as_fixed_size_list_opt().ok_or_else(unfit)?;
        if points.value_length() != 2 {
            return Err(unfit());
        }
        let coordinates = match points.values().data_type() {
            DataType::Float32 => {
                let values = points.values().as_primitive::<Float32Type>();
                Coordinates::F32(values.values().clone())
            }
            DataType::Float64 => {
                let values = points.values().as_primitive::<Float64Type>();
                Coordinates::F64(values.values().clone())
            }
            _ => return Err(unfit()),
        };
        Ok(Self {
            rows,
            row_nulls: some_nulls(column.nulls()),
            coordinates,
            nulls: point_nulls(points),
            len: column.len(),
        })
    }

    pub(super) fn len(&self) -> usize {
        self.len
    }

    /// Range of the points of a row. It lies within the points: the decoder has checked that.
    pub(super) fn range(&self, row: usize) -> Range<usize> {
        match &self.rows {
            Rows::Offsets(o) => o[row] as usize..o[row + 1] as usize,
            Rows::LargeOffsets(o) => o[row] as usize..o[row + 1] as usize,
            Rows::Fixed(count) => row * count..(row + 1) * count,
            Rows::Views(o, s) => o[row] as usize..o[row] as usize + s[row] as usize,
            Rows::LargeViews(o, s) => o[row] as usize..o[row] as usize + s[row] as usize,
        }
    }

    /// The points of a range of rows as one range, if they lie row after row.
    pub(super) fn range_of_rows(&self, rows: Range<usize>) -> Option<Range<usize>> {
        match &self.rows {
            Rows::Views(..) | Rows::LargeViews(..) => None,
            _ if rows.is_empty() => Some(0..0),
            _ => Some(self.range(rows.start).start..self.range(rows.end - 1).end),
        }
    }

    /// Number of control points of all rows together.
    pub(super) fn point_count(&self) -> u64 {
        match self.range_of_rows(0..self.len) {
            Some(range) => range.len() as u64,
            None => (0..self.len).map(|row| self.range(row).len() as u64).sum(),
        }
    }

    /// The rows that cannot be drawn, in order.
    pub(super) fn faults(&self, limits: &Limits) -> Vec<(usize, Fault)> {
        match &self.coordinates {
            Coordinates::F32(c) => self.faults_in(c, limits),
            Coordinates::F64(c) => self.faults_in(c, limits),
        }
    }

    fn faults_in<T: Real>(&self, coordinates: &[T], limits: &Limits) -> Vec<(usize, Fault)> {
        // Most files are sound: that takes one pass over the numbers, without a branch for each.
        let short = (0..self.len).any(|row| self.range(row).len() < 4);
        let nulls = self.row_nulls.is_some() || !self.nulls.is_empty();
        let parts = coordinates.par_chunks(2 * AT_ONCE);
        if !short && !nulls && parts.all(|part| all_within(part, limit(limits))) {
            return Vec::new();
        }
        (0..self.len)
            .filter_map(|row| Some((row, self.fault(row, coordinates, limits)?)))
            .collect()
    }

    fn fault<T: Real>(&self, row: usize, coordinates: &[T], limits: &Limits) -> Option<Fault> {
        if self.row_nulls.as_ref().is_some_and(|n| n.is_null(row)) {
            return Some(Fault::NoPoints);
        }
        let range = self.range(row);
        if range.len() < 4 {
            return Some(Fault::TooFew(range.len()));
        }
        for (nulls, per_point) in &self.nulls {
            let mut values = range.start * per_point..range.end * per_point;
            if let Some(at) = values.position(|i| nulls.is_null(i)) {
                return Some(Fault::NoCoordinate(at / per_point));
            }
        }
        let values = &coordinates[2 * range.start..2 * range.end];
        let limit = limit::<T>(limits);
        if all_within(values, limit) {
            return None;
        }
        let at = |bad: &dyn Fn(T) -> bool| values.iter().position(|&v| bad(v)).map(|i| i / 2);
        at(&|v| !v.is_finite())
            .map(Fault::NonFinite)
            .or_else(|| at(&|v| v.abs() > limit).map(Fault::OutOfRange))
    }
}

/// x and y of a range of points.
pub(super) fn pairs<T>(coordinates: &[T], range: Range<usize>) -> &[[T; 2]] {
    let (pairs, _) = coordinates[2 * range.start..2 * range.end].as_chunks();
    pairs
}

/// Whether all values are finite and at most `limit` from zero.
fn all_within<T: Real>(values: &[T], limit: T) -> bool {
    // Comparison with NaN is false. A block at a time: a loop that may stop anywhere is not vectorised.
    for block in values.chunks(1024) {
        let mut is_within = true;
        for &value in block {
            is_within &= (-limit <= value) & (value <= limit);
        }
        if !is_within {
            return false;
        }
    }
    true
}

/// The largest coordinate, at most the largest finite number.
fn limit<T: Real>(limits: &Limits) -> T {
    T::of(limits.coordinate_m).min(T::max_value())
}

fn some_nulls(nulls: Option<&NullBuffer>) -> Option<NullBuffer> {
    nulls.filter(|n| n.null_count() > 0).cloned()
}

/// Null points with one value a point, null coordinates with two.
fn point_nulls(points: &FixedSizeListArray) -> Vec<(NullBuffer, usize)> {
    let of_points = some_nulls(points.nulls()).map(|n| (n, 1));
    let of_coordinates = some_nulls(points.values().nulls()).map(|n| (n, 2));
    of_points.into_iter().chain(of_coordinates).collect()
}
