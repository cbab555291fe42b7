//! Tables of edges, nodes, stations and sampled points, as Arrow record batches.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::builder::{ListBuilder, StringBuilder};
use arrow_array::{
    Array, ArrayRef, BooleanArray, Float64Array, Int64Array, RecordBatch, RecordBatchIterator,
    StringArray, UInt32Array,
};
use arrow_schema::{ArrowError, Field, Schema};
use guideway::layout::{
    Attribute, Attributes, Direction, Layout, RunPoints, Value, Values, near_names,
};
use guideway::spline::{Point, flatten_run};
use pyo3::prelude::*;
use pyo3::types::PyCapsule;

use crate::error::bad_argument;
use crate::stream::to_capsule;

/// Most sampled points of one call.
const MAX_SAMPLES: f64 = 1e9;

/// A table with the Arrow C stream interface: `pyarrow.table(t)`, `polars.DataFrame(t)` and
/// `duckdb.sql("from t")` take it.
#[pyclass(frozen, module = "guideway")]
pub(crate) struct Table {
    batch: RecordBatch,
}

#[pymethods]
impl Table {
    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // The interface allows a producer to ignore the request.
        let _ = requested_schema;
        let batches = RecordBatchIterator::new([Ok(self.batch.clone())], self.batch.schema());
        to_capsule(py, batches)
    }

    fn __len__(&self) -> usize {
        self.batch.num_rows()
    }

    /// Names of the columns.
    #[getter]
    fn column_names(&self) -> Vec<String> {
        let schema = self.batch.schema();
        schema.fields().iter().map(|f| f.name().clone()).collect()
    }

    fn __repr__(&self) -> String {
        let names = self.column_names().join(", ");
        format!("<Table of {} rows: {names}>", self.batch.num_rows())
    }
}

/// Columns under construction.
#[derive(Default)]
pub(crate) struct Columns {
    fields: Vec<Field>,
    arrays: Vec<ArrayRef>,
}

impl Columns {
    pub(crate) fn push(&mut self, name: &str, array: impl Array + 'static) {
        self.push_with(name, None, Arc::new(array));
    }

    /// Appends a column of a type of its own.
    pub(crate) fn push_field(&mut self, field: Field, array: ArrayRef) {
        self.fields.push(field);
        self.arrays.push(array);
    }

    fn push_with(&mut self, name: &str, unit: Option<&str>, array: ArrayRef) {
        let mut field = Field::new(name, array.data_type().clone(), true);
        if let Some(unit) = unit {
            field.set_metadata(HashMap::from([("unit".to_owned(), unit.to_owned())]));
        }
        self.push_field(field, array);
    }

    /// Columns of a table of the layout. Those whose name is taken are `attribute.NAME`.
    fn push_attributes(&mut self, attributes: &Attributes, rows: &[u32]) {
        for column in attributes.iter() {
            let value = |row: u32| column.values.get(row as usize);
            self.push_attribute(column, rows.iter().map(|&row| value(row)));
        }
    }

    /// One column with these values.
    fn push_attribute<'a>(
        &mut self,
        column: &Attribute,
        values: impl Iterator<Item = Option<Value<'a>>>,
    ) {
        let is_taken = self.fields.iter().any(|f| *f.name() == column.name);
        let name = match is_taken {
            true => format!("attribute.{}", column.name),
            false => column.name.clone(),
        };
        let array: ArrayRef = match column.values {
            Values::Bool(_) => {
                let flags = values.map(|value| match value {
                    Some(Value::Bool(flag)) => Some(flag),
                    _ => None,
                });
                Arc::new(flags.collect::<BooleanArray>())
            }
            Values::Int(_) => {
                let numbers = values.map(|value| match value {
                    Some(Value::Int(number)) => Some(number),
                    _ => None,
                });
                Arc::new(numbers.collect::<Int64Array>())
            }
            Values::Float(_) => {
                let numbers = values.map(|value| value.and_then(Value::number));
                Arc::new(numbers.collect::<Float64Array>())
            }
            Values::Text(_) | Values::Json(_) => {
                let texts = values.map(|value| match value {
                    Some(Value::Text(text) | Value::Json(text)) => Some(text),
                    _ => None,
                });
                Arc::new(texts.collect::<StringArray>())
            }
        };
        let unit = column.quantity.map(|quantity| quantity.unit());
        self.push_with(&name, unit, array);
    }

    pub(crate) fn table(self) -> PyResult<Table> {
        let schema = Arc::new(Schema::new(self.fields));
        let failed = |error: ArrowError| bad_argument(error.to_string(), "Report this as a bug");
        let batch = RecordBatch::try_new(schema, self.arrays).map_err(failed)?;
        Ok(Table { batch })
    }
}

