//! [`joined`]: a table of edges and one of nodes, as CSV files have them, as one table of a layout.
//!
//! Input: edges with the identifiers of their nodes, nodes with positions. Output: the rows of both
//! under one schema, as `docs/arrow-format.md` describes them; edges are straight lines.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type};
use arrow_array::{
    Array, ArrayRef, FixedSizeListArray, Float64Array, ListArray, RecordBatch, RecordBatchIterator,
    RecordBatchReader, StringArray, UInt32Array, downcast_integer_array, new_null_array,
};
use arrow_buffer::{ArrowNativeType, OffsetBuffer};
use arrow_schema::{ArrowError, DataType, Field, FieldRef, Schema, SchemaRef};
use guideway::spline::{Point, Runs};
use pyo3::prelude::*;

use crate::error::bad_argument;

/// Columns with a meaning of their own in the joined table.
const ELEMENT: &str = "guideway.element";
const CONTROL_POINTS: &str = "control_points";
const START_NODE: &str = "start_node";
const END_NODE: &str = "end_node";
const ID: &str = "id";
const X: &str = "x_m";
const Y: &str = "y_m";

/// A row of the nodes: its number, and its position in meters.
type Node = (u32, Point<f64>);

/// Joins a table of edges and one of nodes.
///
/// # Errors
/// When a column is missing or of another type, two nodes have one identifier, or an edge names a
/// node that is not there.
pub(crate) fn joined(
    edges: impl RecordBatchReader,
    nodes: impl RecordBatchReader,
) -> PyResult<impl RecordBatchReader + Send> {
    let edges = batches("edges", edges)?;
    let nodes = batches("nodes", nodes)?;
    let known = nodes_by_id(&nodes)?;
    let mut tables = Vec::new();
    let (mut row, has_curves) = (0, has(&edges, CONTROL_POINTS));
    for batch in &edges {
        let mut table = Rows::new("path", batch, &[START_NODE, END_NODE]);
        let start = ends(batch, START_NODE, row, &known)?;
        let end = ends(batch, END_NODE, row, &known)?;
        if !has_curves {
            table.push(CONTROL_POINTS, straight_lines(&start, &end)?);
        }
        let numbers = |of: &[Node]| UInt32Array::from_iter_values(of.iter().map(|node| node.0));
        table.push(START_NODE, Arc::new(numbers(&start)));
        table.push(END_NODE, Arc::new(numbers(&end)));
        row += batch.num_rows();
        tables.push(table);
    }
    for batch in &nodes {
        let mut table = Rows::new("node", batch, &axes(batch)?);
        for (name, axis) in [X, Y].into_iter().zip(axes(batch)?) {
            let values = (0..batch.num_rows()).map(|row| number(batch, axis, row));
            let values: Float64Array = values.collect::<PyResult<_>>()?;
            table.push(name, Arc::new(values));
        }
        tables.push(table);
    }
    one_table(&tables)
}

/// Rows of one kind of element: their columns by name.
struct Rows {
    count: usize,
    columns: Vec<(FieldRef, ArrayRef)>,
}

impl Rows {
    /// The rows of a batch, without some columns.
    fn new(element: &str, batch: &RecordBatch, without: &[&str]) -> Self {
        let count = batch.num_rows();
        let mut columns = Vec::new();
        for (field, array) in batch.schema().fields().iter().zip(batch.columns()) {
            let name = field.name();
            if name != ID && name != ELEMENT && !without.contains(&name.as_str()) {
                columns.push((Arc::clone(field), Arc::clone(array)));
            }
        }
        let mut rows = Self { count, columns };
        rows.push(ELEMENT, Arc::new(StringArray::from(vec![element; count])));
        if let Some(ids) = batch.column_by_name(ID) {
            let ids = (0..count).map(|row| text(ids, row));
            rows.push(ID, Arc::new(ids.collect::<StringArray>()));
        }
        rows
    }

    fn push(&mut self, name: &str, array: ArrayRef) {
        let field = Field::new(name, array.data_type().clone(), true);
        self.columns.push((Arc::new(field), array));
    }
}

/// Puts rows under one schema. Columns of one name and different types stay apart.
fn one_table(tables: &[Rows]) -> PyResult<impl RecordBatchReader + Send + use<>> {
    let mut fields: Vec<FieldRef> = Vec::new();
    for (field, _) in tables.iter().flat_map(|rows| &rows.columns) {
        if !fields.iter().any(|known| is_same(known, field)) {
            fields.push(Arc::clone(field));
        }
    }
    let named = |(at, field): (usize, &FieldRef)| {
        let before = fields[..at].iter().filter(|of| of.name() == field.name());
        let name = match before.count() {
            0 => field.name().clone(),
            1 => format!("attribute.{}", field.name()),
            more => format!("attribute{more}.{}", field.name()),
        };
        field.as_ref().clone().with_name(name).with_nullable(true)
    };
    let version = HashMap::from([("guideway.version".to_owned(), "2".to_owned())]);
    let schema = fields.iter().enumerate().map(named).collect::<Vec<_>>();
    let schema: SchemaRef = Arc::new(Schema::new_with_metadata(schema, version));
    let batch = |rows: &Rows| {
        let array = |field: &FieldRef| {
            let own = rows.columns.iter().find(|(own, _)| is_same(own, field));
            match own {
                Some((_, array)) => Arc::clone(array),
                None => new_null_array(field.data_type(), rows.count),
            }
        };
        RecordBatch::try_new(Arc::clone(&schema), fields.iter().map(array).collect())
    };
    let batches: Vec<Result<RecordBatch, ArrowError>> = tables.iter().map(batch).collect();
    Ok(RecordBatchIterator::new(batches, schema))
}

