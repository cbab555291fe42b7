//! `guideway convert`: writes a layout in another format.

use std::path::PathBuf;

use guideway::formats::Target;
use guideway::layout::{UserError, shown_path};
use serde_json::json;

use super::error::Exit;
use super::input::{self, Input};
use super::layout_output::{LayoutOutput, target_parser};
use super::output::Output;
use super::progress_bar::plan;
use super::text;

#[derive(Debug, clap::Args)]
#[command(after_help = input::PLACEMENT_HELP)]
pub(crate) struct Args {
    /// Layout files; the content decides the format
    #[arg(required = true, value_name = "FILE", value_parser = Input::parser())]
    inputs: Vec<Input>,
    /// File to write; its extension selects the format unless --to is given. LIF stays in the
    /// version that was read. `-` is standard output, in the format that was read unless --to is
    /// given
    output: PathBuf,
    /// Format of the output
    #[arg(long, value_name = "FORMAT", value_parser = target_parser())]
    to: Option<Target>,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    let inputs = args.inputs.iter().map(|input| input.path.as_path());
    let output = LayoutOutput::new(&args.output, args.to, inputs, out)?;
    // Reading, merging, writing.
    plan(args.inputs.len(), &[5.0, 0.1, 5.0]);
    let (layout, read_ms) = input::read_all(&args.inputs, out)?;
    let written = output.write(&layout, output.target(&layout)?, out)?;
    let (write_ms, bytes) = (written.ms, written.bytes);
    let body = json!({
        "file": input::names(&args.inputs),
        "output": args.output.to_string_lossy(),
        "format": written.target.name(),
        "paths": layout.paths.len(),
        "bytes": bytes,
        "not_stored": written.losses_json(),
        "ms": { "read": read_ms, "write": write_ms, "total": read_ms + write_ms },
    });
    out.beside(Some(&args.output))
        .report("convert", &body, || {
            let text = format!(
                "{}: {}, {}\n",
                shown_path(&args.output),
                text::counted(layout.paths.len() as u64, "path"),
                text::bytes(bytes)
            );
            text + &written.losses_text()
                + &format!(
                    "took {}: reading {}, writing {}\n",
                    text::time(read_ms + write_ms),
                    text::time(read_ms),
                    text::time(write_ms)
                )
        })?;
    Ok(Exit::Clean)
}
