//! Extents of record batches: the rows of each and the box of its positions, in the metadata of the
//! footer of a file. By them a reader of an area skips the batches beyond it.

use std::ops::Range;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type, Int8Type, UInt32Type};
use arrow_array::{Array, ArrayRef, RecordBatch};
use guideway_layout::RunPoints;
use guideway_spline::{Bounds, Point};
use serde_json::{Value, json};

use super::column_names::{CONTROL_POINTS, ELEMENT, OF, PART, X, Y};
use super::element::Element;

/// Key of the extents in the metadata of the footer.
pub(super) const EXTENTS_KEY: &str = "guideway.extents";

/// Extent of a batch of elements of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    pub(super) rows: usize,
    /// Box of the control points or positions, in meters.
    pub(super) bounds: Bounds<f64>,
    /// Paths and nodes that the batch begins; `None` if each row is a path, in a table of paths.
    pub(super) begun: Option<[u32; 2]>,
}

impl Extent {
    /// Returns `true` if an element of the batch may have a point in an area.
    pub(super) fn meets(self, area: Bounds<f64>) -> bool {
        self.bounds.intersects(area)
    }
}

/// The extents of the batches of a file, in their order.
#[derive(Debug, Default)]
pub(super) struct Extents {
    all: Vec<Written>,
    /// The table has a column of kinds.
    is_network: bool,
    /// Paths and nodes so far.
    numbers: [u32; 2],
}

/// Extent of a batch that was written.
#[derive(Debug)]
struct Written {
    rows: usize,
    /// `None` for a batch without positions, which every reader needs.
    bounds: Option<Bounds<f64>>,
    /// Paths and nodes that the batch begins.
    numbers: [Range<u32>; 2],
    /// The first row continues a path of the batch before.
    continues: bool,
    /// Kind and numbers of the elements that the rows of a type belong to.
    of: Option<(usize, Range<u32>)>,
}

/// Places of paths and nodes in [`Extent::begun`].
const PATHS: usize = 0;
const NODES: usize = 1;

impl Extents {
    /// Appends the extent of a batch.
    pub(super) fn push(&mut self, batch: &RecordBatch) {
        let rows = batch.num_rows();
        self.is_network = batch.column_by_name(ELEMENT).is_some();
        let parts = batch.column_by_name(PART);
        let parts = parts.and_then(|parts| parts.as_primitive_opt::<UInt32Type>());
        let is_continued =
            |row: usize| parts.is_some_and(|parts| parts.is_valid(row) && parts.value(row) > 0);
        let column = |name| batch.column_by_name(name);
        let kind = kind(batch);
        let begun = match kind {
            Some(Element::Path) => {
                let begun = (0..rows).filter(|&row| !is_continued(row)).count();
                [begun as u32, 0]
            }
            Some(Element::Node) => [0, rows as u32],
            _ => [0, 0],
        };
        let numbers = [PATHS, NODES].map(|of| self.numbers[of]..self.numbers[of] + begun[of]);
        self.numbers = [PATHS, NODES].map(|of| numbers[of].end);
        let of = match kind {
            Some(Element::PathType) => Some(PATHS),
            Some(Element::NodeType) => Some(NODES),
            _ => None,
        };
        self.all.push(Written {
            rows,
            bounds: match kind {
                Some(Element::Path) => column(CONTROL_POINTS).and_then(|points| bounds(points)),
                Some(Element::Node) => positions(column(X), column(Y)),
                _ => None,
            },
            numbers,
            continues: kind == Some(Element::Path) && rows > 0 && is_continued(0),
            of: of.and_then(|of| Some((of, range(column(OF)?)?))),
        });
    }

