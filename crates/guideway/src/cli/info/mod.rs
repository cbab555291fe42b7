//! `guideway info`: summarizes layout files.

mod columns;
mod extent;
mod summary;
mod table;

use guideway::layout::UserError;

use self::summary::Summary;
use super::error::Exit;
use super::input::{self, Input};
use super::output::Output;
use super::progress_bar::plan;

#[derive(Debug, clap::Args)]
#[command(after_help = input::PLACEMENT_HELP)]
pub(crate) struct Args {
    /// Layout files; the content decides the format
    #[arg(required = true, value_name = "FILE", value_parser = Input::parser())]
    inputs: Vec<Input>,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    // Reading, merging, measuring.
    plan(args.inputs.len(), &[8.0, 0.1, 2.0]);
    let (layout, read_ms) = input::read_all(&args.inputs, out)?;
    let progress = out.progress("measuring");
    let mut summary = Summary::of(&layout, &args.inputs);
    summary.ms.read = read_ms;
    summary.ms.measure = progress.finish();
    summary.ms.total = summary.ms.read + summary.ms.measure;
    out.report("info", &summary, || table::text(&summary))?;
    Ok(Exit::Clean)
}
