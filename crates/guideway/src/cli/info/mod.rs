//! `guideway info`: what is in a layout file.

mod columns;
mod extent;
mod summary;
mod table;

use std::path::PathBuf;

use summary::Summary;

use super::{Exit, Failure, Output, input};

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Layout file: LIF, VDA 5050, openTCS, DXF, GeoJSON or Arrow, found from its content
    file: PathBuf,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, Failure> {
    let (layout, read_ms) = input::read(&args.file, out)?;
    let activity = out.activity("measuring");
    let mut summary = Summary::of(&layout, &args.file);
    summary.ms.read = read_ms;
    summary.ms.measure = activity.finish();
    summary.ms.total = summary.ms.read + summary.ms.measure;
    out.report("info", &summary, || table::text(&summary))?;
    Ok(Exit::Clean)
}
