//! A layout as JSON: its content, findings, routes, changes, pictures.

use std::collections::BTreeMap;

use guideway::compose::{Picture, Rendered};
use guideway::document::{Element, locate};
use guideway::formats::Target;
use guideway::layout::{Changes, Diagnostic, ElementChange, Layout};
use guideway::network::Route;
use guideway::scene::Legend;
use serde_json::{Value, json};

/// Columns by which paths can be colored, beside those of the file.
const BUILT_IN: [&str; 3] = ["level", "direction", "vehicle_type"];

/// Format, counts, extent, levels, vehicle types, columns, formats to save in.
pub(crate) fn info(name: &str, layout: &Layout) -> Value {
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
    let length_m: f64 = layout.paths.iter().map(|path| path.length_m()).sum();
    json!({
        "name": name,
        "format": layout.provenance.format,
        "formatVersion": layout.provenance.format_version,
        "paths": layout.paths.len(),
        "nodes": layout.nodes.len(),
        "stations": layout.stations.len(),
        "refused": layout.refused.len(),
        "lengthM": length_m,
        "bounds": bounds.map(|b| [b.min.x, b.min.y, b.max.x, b.max.y]),
        "levels": levels,
        "vehicleTypes": layout.vehicle_type_names(),
        "columns": columns.collect::<Vec<_>>(),
        "targets": targets.collect::<Vec<_>>(),
        "source": Target::of_source(layout).map(Target::id),
        "isDrawing": layout.is_drawing(),
    })
}

/// A finding with the element that it names.
pub(crate) fn finding(layout: &Layout, finding: &Diagnostic) -> Value {
    let element = locate(layout, &finding.place);
    json!({
        "code": finding.code.name(),
        "severity": finding.severity.to_string(),
        "place": finding.place.to_string(),
        "message": finding.message,
        "remedy": finding.remedy,
        "element": element.map(reference),
    })
}

fn reference(element: Element) -> Value {
    let (of, row) = element.table_row();
    json!({ "kind": of.element(), "row": row })
}

/// The view of a picture, the account of all paths, notes and the meaning of the colors.
pub(crate) fn report(picture: &Picture, rendered: &Rendered, is_density: bool) -> Value {
    let (view, report) = (&rendered.view, &rendered.report);
    let legend = report.density.as_ref().or(picture.scene.legend());
    json!({
        "center": [view.center_m().x, view.center_m().y],
        "pxPerM": view.px_per_m(),
        "drawn": report.drawn,
        "total": report.total,
        "culled": report.culled,
        "hidden": report.hidden,
        "refused": report.refused,
        "notes": report.notes,
        "density": is_density,
        "legend": legend.map(legend_json),
        "prepareMs": rendered.prepare_ms,
        "renderMs": rendered.render_ms,
    })
}

fn legend_json(legend: &Legend) -> Value {
    let entries = legend.entries.iter().map(|entry| {
        let color = format!("#{:06x}", entry.color.to_u32() >> 8);
        json!({ "label": entry.label, "color": color, "paths": entry.paths })
    });
    json!({ "title": legend.title(), "entries": entries.collect::<Vec<_>>() })
}

/// A route with its steps.
pub(crate) fn route(layout: &Layout, route: &Route) -> Value {
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

/// Counts of the changes, and the first ones.
pub(crate) fn diff(found: &Changes<'_>, most: usize) -> Value {
    let mut counts: BTreeMap<(&str, &str), u64> = BTreeMap::new();
    for of in found.elements.iter() {
        *counts
            .entry((of.element.name(), of.change.name()))
            .or_default() += 1;
    }
    let counts = counts.into_iter().map(|((element, change), count)| {
        json!({ "element": element, "change": change, "count": count })
    });
    let shown = found.elements.iter().take(most);
    let groups = found.groups.iter();
    let groups = groups.map(|of| json!({ "what": of.what, "example": of.example }));
    json!({
        "counts": counts.collect::<Vec<_>>(),
        "changes": shown.map(|of| change(found, &of)).collect::<Vec<_>>(),
        "groups": groups.collect::<Vec<_>>(),
    })
}

fn change(found: &Changes<'_>, of: &ElementChange) -> Value {
    let values = found.values(of);
    json!({
        "element": of.element.name(),
        "id": found.id(of),
        "newId": found.new_id(of),
        "change": of.change.name(),
        "newRow": of.new_row(),
        "column": values.as_ref().map(|values| values.property.to_owned()),
        "before": values.as_ref().and_then(|values| Some(values.before.as_ref()?.to_string())),
        "after": values.as_ref().and_then(|values| Some(values.after.as_ref()?.to_string())),
    })
}
