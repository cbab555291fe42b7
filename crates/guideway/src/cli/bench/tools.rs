//! `guideway bench tools`: measures network, check, route and diff on one plan.

use guideway::layout::UserError;
use guideway_bench::{Machine, ToolRow, measure_tools};
use serde::Serialize;

use crate::cli::output::{self, Output, REPORT_VERSION};
use crate::cli::text;

/// Name of the report, in the JSON answer and in the file.
const REPORT: &str = "bench-tools";

/// Lines of the plan without `--paths`.
const DEFAULT_LINES: usize = 10_000;

#[derive(Serialize)]
struct Body {
    machine: Machine,
    tools: Vec<ToolRow>,
}

/// Measures the tools on a plan of a number of lines, saves and prints the report.
pub(super) fn run(
    lines: Option<usize>,
    file: Option<&std::path::Path>,
    out: &Output,
) -> Result<(), UserError> {
    let progress = out.progress("measuring network, check, route and diff");
    let body = Body {
        machine: Machine::here(),
        tools: measure_tools(lines.unwrap_or(DEFAULT_LINES))?,
    };
    drop(progress);
    if let Some(file) = file {
        output::save_report(file, REPORT, REPORT_VERSION, &body)?;
    }
    out.report(REPORT, &body, || table(&body.tools))
}

fn table(rows: &[ToolRow]) -> String {
    let mut lines = format!(
        "{:<8} {:>12} {:>12} {:>10} {:>10}\n",
        "tool", "paths", "results", "time", "memory"
    );
    for row in rows {
        let memory = row.peak_bytes.map_or_else(|| "-".to_owned(), text::bytes);
        let (paths, results) = (text::count(row.paths), text::count(row.results));
        let time = text::time(row.ms);
        lines += &format!(
            "{:<8} {paths:>12} {results:>12} {time:>10} {memory:>10}\n",
            row.tool
        );
    }
    lines
}
