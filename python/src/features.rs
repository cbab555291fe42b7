//! Elements with their geometry: GeoArrow columns, which GeoPandas, lonboard, GDAL and QGIS read.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{Array, ArrayRef, Float64Array, ListArray, StructArray};
use arrow_buffer::{NullBuffer, OffsetBuffer};
use arrow_schema::{DataType, Field, Fields};
use guideway::layout::{GeoOrigin, Layout};
use guideway::spline::Point;
use pyo3::prelude::*;

use crate::error::bad_argument;
use crate::tables::{self, Columns, flatten};

/// Keys and values of GeoArrow, version 0.2.
const EXTENSION_KEY: &str = "ARROW:extension:name";
const EXTENSION_METADATA_KEY: &str = "ARROW:extension:metadata";
const LINE_STRING: &str = "geoarrow.linestring";
const POINT: &str = "geoarrow.point";
const DEGREES: &str = r#"{"crs": "OGC:CRS84", "crs_type": "authority_code"}"#;
const PLANE: &str = "{}";

/// The elements of a kind (`edges`, `nodes` or `stations`) with a column `geometry`: lines within
/// `tolerance_m` of their curves, or points; in meters of the layout, or on earth in degrees.
pub(crate) fn features(
    layout: &Layout,
    kind: &str,
    tolerance_m: f64,
    on_earth: bool,
) -> PyResult<Columns> {
    if !(1e-6..=1e6).contains(&tolerance_m) {
        let message = format!("a tolerance of {tolerance_m} m");
        return Err(bad_argument(message, "Give a distance from 1e-6 to 1e6 m"));
    }
    let origin = layout.geo_origin.filter(|_| on_earth);
    if on_earth && origin.is_none() {
        let remedy = "Omit on_earth for meters of the layout";
        return Err(bad_argument("the layout has no place on earth", remedy));
    }
    let to_degrees = origin.map(GeoOrigin::to_degrees);
    let map = |p: Point<f64>| to_degrees.as_ref().map_or(p, |to_degrees| to_degrees(p));
    let (mut columns, extension, geometry) = match kind {
        "edges" => (
            tables::edge_columns(layout, None),
            LINE_STRING,
            lines(layout, tolerance_m, map)?,
        ),
        "nodes" => {
            let rows = 0..layout.nodes.len() as u32;
            let positions = rows.map(|row| Some(map(layout.nodes.position_m(row))));
            (tables::node_columns(layout), POINT, points(positions))
        }
        "stations" => {
            let rows = 0..layout.stations.len() as u32;
            let positions = rows.map(|row| layout.station_position_m(row).map(map));
            (tables::station_columns(layout), POINT, points(positions))
        }
        other => {
            let remedy = "Choose \"edges\", \"nodes\" or \"stations\"";
            return Err(bad_argument(
                format!("no elements are called `{other}`"),
                remedy,
            ));
        }
    };
    let system = if on_earth { DEGREES } else { PLANE };
    let metadata = [(EXTENSION_KEY, extension), (EXTENSION_METADATA_KEY, system)];
    let metadata = metadata.map(|(key, value)| (key.to_owned(), value.to_owned()));
    let field = Field::new("geometry", geometry.data_type().clone(), true);
    columns.push_field(field.with_metadata(HashMap::from(metadata)), geometry);
    Ok(columns)
}

fn lines(
    layout: &Layout,
    tolerance_m: f64,
    map: impl Fn(Point<f64>) -> Point<f64>,
) -> PyResult<ArrayRef> {
    let (mut all, mut line) = (Vec::new(), Vec::new());
    let mut lengths = Vec::with_capacity(layout.paths.len());
    for path in layout.paths.iter() {
        line.clear();
        path.runs()
            .for_each(|run| flatten(run, tolerance_m, &mut line));
        line.dedup();
        lengths.push(line.len());
        all.extend(line.iter().copied().map(&map));
    }
    if i32::try_from(all.len()).is_err() {
        return Err(bad_argument(
            format!("the lines have {} vertices, limit {}", all.len(), i32::MAX),
            "Give a greater tolerance_m, or a part of the layout",
        ));
    }
    let present: NullBuffer = lengths.iter().map(|&length| length > 0).collect();
    let vertices = coordinates(all.into_iter());
    let item = Arc::new(Field::new("vertices", vertices.data_type().clone(), false));
    let offsets = OffsetBuffer::from_lengths(lengths);
    Ok(Arc::new(ListArray::new(
        item,
        offsets,
        Arc::new(vertices),
        Some(present),
    )))
}

fn points(positions: impl Iterator<Item = Option<Point<f64>>>) -> ArrayRef {
    let positions: Vec<_> = positions.collect();
    let present: NullBuffer = positions.iter().map(Option::is_some).collect();
    let nowhere = Point::new(f64::NAN, f64::NAN);
    let all = positions.into_iter().map(|at| at.unwrap_or(nowhere));
    let (fields, arrays, _) = coordinates(all).into_parts();
    Arc::new(StructArray::new(fields, arrays, Some(present)))
}

fn coordinates(points: impl Iterator<Item = Point<f64>>) -> StructArray {
    let (x, y): (Vec<f64>, Vec<f64>) = points.map(|p| (p.x, p.y)).unzip();
    let axis = |name| Field::new(name, DataType::Float64, false);
    let fields = Fields::from(vec![axis("x"), axis("y")]);
    let arrays: [ArrayRef; 2] = [x, y].map(|axis| Arc::new(Float64Array::from(axis)) as ArrayRef);
    StructArray::new(fields, arrays.to_vec(), None)
}
