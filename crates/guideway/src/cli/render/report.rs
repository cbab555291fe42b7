//! The report of `render` as text and JSON.

use std::path::Path;

use guideway::compose::{Rendered, SweptReport};
use guideway::envelope::NoEnvelope;
use guideway::layout::{Severity, shown_path};
use guideway::scene::{Clock, FrameSize, Legend, Scene};
use serde_json::{Value, json};

use super::args::Args;
use super::part::BytesRead;
use crate::cli::output::is_stdout;
use crate::cli::route::FoundRoute;
use crate::cli::{envelope, input, text};

/// Duration of each step, in milliseconds.
pub(super) struct Times {
    pub(super) read: f64,
    pub(super) scene: f64,
    /// Widths and shading that suit the picture, and what the method prepares.
    pub(super) prepare: f64,
    pub(super) render: f64,
    pub(super) write: f64,
}

impl Times {
    fn total(&self) -> f64 {
        self.read + self.scene + self.prepare + self.render + self.write
    }
}

/// The subject of a report.
pub(super) struct Shown<'a> {
    pub(super) scene: &'a Scene,
    pub(super) rendered: &'a Rendered,
    /// Size of the picture, of which a level beside others has a part.
    pub(super) size: FrameSize,
    pub(super) route: Option<&'a FoundRoute>,
}

pub(super) fn text(path: &Path, shown: &Shown<'_>, times: &Times) -> String {
    let Shown {
        scene,
        rendered,
        size,
        route,
    } = *shown;
    let mut text = String::new();
    if !is_stdout(path) {
        text += &format!(
            "{}: {} x {} pixels\n",
            shown_path(path),
            size.width(),
            size.height()
        );
    }
    text += &paths_text(rendered);
    if let Some(BytesRead { read, all }) = BytesRead::of(scene.layout()) {
        text += &format!(
            "read {} of {}: the paths near the view\n",
            text::bytes(read),
            text::bytes(all)
        );
    }
    text += &rendered.swept.as_ref().map_or_else(String::new, swept_text);
    text += &route.map_or_else(String::new, FoundRoute::text);
    text += &format!(
        "took {}: reading {}, drawing {}, writing {}\n",
        text::time(times.total()),
        text::time(times.read),
        text::time(times.scene + times.prepare + times.render),
        text::time(times.write),
    );
    if let Some(legend) = legend(scene, rendered) {
        text += &legend_text(legend);
    }
    let findings = &scene.layout().diagnostics;
    let (errors, all) = (
        findings.count_at_least(Severity::Error),
        findings.count_at_least(Severity::Warning),
    );
    if all > 0 {
        text += &format!(
            "the file has {} and {}: `guideway check` lists them\n",
            text::counted(errors, "error"),
            text::counted(all - errors, "warning")
        );
    }
    text
}

/// The account of all paths on one line, and the notes.
fn paths_text(rendered: &Rendered) -> String {
    let report = &rendered.report;
    let mut text = format!(
        "{} of {} drawn by {}",
        text::count(report.drawn),
        text::counted(report.total, "path"),
        report.method
    );
    for (count, what) in [
        (report.culled, "outside the view"),
        (report.hidden, "hidden"),
        (report.refused, "refused"),
    ] {
        if count > 0 {
            text += &format!(", {} {what}", text::count(count));
        }
    }
    text.push('\n');
    for note in &report.notes {
        text += &format!("note: {note}\n");
    }
    text
}

/// The meaning of the colors.
fn legend<'a>(scene: &'a Scene, rendered: &'a Rendered) -> Option<&'a Legend> {
    rendered.report.density.as_ref().or(scene.legend())
}

fn legend_text(legend: &Legend) -> String {
    let mut text = format!("colors by {}:\n", text::single_line(&legend.title(), 60));
    for entry in &legend.entries {
        let color = entry.color;
        let label = text::single_line(&entry.label, 60);
        text += &match entry.paths {
            Some(n) => format!("  {color}  {label} ({})\n", text::counted(n, "path")),
            None => format!("  {color}  {label}\n"),
        };
    }
    text
}

