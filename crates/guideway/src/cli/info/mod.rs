//! `guideway info`: what is in a layout file.

mod columns;
mod extent;
mod summary;
mod table;

use summary::Summary;

use super::input::{self, Input};
use super::{Exit, Failure, Output};

#[derive(Debug, clap::Args)]
#[command(after_help = input::PLACEMENT_HELP)]
pub(crate) struct Args {
    /// Layout files of any format that is read, found from their content
    #[arg(required = true, value_name = "FILE", value_parser = Input::parser())]
    inputs: Vec<Input>,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, Failure> {
    let (layout, read_ms) = input::read_all(&args.inputs, out)?;
    let activity = out.activity("measuring");
    let mut summary = Summary::of(&layout, &args.inputs);
    summary.ms.read = read_ms;
    summary.ms.measure = activity.finish();
    summary.ms.total = summary.ms.read + summary.ms.measure;
    out.report("info", &summary, || table::text(&summary))?;
    Ok(Exit::Clean)
}
