//! Answers as JSON: findings and pictures.

use guideway::compose::{Picture, Rendered};
use guideway::document::{Element, locate};
use guideway::layout::{Diagnostic, Layout};
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
