//! `guideway bench`: methods side by side on one layout.

mod args;
mod text;

use guideway::render::Cancel;
use guideway_bench::{Contestant, compare};

pub(crate) use args::Args;

use super::output::{self, REPORT_VERSION};
use super::{Exit, Failure, Output, input};

/// Name of the report, in the answer and in the file.
const REPORT: &str = "bench";

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, Failure> {
    if let Some(path) = &args.output {
        input::check_output(args.file(), path)?;
    }
    let contest = args.contest(out)?;
    let activity = out.activity(format!("measuring {}", contest.methods.join(", ")));
    let start = |spec: &str| guideway::method(spec).map_err(|error| error.to_string());
    // Ctrl-C ends the process at once: nothing is half written before the end.
    let comparison = compare(&contest, &start, &Cancel::default())?;
    drop(activity);
    if let Some(path) = &args.output {
        output::save_report(path, REPORT, REPORT_VERSION, &comparison)?;
    }
    out.report(REPORT, &comparison, || text::text(&comparison))?;
    let is_measured = |contestant: &Contestant| contestant.row.measured().is_some();
    Ok(if comparison.methods.iter().any(is_measured) {
        Exit::Clean
    } else {
        Exit::Errors
    })
}