/// The edges: identifier, nodes, direction, level, vehicle types, length, then the properties, in
/// SI units. With a vehicle type: only the edges that it may use, with the values that hold for it.
pub(crate) fn edge_columns(layout: &Layout, vehicle_type: Option<&str>) -> Columns {
    let paths = &layout.paths;
    let types = paths.vehicle_types();
    let is_open = |row: &u32| {
        let row = *row as usize;
        vehicle_type
            .is_none_or(|name| types.of(row).len() == 0 || types.entry_for(row, name).is_some())
    };
    let rows: Vec<u32> = (0..paths.len() as u32).filter(is_open).collect();
    let each = || rows.iter().map(|&row| paths.get(row as usize));
    let node = |row: Option<u32>| row.map(|row| layout.nodes.id(row));
    let mut columns = Columns::default();
    columns.push(
        "id",
        each().map(|path| Some(path.id())).collect::<StringArray>(),
    );
    let starts = each().map(|path| node(path.start_node()));
    columns.push("start_node", starts.collect::<StringArray>());
    let ends = each().map(|path| node(path.end_node()));
    columns.push("end_node", ends.collect::<StringArray>());
    let directions = each().map(|path| match path.direction() {
        Direction::Forward => Some("forward"),
        Direction::Both => Some("both"),
    });
    columns.push("direction", directions.collect::<StringArray>());
    columns.push("level", level_ids(layout, each().map(|path| path.level())));
    let lists = rows.iter().map(|&row| types.of(row as usize));
    columns.push("vehicle_types", text_lists(lists));
    let lengths = each().map(|path| Some(path.length_m()));
    columns.push("length_m", lengths.collect::<Float64Array>());
    for name in paths.column_names() {
        let Some(column) = paths.column(name) else {
            continue;
        };
        let value = |&row: &u32| match vehicle_type {
            Some(of) => paths.value_for(row as usize, of, name),
            None => paths.value(row as usize, name),
        };
        columns.push_attribute(column, rows.iter().map(value));
    }
    columns
}

/// The edges that a vehicle type may use.
///
/// # Errors
/// When the layout has no such type.
pub(crate) fn edge_columns_for(layout: &Layout, vehicle_type: &str) -> PyResult<Columns> {
    let known = layout.vehicle_type_names();
    if known.contains(vehicle_type) {
        return Ok(edge_columns(layout, Some(vehicle_type)));
    }
    let near = near_names(vehicle_type, known.iter().copied());
    let known: Vec<&str> = match near.is_empty() {
        true => known.into_iter().collect(),
        false => near,
    };
    Err(bad_argument(
        format!("the layout has no vehicle type `{vehicle_type}`"),
        format!("Did you mean {}?", known.join(", ")),
    ))
}

/// The nodes: identifier, position, level, then the properties.
pub(crate) fn node_columns(layout: &Layout) -> Columns {
    let nodes = &layout.nodes;
    let rows: Vec<u32> = (0..nodes.len() as u32).collect();
    let mut columns = Columns::default();
    let ids = rows.iter().map(|&row| Some(nodes.id(row)));
    columns.push("id", ids.collect::<StringArray>());
    push_positions(
        &mut columns,
        rows.iter().map(|&row| Some(nodes.position_m(row))),
    );
    columns.push(
        "level",
        level_ids(layout, rows.iter().map(|&row| nodes.level(row))),
    );
    columns.push_attributes(&nodes.attributes, &rows);
    columns
}

