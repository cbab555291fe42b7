//! Layout arrays: the values of each column in a batch of rows of one kind.

use std::iter::repeat_n;
use std::sync::Arc;

use arrow_array::{
    ArrayRef, Float32Array, Float64Array, Int32Array, StringArray, UInt32Array, new_null_array,
};
use guideway_layout::{Layout, PathRef};
use guideway_spline::Point;

use super::element::Element;
use super::layout_columns::Source;
use super::layout_lists as lists;
use super::layout_rows::Row;
use super::write_column::{PolygonCells, Precision};
use crate::write_error::WriteProblem;

impl Source<'_> {
    /// Returns the bytes of text of a row, as far as they can be many.
    pub(super) fn text_bytes(&self, layout: &Layout, kind: Element, row: Row) -> usize {
        match self {
            Self::Id => id(layout, kind, row).len(),
            Self::Attribute(attribute) if row.part == 0 => attribute.text_bytes(kind, row.index),
            _ => 0,
        }
    }

    /// Returns the array of a batch.
    pub(super) fn array(
        &self,
        layout: &Layout,
        kind: Element,
        rows: &[Row],
    ) -> Result<ArrayRef, WriteProblem> {
        if !self.has(kind) {
            return self.nulls(rows.len());
        }
        let paths = &layout.paths;
        let station = |row: &Row| row.index as u32;
        Ok(match self {
            Self::Id => {
                let ids = rows.iter().map(|&row| id(layout, kind, row));
                Arc::new(StringArray::from_iter_values(ids))
            }
            Self::ControlPoints(precision) => control_points(*precision, layout, rows)?,
            Self::Attribute(attribute) => attribute.array(layout, kind, rows),
            Self::Element(kinds) => kinds.array(rows.iter().map(|_| Some(kind as i8)))?,
            Self::Part => {
                let parts = rows.iter().map(|row| row.part as u32);
                Arc::new(UInt32Array::from_iter_values(parts))
            }
            Self::LevelIds => {
                let id = |row: &Row| {
                    let level = level(layout, kind, *row)?;
                    Some(layout.levels.get(level as usize)?.id.as_str())
                };
                Arc::new(rows.iter().map(id).collect::<StringArray>())
            }
            Self::LevelNumbers => {
                let number = |row: &Row| level(layout, kind, *row);
                Arc::new(rows.iter().map(number).collect::<UInt32Array>())
            }
            Self::Width => {
                let width = |path: PathRef<'_>| paths.own_style(path.row()).width_m;
                Arc::new(of_paths(layout, rows, width).collect::<Float32Array>())
            }
            Self::Color(column) => {
                let color = |path: PathRef<'_>| Some(column[path.row()]).filter(|&c| c != 0);
                Arc::new(of_paths(layout, rows, color).collect::<UInt32Array>())
            }
            Self::Rank(column) => {
                // Of all rows of a path: the column has no nulls.
                let ranks = rows.iter().map(|row| column[row.index]);
                Arc::new(Int32Array::from_iter_values(ranks))
            }
            Self::StartNode => {
                Arc::new(of_paths(layout, rows, PathRef::start_node).collect::<UInt32Array>())
            }
            Self::EndNode => {
                Arc::new(of_paths(layout, rows, PathRef::end_node).collect::<UInt32Array>())
            }
            Self::Direction(directions) => {
                let direction = |path: PathRef<'_>| Some(path.direction() as i8);
                directions.array(of_paths(layout, rows, direction))?
            }
            Self::VehicleTypes(types) => {
                let entries = match kind {
                    Element::Path => paths.vehicle_types(),
                    _ => layout.nodes.vehicle_types(),
                };
                let of = |row: &Row| (row.part == 0).then(|| entries.of(row.index));
                types.lists(rows.iter().map(of))?
            }
            Self::Curve => {
                let curve = |row: &Row| paths.written_curve(row.index).filter(|_| row.part == 0);
                lists::curves(rows.iter().map(curve))?
            }
            Self::X => Arc::new(coordinates(layout, kind, rows, |p| p.x)),
            Self::Y => Arc::new(coordinates(layout, kind, rows, |p| p.y)),
            Self::Nodes => {
                lists::indices(rows.iter().map(|row| layout.stations.nodes(station(row))))?
            }
            Self::Of => Arc::new(UInt32Array::from_iter_values(
                rows.iter().map(|row| row.of as u32),
            )),
            Self::LevelName => {
                let name = |row: &Row| layout.levels[row.index].name.as_deref();
                Arc::new(rows.iter().map(name).collect::<StringArray>())
            }
            Self::Elevation => {
                let elevation = |row: &Row| layout.levels[row.index].elevation_m;
                Arc::new(rows.iter().map(elevation).collect::<Float64Array>())
            }
            Self::Members => {
                let members = |row: &Row| layout.blocks[row.index].members.as_slice();
                lists::members(rows.iter().map(members))?
            }
            Self::Outline => {
                let outline = |row: &Row| Some(layout.zones[row.index].outline_m.as_slice());
                lists::points(rows.iter().map(outline))?
            }
            Self::RefusalCode => {
                let codes = rows
                    .iter()
                    .map(|row| layout.refused.get(row.index).code.name());
                Arc::new(StringArray::from_iter_values(codes))
            }
            Self::RefusalDetail => {
                let details = rows.iter().map(|row| layout.refused.get(row.index).detail);
                Arc::new(StringArray::from_iter_values(details))
            }
        })
    }

    /// Returns the array of rows without values. All batches share the values of a dictionary.
    fn nulls(&self, rows: usize) -> Result<ArrayRef, WriteProblem> {
        match self {
            Self::Direction(directions) => directions.array(repeat_n(None, rows)),
            Self::VehicleTypes(types) => {
                types.lists(repeat_n(None::<std::iter::Empty<&str>>, rows))
            }
            // The version does not change the type.
            _ => Ok(new_null_array(self.field(0).data_type(), rows)),
        }
    }
}

