//! A layout, its routes and its edits as JSON, for programs in other languages.

use std::ops::Range;

use guideway_formats::Target;
use guideway_layout::Layout;
use guideway_network::Route;
#[cfg(feature = "script")]
use guideway_scene::Table;
use serde_json::{Value, json};

#[cfg(feature = "script")]
use crate::script::{AppliedStep, SHOWN_NAMES};

/// Columns by which paths can be colored, beside those of the file.
const BUILT_IN: [&str; 3] = ["level", "direction", "vehicle_type"];

/// Format, counts, length, extent, levels, vehicle types, columns, formats to save in.
pub fn info(layout: &Layout) -> Value {
    let mut info = counts(layout);
    info["lengthM"] = json!(length_m(layout, 0..layout.paths.len()));
    info
}

/// Length of the curves of some rows of paths, in meters.
///
/// # Panics
/// When there is no such row.
pub fn length_m(layout: &Layout, rows: Range<usize>) -> f64 {
    rows.map(|row| layout.paths.get(row).length_m()).sum()
}

/// [`info`] without the length, the only part of it that takes longer for longer curves: 0.8 s for
/// a million paths in a browser.
pub fn counts(layout: &Layout) -> Value {
    let levels = layout.levels.iter();
    let levels: Vec<Value> = levels
        .map(|level| json!({ "id": level.id, "name": level.name_or_id() }))
        .collect();
    let own = layout.paths.column_names();
    let own: Vec<&str> = own.filter(|name| !BUILT_IN.contains(name)).collect();
    let has = [
        !layout.levels.is_empty(),
        true,
        !layout.paths.vehicle_types().names().is_empty(),
    ];
    let built_in = BUILT_IN.iter().zip(has).filter(|(_, has)| *has);
    let columns = built_in.map(|(name, _)| *name).chain(own);
    let targets = Target::ALL.iter().map(|target| {
        let extension = target.extensions().first();
        json!({ "id": target.id(), "name": target.name(), "extension": extension })
    });
    let bounds = layout.paths.hull_bounds();
    json!({
        "format": layout.provenance.format,
        "formatVersion": layout.provenance.format_version,
        "paths": layout.paths.len(),
        "nodes": layout.nodes.len(),
        "stations": layout.stations.len(),
        "refused": layout.refused.len(),
        "bounds": bounds.map(|b| [b.min.x, b.min.y, b.max.x, b.max.y]),
        "levels": levels,
        "vehicleTypes": layout.vehicle_type_names(),
        "columns": columns.collect::<Vec<_>>(),
        "targets": targets.collect::<Vec<_>>(),
        "source": Target::of_source(layout).map(Target::id),
        "isDrawing": layout.is_drawing(),
    })
}

/// The elements that each step of an edit script has touched.
#[cfg(feature = "script")]
pub fn edit_steps(steps: &[AppliedStep]) -> Value {
    let numbered = steps.iter().zip(1..);
    numbered
        .map(|(step, number)| edit_step(step, number))
        .collect()
}

#[cfg(feature = "script")]
fn edit_step(step: &AppliedStep, number: usize) -> Value {
    let touched = &step.touched;
    json!({
        "step": number,
        "do": step.name,
        "paths": touched.count(Table::Paths),
        "nodes": touched.count(Table::Nodes),
        "stations": touched.count(Table::Stations),
        "names": touched.names.iter().take(SHOWN_NAMES).collect::<Vec<_>>(),
        "lost": touched.lost,
        "ms": step.ms,
    })
}

/// A route with its steps.
pub fn route(layout: &Layout, route: &Route) -> Value {
    let rows = route.rows.iter().map(|row| {
        json!({
            "path": layout.paths.id(row.path as usize),
            "row": row.path,
            "backward": row.is_backward,
            "from": layout.nodes.id(row.from),
            "to": layout.nodes.id(row.to),
            "lengthM": row.length_m,
            "speedMS": row.speed_m_s,
            "endS": row.end_s,
        })
    });
    json!({ "lengthM": route.length_m, "timeS": route.time_s, "rows": rows.collect::<Vec<_>>() })
}
