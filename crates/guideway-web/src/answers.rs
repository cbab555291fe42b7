//! Answers as JSON: findings, changes, pictures.

use std::collections::BTreeMap;

use guideway::compose::{Picture, Rendered};
use guideway::document::{Element, locate};
use guideway::layout::{Changes, Diagnostic, ElementChange, Layout};
use guideway::scene::Legend;
use serde_json::{Value, json};

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