/// Returns the identifier of a row; that of an entry is its vehicle type.
fn id(layout: &Layout, kind: Element, row: Row) -> &str {
    let index = row.index;
    match kind {
        Element::Path => layout.paths.id(index),
        Element::PathType => layout.paths.vehicle_types().type_of(index),
        Element::Node => layout.nodes.id(index as u32),
        Element::NodeType => layout.nodes.vehicle_types().type_of(index),
        Element::Station => layout.stations.id(index as u32),
        Element::Level => &layout.levels[index].id,
        Element::VehicleType => &layout.vehicle_types[index].id,
        Element::Block => &layout.blocks[index].id,
        Element::Zone => &layout.zones[index].id,
        Element::Layout => "",
        Element::RefusedPath => layout.refused.get(index).id,
    }
}

fn level(layout: &Layout, kind: Element, row: Row) -> Option<u32> {
    let index = row.index;
    match kind {
        // A row that continues a path has only its part.
        Element::Path if row.part > 0 => None,
        Element::Path => layout.paths.get(index).level(),
        Element::Node => layout.nodes.level(index as u32),
        Element::Station => layout.stations.level(index as u32),
        Element::Zone => layout.zones[index].level,
        _ => None,
    }
}

/// Iterates over the values of paths; rows that continue a path have none.
fn of_paths<'a, T>(
    layout: &'a Layout,
    rows: &'a [Row],
    value: impl Fn(PathRef<'a>) -> Option<T> + 'a,
) -> impl Iterator<Item = Option<T>> + 'a {
    rows.iter().map(move |row| match row.part {
        0 => value(layout.paths.get(row.index)),
        _ => None,
    })
}

fn control_points(
    precision: Precision,
    layout: &Layout,
    rows: &[Row],
) -> Result<ArrayRef, WriteProblem> {
    let mut cells = PolygonCells::new(precision);
    let mut points: Vec<Point<f64>> = Vec::new();
    for row in rows {
        points.clear();
        if let Some(run) = layout.paths.get(row.index).runs().nth(row.part) {
            points.extend(run.iter());
        }
        cells.push(&points);
    }
    Ok(cells.take()?)
}

fn coordinates(
    layout: &Layout,
    kind: Element,
    rows: &[Row],
    axis: impl Fn(Point<f64>) -> f64,
) -> Float64Array {
    let position = |row: &Row| match kind {
        Element::Node => Some(layout.nodes.position_m(row.index as u32)),
        _ => layout.stations.position_m(row.index as u32),
    };
    rows.iter().map(|row| position(row).map(&axis)).collect()
}
