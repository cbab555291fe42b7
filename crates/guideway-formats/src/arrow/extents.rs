//! Extents of record batches: the rows of each and the box of its control points, in the metadata
//! of the footer of a file. By them a reader of an area skips the batches beyond it.

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type, UInt32Type};
use arrow_array::{Array, RecordBatch};
use guideway_layout::RunPoints;
use guideway_spline::{Bounds, Point};
use serde_json::{Value, json};

use super::column_names::{CONTROL_POINTS, PART};

/// Key of the extents in the metadata of the footer.
pub(super) const EXTENTS_KEY: &str = "guideway.extents";
/// Numbers of the extent of a batch: rows, and the corners of the box.
const NUMBERS: usize = 5;

/// Extent of a batch of paths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    pub(super) rows: usize,
    /// Box of the control points, in meters.
    pub(super) bounds: Bounds<f64>,
}

impl Extent {
    /// Returns `true` if a path of the batch may have a point in an area.
    pub(super) fn meets(self, area: Bounds<f64>) -> bool {
        self.bounds.intersects(area)
    }
}

/// The extents of the batches of a file, in their order; `None` for a batch without control points.
#[derive(Debug, Default)]
pub(super) struct Extents {
    all: Vec<Option<Extent>>,
    /// For each batch, whether its first row continues a path of the batch before.
    continues: Vec<bool>,
}

impl Extents {
    /// Appends the extent of a batch.
    pub(super) fn push(&mut self, batch: &RecordBatch) {
        let bounds = batch
            .column_by_name(CONTROL_POINTS)
            .and_then(|points| bounds(points));
        let rows = batch.num_rows();
        self.all.push(bounds.map(|bounds| Extent { rows, bounds }));
        let parts = batch.column_by_name(PART);
        let parts = parts.and_then(|parts| parts.as_primitive_opt::<UInt32Type>());
        let first = parts.filter(|parts| !parts.is_empty() && parts.is_valid(0));
        self.continues
            .push(first.is_some_and(|parts| parts.value(0) > 0));
    }

    /// The extents as text: a list with a list of numbers, or `null`, per batch. Batches that share
    /// a path have one box, so that a reader skips all of them or none.
    pub(super) fn into_text(mut self) -> String {
        let mut start = 0;
        for end in 1..=self.all.len() {
            if self.continues.get(end) == Some(&true) {
                continue;
            }
            let group = &mut self.all[start..end];
            let boxes = group.iter().flatten().map(|extent| extent.bounds);
            if let Some(common) = boxes.reduce(Bounds::union) {
                let extents = group.iter_mut().flatten();
                extents.for_each(|extent| extent.bounds = common);
            }
            start = end;
        }
        let numbers = |extent: &Option<Extent>| match extent {
            Some(Extent {
                rows,
                bounds: Bounds { min, max },
            }) => json!([rows, min.x, min.y, max.x, max.y]),
            None => Value::Null,
        };
        Value::Array(self.all.iter().map(numbers).collect()).to_string()
    }
}

/// Reads the extents of `batches` batches; `None` unless [`Extents::into_text`] wrote the text.
pub(super) fn extents(text: &str, batches: usize) -> Option<Vec<Option<Extent>>> {
    let all: Vec<Option<[f64; NUMBERS]>> = serde_json::from_str(text).ok()?;
    let extent = |numbers: &Option<[f64; NUMBERS]>| {
        let Some([rows, corners @ ..]) = *numbers else {
            return Some(None);
        };
        let [left, bottom, right, top] = corners;
        let is_valid = rows >= 0.0 && rows <= f64::from(u32::MAX) && left <= right && bottom <= top;
        is_valid.then_some(Some(Extent {
            rows: rows as usize,
            bounds: Bounds {
                min: Point::new(left, bottom),
                max: Point::new(right, top),
            },
        }))
    };
    let all: Option<Vec<_>> = all.iter().map(extent).collect();
    all.filter(|all| all.len() == batches)
}

/// The box of the control points of a column as this program writes it; `None` without any.
fn bounds(column: &dyn Array) -> Option<Bounds<f64>> {
    let list = column.as_list_opt::<i32>()?;
    let points = list.values().as_fixed_size_list_opt()?;
    let numbers = points.values();
    let points = if let Some(numbers) = numbers.as_primitive_opt::<Float32Type>() {
        RunPoints::F32(bytemuck::try_cast_slice(numbers.values()).ok()?)
    } else {
        let numbers = numbers.as_primitive_opt::<Float64Type>()?;
        RunPoints::F64(bytemuck::try_cast_slice(numbers.values()).ok()?)
    };
    points.bounds()
}
