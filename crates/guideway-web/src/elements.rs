//! Elements as the page shows them: search, properties, outlines.

use guideway::document::{Column, Element, Index, Query, search};
use guideway::layout::{Layout, UserError, Value as Cell};
use guideway::scene::Table;
use guideway::spline::{Bounds, uniform};
use serde_json::{Value, json};

use crate::look::usage;

/// Most points of an outline.
const MAX_POINTS: usize = 4096;
/// Most points along a path of one call.
const MAX_SAMPLES: f64 = 1e6;
/// Lines of a segment of an outline.
const LINES: usize = 16;

/// The element of a kind and row.
pub(crate) fn named(layout: &Layout, kind: &str, row: u32) -> Result<Element, UserError> {
    let tables = [Table::Paths, Table::Nodes, Table::Stations];
    let of = tables.into_iter().find(|of| of.element() == kind);
    let of = of.filter(|of| (row as usize) < of.row_count(layout));
    let of = of.ok_or_else(|| usage(format!("the layout has no {kind} {row}")))?;
    Ok(Element::new(of, row))
}

/// Kind, row, identifier and box of an element.
pub(crate) fn summary(layout: &Layout, index: &Index, element: Element) -> Value {
    let (of, row) = element.table_row();
    let bounds = bounds(layout, index, element);
    json!({
        "kind": of.element(),
        "row": row,
        "id": element.id(layout),
        "bounds": bounds.map(|b| [b.min.x, b.min.y, b.max.x, b.max.y]),
    })
}

/// The summary of an element, its properties, and its outline as lines of points.
pub(crate) fn details(layout: &Layout, index: &Index, element: Element) -> Value {
    let (of, row) = element.table_row();
    let columns = Column::all(layout, of);
    let cells = columns.iter().filter_map(|column| {
        let (value, kind) = column.with_value(layout, of, row, |value| {
            let kind = match value {
                Cell::Int(_) | Cell::Float(_) => Some("number"),
                Cell::Bool(_) => Some("bool"),
                Cell::Text(_) => Some("text"),
                Cell::Json(_) => None,
            };
            (value.to_string(), kind)
        })?;
        let unit = column.unit(layout, of).filter(|_| kind == Some("number"));
        let edited = kind.filter(|_| is_edited(column, of));
        Some(json!({ "name": column.name(), "value": value, "unit": unit, "edited": edited }))
    });
    let mut details = summary(layout, index, element);
    details["cells"] = cells.collect();
    details["outline"] = json!(outline(layout, element));
    details
}

/// Returns `true` if the step `set` or `move-node` of a script can change a column.
fn is_edited(column: &Column, of: Table) -> bool {
    match column {
        Column::Attribute(_) => true,
        Column::X | Column::Y => of == Table::Nodes,
        _ => false,
    }
}

/// Points at equal distances along a path, at most `spacing_m` apart.
pub(crate) fn samples(layout: &Layout, row: u32, spacing_m: f64) -> Result<Value, UserError> {
    named(layout, Table::Paths.element(), row)?;
    if !(spacing_m > 0.0 && spacing_m.is_finite()) {
        let message = format!("a spacing of {spacing_m} m");
        return Err(UserError::new(
            "usage",
            message,
            "Give a distance in meters above 0",
        ));
    }
    let path = layout.paths.get(row as usize);
    let count = path.length_m() / spacing_m;
    if count > MAX_SAMPLES {
        let message = format!("{count:.0} points, limit {MAX_SAMPLES}");
        return Err(UserError::new("usage", message, "Give a greater distance"));
    }
    let mut samples = Vec::new();
    path.sample(spacing_m, |sample| {
        samples.push(json!({
            "alongM": sample.along_m,
            "x": sample.position_m.x,
            "y": sample.position_m.y,
            "headingRad": sample.heading_rad,
        }));
    });
    Ok(samples.into())
}

/// Elements whose identifier contains a text, exact ones first.
pub(crate) fn find(layout: &Layout, index: &Index, text: &str, limit: usize) -> Value {
    let found = search(layout, text, limit);
    let found = found.into_iter().take(limit);
    found.map(|of| summary(layout, index, of)).collect()
}

/// Paths for which a condition holds: how many there are, and the first ones.
pub(crate) fn query(
    layout: &Layout,
    index: &Index,
    text: &str,
    limit: usize,
) -> Result<Value, UserError> {
    let query = Query::parse(text, layout);
    let query = query.map_err(|error| {
        let message = format!("the condition, at character {}", error.at);
        UserError::new("query", message, error.what)
    })?;
    let rows = query.rows(layout);
    let shown = rows.iter().take(limit);
    let shown: Vec<Value> = shown
        .map(|row| summary(layout, index, Element::Path(row)))
        .collect();
    Ok(json!({ "all": rows.len(), "elements": shown }))
}

fn bounds(layout: &Layout, index: &Index, element: Element) -> Option<Bounds<f64>> {
    let at = match element {
        Element::Path(path) => return index.path_bounds(path),
        Element::Node(node) => layout.nodes.position_m(node),
        Element::Station(station) => layout.station_position_m(station)?,
    };
    Some(Bounds { min: at, max: at })
}

/// Lines along the runs of a path, or the one point of another element.
fn outline(layout: &Layout, element: Element) -> Vec<Vec<[f64; 2]>> {
    let path = match element {
        Element::Path(path) => layout.paths.get(path as usize),
        Element::Node(node) => {
            let at = layout.nodes.position_m(node);
            return vec![vec![[at.x, at.y]]];
        }
        Element::Station(station) => {
            let at = layout.station_position_m(station);
            return at.map(|at| vec![[at.x, at.y]]).into_iter().collect();
        }
    };
    let segments: usize = path.runs().map(|run| run.segments().count()).sum();
    let lines = (MAX_POINTS / segments.max(1)).clamp(1, LINES);
    let step = segments.div_ceil(MAX_POINTS).max(1);
    let runs = path.runs().map(|run| {
        let last = run.segments().count().saturating_sub(1);
        let segments = run.segments().enumerate();
        let shown = segments.filter(|(at, _)| at % step == 0 || *at == last);
        let points = shown.flat_map(|(at, segment)| {
            let end = if at == last { lines + 1 } else { lines };
            (0..end).map(move |i| {
                let point = uniform::point(&segment, i as f64 / lines as f64);
                [point.x, point.y]
            })
        });
        points.collect()
    });
    runs.collect()
}
