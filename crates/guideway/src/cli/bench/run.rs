//! Measures the methods, saves and prints the report.

use guideway::layout::UserError;
use guideway::scene::Cancel;
use guideway_bench::{Contestant, StartError, compare};

use super::args::Args;
use super::{survey, text, tools};
use crate::cli::error::Exit;
use crate::cli::input;
use crate::cli::output::{self, Output, REPORT_VERSION};

/// Name of the report, in the JSON answer and in the file.
const REPORT: &str = "bench";

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    if let Some(path) = &args.output {
        input::check_output(args.file(), path)?;
    }
    if let Some(page) = &args.report {
        return survey::run(page, &args.specs(), out);
    }
    if args.is_of_tools() {
        tools::run(args.paths, args.output.as_deref(), out)?;
        return Ok(Exit::Clean);
    }
    let contest = args.contest(out)?;
    let progress = out.progress(format!("measuring {}", contest.methods.join(", ")));
    let start = |spec: &str| guideway::method(spec).map_err(StartError::new);
    // Ctrl-C ends the process at once: no file is open before the end.
    let comparison = compare(&contest, &start, &Cancel::default())?;
    drop(progress);
    if let Some(path) = &args.output {
        output::save_report(path, REPORT, REPORT_VERSION, &comparison)?;
    }
    out.report(REPORT, &comparison, || text::text(&comparison))?;
    let is_measured = |contestant: &Contestant| contestant.row.measured().is_some();
    Ok(if comparison.methods.iter().any(is_measured) {
        Exit::Clean
    } else {
        Exit::Failed
    })
}