    /// The extents as text: a list with a list of numbers, or `null`, per batch. Batches that share
    /// a path have one box, so that a reader skips all of them or none.
    pub(super) fn into_text(mut self) -> String {
        let mut start = 0;
        for end in 1..=self.all.len() {
            if self.all.get(end).is_some_and(|next| next.continues) {
                continue;
            }
            let group = &mut self.all[start..end];
            let boxes = group.iter().filter_map(|written| written.bounds);
            if let Some(common) = boxes.reduce(Bounds::union) {
                let boxes = group.iter_mut().filter_map(|of| of.bounds.as_mut());
                boxes.for_each(|bounds| *bounds = common);
            }
            start = end;
        }
        let numbers = |written: &Written| {
            let Some(Bounds { min, max }) = self.bounds(written) else {
                return Value::Null;
            };
            let rows = written.rows;
            match written.numbers.each_ref().map(ExactSizeIterator::len) {
                [paths, 0] if paths == rows && !self.is_network => {
                    json!([rows, min.x, min.y, max.x, max.y])
                }
                [paths, nodes] => json!([rows, min.x, min.y, max.x, max.y, paths, nodes]),
            }
        };
        Value::Array(self.all.iter().map(numbers).collect()).to_string()
    }

    /// The box of a batch; that of rows of a type is the box of the batches of their elements.
    fn bounds(&self, written: &Written) -> Option<Bounds<f64>> {
        let Some((of, numbers)) = &written.of else {
            return written.bounds;
        };
        let end = self
            .all
            .partition_point(|other| other.numbers[*of].start < numbers.end);
        let elements = self.all[..end].iter().rev();
        let elements = elements.take_while(|other| other.numbers[*of].end > numbers.start);
        let elements = elements.filter(|other| !other.numbers[*of].is_empty());
        // One without a box may be anywhere.
        let boxes: Option<Vec<_>> = elements.map(|other| other.bounds).collect();
        boxes?.into_iter().reduce(Bounds::union)
    }
}

/// Reads the extents of `batches` batches; `None` unless [`Extents::into_text`] wrote the text.
pub(super) fn extents(text: &str, batches: usize) -> Option<Vec<Option<Extent>>> {
    let all: Vec<Option<Vec<f64>>> = serde_json::from_str(text).ok()?;
    let count = |number: f64| {
        let is_valid = number >= 0.0 && number <= f64::from(u32::MAX);
        is_valid.then_some(number as u32)
    };
    let extent = |numbers: &Option<Vec<f64>>| {
        let Some(numbers) = numbers else {
            return Some(None);
        };
        let (&[rows, left, bottom, right, top], begun) = match &numbers[..] {
            [extent @ .., paths, nodes] if numbers.len() == 7 => {
                let begun = [count(*paths)?, count(*nodes)?];
                (extent.first_chunk()?, Some(begun))
            }
            extent => (<&[f64; 5]>::try_from(extent).ok()?, None),
        };
        let rows = count(rows)?;
        let is_valid = begun.is_none_or(|begun| begun.iter().all(|&count| count <= rows));
        (is_valid && left <= right && bottom <= top).then_some(Some(Extent {
            rows: rows as usize,
            bounds: Bounds {
                min: Point::new(left, bottom),
                max: Point::new(right, top),
            },
            begun,
        }))
    };
    let all: Option<Vec<_>> = all.iter().map(extent).collect();
    all.filter(|all| all.len() == batches)
}

/// The kind of the rows of a batch as this program writes it; `None` of an empty batch.
fn kind(batch: &RecordBatch) -> Option<Element> {
    let Some(names) = batch.column_by_name(ELEMENT) else {
        return Some(Element::Path);
    };
    let names = names.as_dictionary_opt::<Int8Type>()?;
    let first = names.keys().iter().next()??;
    let texts = names.values().as_string_opt::<i32>()?;
    Element::named(texts.value(first as usize))
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

/// The box of positions.
fn positions(x: Option<&ArrayRef>, y: Option<&ArrayRef>) -> Option<Bounds<f64>> {
    let numbers = |column: Option<&ArrayRef>| {
        let column = column?.as_primitive_opt::<Float64Type>()?;
        (column.null_count() == 0).then(|| column.values().clone())
    };
    let (x, y) = (numbers(x)?, numbers(y)?);
    Bounds::of_points(x.iter().zip(&y).map(|(&x, &y)| Point::new(x, y)))
}

/// The range of the numbers of a column without nulls.
fn range(column: &dyn Array) -> Option<Range<u32>> {
    let column = column.as_primitive_opt::<UInt32Type>()?;
    let least = column.values().iter().min()?;
    let most = column.values().iter().max()?;
    (column.null_count() == 0).then(|| *least..most.saturating_add(1))
}