fn is_same(a: &Field, b: &Field) -> bool {
    a.name() == b.name() && a.data_type() == b.data_type()
}

fn batches(name: &str, reader: impl RecordBatchReader) -> PyResult<Vec<RecordBatch>> {
    let all: Result<Vec<_>, _> = reader.collect();
    all.map_err(|error| bad_argument(format!("{name}: {error}"), "Pass a table that can be read"))
}

fn has(batches: &[RecordBatch], name: &str) -> bool {
    let mut all = batches.iter();
    all.any(|batch| batch.column_by_name(name).is_some())
}

/// The column of a table.
fn column<'a>(batch: &'a RecordBatch, table: &str, name: &str) -> PyResult<&'a ArrayRef> {
    batch.column_by_name(name).ok_or_else(|| {
        let schema = batch.schema();
        let known: Vec<&str> = schema.fields().iter().map(|f| f.name().as_str()).collect();
        let message = format!("{table} have no column `{name}`, only {}", known.join(", "));
        bad_argument(message, "Rename the column")
    })
}

/// Names of the columns with the position: `x_m` and `y_m`, else `x` and `y`.
fn axes(batch: &RecordBatch) -> PyResult<[&'static str; 2]> {
    if batch.column_by_name(X).is_none() && batch.column_by_name("x").is_some() {
        return Ok(["x", "y"]);
    }
    column(batch, "nodes", X).map(|_| [X, Y])
}

fn nodes_by_id(nodes: &[RecordBatch]) -> PyResult<HashMap<String, Node>> {
    let mut known = HashMap::new();
    for batch in nodes {
        let (ids, [x, y]) = (column(batch, "nodes", ID)?, axes(batch)?);
        for row in 0..batch.num_rows() {
            let number_of = known.len();
            let id = text(ids, row).ok_or_else(|| {
                let message = format!("nodes, row {number_of}: no id");
                bad_argument(message, "Give text or whole numbers")
            })?;
            let position = Point::new(number(batch, x, row)?, number(batch, y, row)?);
            if known
                .insert(id.clone(), (number_of as u32, position))
                .is_some()
            {
                let message = format!("nodes, row {number_of}: a second node `{id}`");
                return Err(bad_argument(message, "Give each node an id of its own"));
            }
        }
    }
    Ok(known)
}

/// The nodes that a column of edges names; `first` is the number of its first row.
fn ends(
    batch: &RecordBatch,
    name: &str,
    first: usize,
    known: &HashMap<String, Node>,
) -> PyResult<Vec<Node>> {
    let ids = column(batch, "edges", name)?;
    let end = |row| {
        let id = text(ids, row);
        let node = id.as_ref().and_then(|id| known.get(id)).copied();
        node.ok_or_else(|| {
            let id = id.map_or("nothing".to_owned(), |id| format!("`{id}`"));
            let message = format!(
                "edges, row {}: {name} is {id}, no id of a node",
                first + row
            );
            bad_argument(message, "Add the node, or correct the edge")
        })
    };
    (0..batch.num_rows()).map(end).collect()
}

/// A text or whole number of a column, as text; `None` for null and values of other types.
fn text(column: &ArrayRef, row: usize) -> Option<String> {
    if column.is_null(row) {
        return None;
    }
    let column = column.as_ref();
    downcast_integer_array!(
        column => Some(column.value(row).to_string()),
        DataType::Utf8 => Some(column.as_string::<i32>().value(row).to_owned()),
        DataType::LargeUtf8 => Some(column.as_string::<i64>().value(row).to_owned()),
        DataType::Utf8View => Some(column.as_string_view().value(row).to_owned()),
        _ => None,
    )
}

/// A number of a column of the nodes.
fn number(batch: &RecordBatch, name: &str, row: usize) -> PyResult<f64> {
    let column = column(batch, "nodes", name)?.as_ref();
    let found = downcast_integer_array!(
        column => {
            let whole = column.is_valid(row).then(|| column.value(row).to_i64());
            whole.flatten().map(|whole| whole as f64)
        },
        DataType::Float64 => {
            let column = column.as_primitive::<Float64Type>();
            column.is_valid(row).then(|| column.value(row))
        },
        DataType::Float32 => {
            let column = column.as_primitive::<Float32Type>();
            column.is_valid(row).then(|| f64::from(column.value(row)))
        },
        _ => None,
    );
    found.filter(|number| number.is_finite()).ok_or_else(|| {
        let of = column.data_type();
        let message = format!("nodes, row {row}: no number in the column `{name}` ({of})");
        bad_argument(message, "Give finite numbers in meters")
    })
}

/// Control points of straight lines.
fn straight_lines(start: &[Node], end: &[Node]) -> PyResult<ArrayRef> {
    let mut runs = Runs::default();
    let mut values = Vec::new();
    let mut lengths = Vec::with_capacity(start.len());
    for ((_, start), (_, end)) in start.iter().zip(end) {
        runs.clear();
        runs.push_line(*start, *end);
        values.extend(runs.points().iter().flat_map(|p| [p.x, p.y]));
        lengths.push(runs.points().len());
    }
    let failed = |error: ArrowError| bad_argument(error.to_string(), "Pass fewer edges per batch");
    let number = Arc::new(Field::new("item", DataType::Float64, false));
    let points = Arc::new(Float64Array::from(values));
    let points = FixedSizeListArray::try_new(number, 2, points, None).map_err(failed)?;
    let item = Arc::new(Field::new("item", points.data_type().clone(), false));
    let offsets = OffsetBuffer::from_lengths(lengths);
    let lists = ListArray::try_new(item, offsets, Arc::new(points), None);
    Ok(Arc::new(lists.map_err(failed)?))
}
