//! `guideway bench`: methods side by side on one layout.

mod args;
mod text;

use guideway::render::Cancel;
use guideway_bench::{Comparison, compare};

pub(crate) use args::Args;

use super::{Exit, Failure, Output, input, output};

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
        output::save_report(path, REPORT, &comparison)?;
    }
    out.report(REPORT, &comparison, || text::text(&comparison))?;
    nothing_was_measured(&comparison).map_or(Ok(Exit::Clean), Err)
}

/// A failure when no method at all could be measured.
fn nothing_was_measured(comparison: &Comparison) -> Option<Failure> {
    let is_measured = |row: &guideway_bench::Contestant| row.row.measured().is_some();
    (!comparison.methods.iter().any(is_measured)).then(|| Failure {
        code: "nothing-measured",
        message: "no method could be measured; the report says why for each".into(),
        remedy: "`guideway methods` shows what runs here".into(),
    })
}
