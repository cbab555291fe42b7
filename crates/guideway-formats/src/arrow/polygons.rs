use std::ops::{Range, Sub};
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type};
use arrow_array::{Array, ArrayRef, FixedSizeListArray};
use arrow_buffer::{NullBuffer, ScalarBuffer};
use arrow_schema::DataType;
use guideway_layout::{Code, Limits};
use guideway_spline::{Point, Real, greater};

use super::CONTROL_POINTS;
use super::batch::cast;
use super::body::Body;
use super::budget::Budget;
use super::schema::structure;
use crate::Problem;

/// Points of a curve, at least.
const LEAST_POINTS: usize = 4;
/// Bytes of a point of the greater precision.
const MOST_POINT_BYTES: u64 = 16;

/// The control polygons of one record batch: row after row of points.
pub(super) struct Polygons {
    rows: Rows,
    row_nulls: Option<NullBuffer>,
    /// Coordinates of all points, x and y in turn.
    pub(super) coordinates: Coordinates,
    /// Where in the input they are if they were not read yet.
    pub(super) left_out: Option<usize>,
    /// Points and coordinates that have no value, if there are any.
    nulls: Vec<(NullBuffer, usize)>,
    len: usize,
}

/// Which points each row has.
enum Rows {
    /// Row `i` has the points `offsets[i]..offsets[i + 1]`.
    Offsets(ScalarBuffer<i32>),
    LargeOffsets(ScalarBuffer<i64>),
    /// So many each.
    Fixed(usize),
}

/// The coordinates, in the precision of the file.
pub(super) enum Coordinates {
    F32(ScalarBuffer<f32>),
    F64(ScalarBuffer<f64>),
}

impl Coordinates {
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
    pub(super) fn of(column: &ArrayRef, body: &Body, budget: &Budget) -> Result<Self, Problem> {
        let unfit = || {
            let expected = "list<fixed_size_list<float32 or float64, 2>>";
            structure(CONTROL_POINTS, expected, &column.data_type().to_string())
        };
        let column = &row_after_row(column, budget)?;
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
            _ => return Err(unfit()),
        };
        let points = items.as_fixed_size_list_opt().ok_or_else(unfit)?;
        if points.value_length() != 2 {
            return Err(unfit());
        }
        let (coordinates, left_out) = match points.values().data_type() {
            DataType::Float32 => {
                let values = points.values().as_primitive::<Float32Type>().values();
                (Coordinates::F32(values.clone()), body.left_out(values)?)
            }
            DataType::Float64 => {
                let values = points.values().as_primitive::<Float64Type>().values();
                (Coordinates::F64(values.clone()), body.left_out(values)?)
            }
            _ => return Err(unfit()),
        };
        Ok(Self {
            rows,
            row_nulls: some_nulls(column.nulls()),
            coordinates,
            left_out,
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
        }
    }

    /// Range of the points of some rows.
    pub(super) fn range_of_rows(&self, rows: Range<usize>) -> Range<usize> {
        if rows.is_empty() {
            return 0..0;
        }
        self.range(rows.start).start..self.range(rows.end - 1).end
    }

    /// Appends where the points of some rows end, the first of which has number `first` in the list that these are of.
    pub(super) fn add_ends(&self, rows: Range<usize>, first: usize, ends: &mut Vec<u32>) {
        let start = self.range_of_rows(rows.clone()).start;
        let end = |of_batch: usize| (of_batch - start + first) as u32;
        let behind = rows.start + 1..rows.end + 1;
        match &self.rows {
            Rows::Offsets(o) => ends.extend(o[behind].iter().map(|&o| end(o as usize))),
            Rows::LargeOffsets(o) => ends.extend(o[behind].iter().map(|&o| end(o as usize))),
            Rows::Fixed(count) => ends.extend(behind.map(|row| end(row * count))),
        }
    }

    /// Number of points of the row that has the fewest.
    fn fewest(&self) -> usize {
        fn least<T: Copy + Ord + Sub<Output = T>>(offsets: &[T]) -> Option<T> {
            offsets
                .array_windows()
                .map(|&[start, end]| end - start)
                .min()
        }
        let fewest = match &self.rows {
            Rows::Offsets(o) => least(o).map(|few| few as usize),
            Rows::LargeOffsets(o) => least(o).map(|few| few as usize),
            Rows::Fixed(count) => Some(*count),
        };
        fewest.unwrap_or(usize::MAX)
    }

    /// The rows that cannot be drawn, in order, by the points of all rows.
    pub(super) fn faults<T: Real>(
        &self,
        points: &[Point<T>],
        are_within: bool,
        limits: &Limits,
    ) -> Vec<(usize, Fault)> {
        // Most files are sound, and the points were looked at as they came.
        let short = self.fewest() < LEAST_POINTS;
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
        if range.len() < LEAST_POINTS {
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

/// The column with the points of its rows one behind the other: views may name the same points again and again, and then these
/// are copied again and again.
fn row_after_row(column: &ArrayRef, budget: &Budget) -> Result<ArrayRef, Problem> {
    let (items, values, points) = match column.data_type() {
        DataType::ListView(items) => {
            let views = column.as_list_view::<i32>();
            let sizes = views.sizes().iter().map(|&size| size as u64);
            (items, views.values(), sizes.sum::<u64>())
        }
        DataType::LargeListView(items) => {
            let views = column.as_list_view::<i64>();
            let sizes = views.sizes().iter().map(|&size| size as u64);
            (items, views.values(), sizes.sum::<u64>())
        }
        _ => return Ok(Arc::clone(column)),
    };
    let again = points.saturating_sub(values.len() as u64);
    let point_bytes = match items.data_type() {
        DataType::FixedSizeList(coordinate, 2) => coordinate.data_type().primitive_width(),
        _ => None,
    };
    let point_bytes = point_bytes.map_or(MOST_POINT_BYTES, |bytes| 2 * bytes as u64);
    budget.charge(again.saturating_mul(point_bytes))?;
    cast(column, &DataType::LargeList(Arc::clone(items)))
}

/// Whether all coordinates are finite and within the limit.
pub(super) fn all_within<T: Real>(points: &[Point<T>], limits: &Limits) -> bool {
    let limit = limit::<T>(limits);
    // Comparison with NaN is false. A block at a time: a loop that may stop anywhere is not vectorised.
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