/// The stations: identifier, position, level, nodes, then the properties.
pub(crate) fn station_columns(layout: &Layout) -> Columns {
    let stations = &layout.stations;
    let rows: Vec<u32> = (0..stations.len() as u32).collect();
    let mut columns = Columns::default();
    let ids = rows.iter().map(|&row| Some(stations.id(row)));
    columns.push("id", ids.collect::<StringArray>());
    let positions = rows.iter().map(|&row| layout.station_position_m(row));
    push_positions(&mut columns, positions);
    columns.push(
        "level",
        level_ids(layout, rows.iter().map(|&row| stations.level(row))),
    );
    let lists = rows.iter().map(|&row| {
        let nodes = stations.nodes(row).iter();
        nodes.map(|&node| layout.nodes.id(node))
    });
    columns.push("nodes", text_lists(lists));
    columns.push_attributes(&stations.attributes, &rows);
    columns
}

/// Points along every edge, from start to end, at most `spacing_m` apart along the curve: row and
/// identifier of the edge, distance from its start, position, heading in radians.
pub(crate) fn samples(layout: &Layout, spacing_m: f64) -> PyResult<Table> {
    if !(spacing_m > 0.0 && spacing_m.is_finite()) {
        let remedy = "Give a distance in meters above 0";
        return Err(bad_argument(format!("a spacing of {spacing_m} m"), remedy));
    }
    let lengths_m = layout.paths.iter().map(|path| path.length_m());
    let points = lengths_m.sum::<f64>() / spacing_m + layout.paths.len() as f64;
    if points > MAX_SAMPLES {
        return Err(bad_argument(
            format!("a spacing of {spacing_m} m makes {points:.0} points, limit {MAX_SAMPLES}"),
            "Give a greater distance",
        ));
    }
    let mut rows = Vec::new();
    let mut values: [Vec<f64>; 4] = Default::default();
    for path in layout.paths.iter() {
        path.sample(spacing_m, |sample| {
            rows.push(path.row() as u32);
            let at = sample.position_m;
            let of = [sample.along_m, at.x, at.y, sample.heading_rad];
            values
                .iter_mut()
                .zip(of)
                .for_each(|(column, value)| column.push(value));
        });
    }
    let mut columns = Columns::default();
    let ids = rows.iter().map(|&row| Some(layout.paths.id(row as usize)));
    let ids: StringArray = ids.collect();
    columns.push("edge", UInt32Array::from(rows));
    columns.push("id", ids);
    let names = [
        ("along_m", "m"),
        ("x_m", "m"),
        ("y_m", "m"),
        ("heading_rad", "rad"),
    ];
    for ((name, unit), column) in names.into_iter().zip(values) {
        columns.push_with(name, Some(unit), Arc::new(Float64Array::from(column)));
    }
    columns.table()
}

/// Appends the vertices of a run of a curve, from which it is at most `tolerance_m` away.
pub(crate) fn flatten(run: RunPoints<'_>, tolerance_m: f64, line: &mut Vec<Point<f64>>) {
    let points: Vec<Point<f64>> = run.iter().collect();
    flatten_run(&points, tolerance_m, &mut |point| line.push(point));
}

fn push_positions(columns: &mut Columns, positions: impl Iterator<Item = Option<Point<f64>>>) {
    let (x, y): (Vec<_>, Vec<_>) = positions
        .map(|at| (at.map(|p| p.x), at.map(|p| p.y)))
        .unzip();
    columns.push_with("x_m", Some("m"), Arc::new(Float64Array::from(x)));
    columns.push_with("y_m", Some("m"), Arc::new(Float64Array::from(y)));
}

fn level_ids(layout: &Layout, levels: impl Iterator<Item = Option<u32>>) -> StringArray {
    let id = |level: u32| layout.levels[level as usize].id.as_str();
    levels.map(|level| level.map(id)).collect()
}

fn text_lists<'a>(
    lists: impl Iterator<Item = impl Iterator<Item = &'a str>>,
) -> impl Array + 'static {
    let mut builder = ListBuilder::new(StringBuilder::new());
    for list in lists {
        builder.append_value(list.map(Some));
    }
    builder.finish()
}