pub(super) fn json(args: &Args, output: &Path, shown: &Shown<'_>, times: &Times) -> Value {
    let Shown {
        scene,
        rendered,
        size,
        route,
    } = *shown;
    let report = &rendered.report;
    let view = &rendered.view;
    let shown = view.world_bounds();
    let layout = scene.layout();
    let stages: Vec<Value> = report
        .stages
        .iter()
        .map(|stage| {
            json!({
                "name": stage.name,
                "ms": stage.elapsed_ms,
                "clock": match stage.clock {
                    Clock::Host => "host",
                    Clock::Device => "device",
                },
            })
        })
        .collect();
    json!({
        "file": input::names(&args.inputs),
        "floor_plan": args.floor_plan().map(|plan| plan.path.to_string_lossy()),
        "output": output.to_string_lossy(),
        "format": layout.provenance.format,
        "format_version": layout.provenance.format_version,
        "size_px": [size.width(), size.height()],
        "view": {
            "center_m": [view.center_m().x, view.center_m().y],
            "px_per_m": view.px_per_m(),
            "min_m": [shown.min.x, shown.min.y],
            "max_m": [shown.max.x, shown.max.y],
        },
        "method": { "name": rendered.method.name, "device": rendered.method.device },
        "paths": {
            "total": report.total,
            "drawn": report.drawn,
            "outside": report.culled,
            "hidden": report.hidden,
            "refused": report.refused,
        },
        "envelopes": rendered.swept.as_ref().map(swept_json),
        "route": route.map(FoundRoute::json),
        "read": BytesRead::of(layout).map(|bytes| json!({
            "bytes": bytes.read,
            "of_bytes": bytes.all,
        })),
        "lines": report.lines,
        "peak_bytes": report.peak_bytes,
        "bands": report.bands,
        "stages": stages,
        "notes": report.notes,
        "legend": legend(scene, rendered).map(legend_json),
        "findings": {
            "errors": layout.diagnostics.count_at_least(Severity::Error),
            "warnings": layout.diagnostics.count_at_least(Severity::Warning)
                - layout.diagnostics.count_at_least(Severity::Error),
        },
        "ms": {
            "read": times.read,
            "scene": times.scene,
            "prepare": times.prepare,
            "render": times.render,
            "write": times.write,
            "total": times.total(),
        },
    })
}

fn legend_json(legend: &Legend) -> Value {
    let entries: Vec<Value> = legend
        .entries
        .iter()
        .map(|entry| {
            json!({
                "label": entry.label,
                "color": entry.color.to_string(),
                "paths": entry.paths,
            })
        })
        .collect();
    json!({
        "column": legend.column,
        "unit": legend.unit,
        "is_continuous": legend.scale.is_some(),
        "entries": entries,
    })
}

fn swept_text(swept: &SweptReport) -> String {
    let mut text = format!(
        "swept areas ({}): {} drawn as {}",
        envelope::name(swept.vehicle),
        text::count(swept.drawn),
        text::counted(swept.polygons, "polygon"),
    );
    if swept.outside > 0 {
        text += &format!(", {} outside the view", text::count(swept.outside));
    }
    text.push('\n');
    let doubt = envelope::doubt(swept.doubtful);
    for line in envelope::missing(&swept.without).into_iter().chain(doubt) {
        text += &format!("note: {line}\n");
    }
    text
}

fn swept_json(swept: &SweptReport) -> Value {
    let without = NoEnvelope::ALL
        .into_iter()
        .filter(|&reason| swept.without[reason as usize] > 0);
    let without: Vec<Value> = without
        .map(|reason| json!({ "paths": swept.without[reason as usize], "why": reason.to_string() }))
        .collect();
    json!({
        "source": envelope::name(swept.vehicle),
        "drawn": swept.drawn,
        "outside": swept.outside,
        "without": without,
        "doubtful": swept.doubtful,
        "polygons": swept.polygons,
        "tolerance_m": swept.tolerance_m,
    })
}
