use std::path::Path;

use guideway::layout::Severity;
use guideway::render::Clock;
use guideway::scene::{Legend, Scene};
use serde_json::{Value, json};

use super::swept::SweptReport;
use super::{Args, Drawn};
use crate::cli::input;
use crate::cli::text;

/// Where the time went, in milliseconds.
#[derive(Default)]
pub(crate) struct Times {
    pub(crate) read: f64,
    pub(crate) scene: f64,
    pub(crate) prepare: f64,
    pub(crate) render: f64,
    pub(crate) write: f64,
}

impl Times {
    pub(crate) fn total(&self) -> f64 {
        self.read + self.scene + self.prepare + self.render + self.write
    }
}

pub(super) fn text(path: &Path, scene: &Scene, drawn: &Drawn, times: &Times) -> String {
    let size = drawn.view.size();
    let mut text = String::new();
    if path != Path::new("-") {
        text += &format!(
            "{}: {} x {} pixels\n",
            path.display(),
            size.width(),
            size.height()
        );
    }
    text += &what_was_drawn(drawn);
    text += &drawn
        .swept
        .as_ref()
        .map_or_else(String::new, SweptReport::text);
    text += &format!(
        "took {}: reading {}, drawing {}, writing {}\n",
        text::time(times.total()),
        text::time(times.read),
        text::time(times.scene + times.prepare + times.render),
        text::time(times.write),
    );
    if let Some(legend) = scene.legend() {
        text += &legend_text(legend);
    }
    let odd = &scene.layout().diagnostics;
    let (errors, all) = (
        odd.count_at_least(Severity::Error),
        odd.count_at_least(Severity::Warning),
    );
    if all > 0 {
        text += &format!(
            "the file has {} and {}: `guideway check` shows them\n",
            text::counted(errors, "error"),
            text::counted(all - errors, "warning")
        );
    }
    text
}

/// What became of every path, in one line.
pub(crate) fn what_was_drawn(drawn: &Drawn) -> String {
    let report = &drawn.report;
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

fn legend_text(legend: &Legend) -> String {
    let mut text = format!("colors by {}:\n", text::plain(&legend.column, 60));
    for entry in &legend.entries {
        let color = entry.color;
        let label = text::plain(&entry.label, 60);
        text += &match entry.paths {
            Some(n) => format!("  {color}  {label} ({})\n", text::counted(n, "path")),
            None => format!("  {color}  {label}\n"),
        };
    }
    text
}

pub(super) fn json(args: &Args, scene: &Scene, drawn: &Drawn, times: &Times) -> Value {
    let report = &drawn.report;
    let (view, size) = (&drawn.view, drawn.view.size());
    let seen = view.world_bounds();
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
        "output": args.output.to_string_lossy(),
        "format": layout.provenance.format,
        "format_version": layout.provenance.format_version,
        "size_px": [size.width(), size.height()],
        "view": {
            "center_m": [view.center_m().x, view.center_m().y],
            "px_per_m": view.px_per_m(),
            "min_m": [seen.min.x, seen.min.y],
            "max_m": [seen.max.x, seen.max.y],
        },
        "method": { "name": drawn.method.name, "device": drawn.method.device },
        "paths": {
            "total": report.total,
            "drawn": report.drawn,
            "outside": report.culled,
            "hidden": report.hidden,
            "refused": report.refused,
        },
        "envelopes": drawn.swept.as_ref().map(SweptReport::json),
        "lines": report.lines,
        "peak_bytes": report.peak_bytes,
        "bands": report.bands,
        "stages": stages,
        "notes": report.notes,
        "legend": scene.legend().map(legend_json),
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
        "is_continuous": legend.is_continuous,
        "entries": entries,
    })
}
