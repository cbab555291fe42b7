//! `guideway convert`: writes a layout in another format.

use std::ffi::OsString;
use std::path::PathBuf;

use guideway::formats::Target;
use guideway::layout::{UserError, shown_path, shown_text};
use guideway::scene::cluster::sort_paths;
use serde_json::json;

use super::error::{Exit, usage_error};
use super::input::{self, Input};
use super::layout_output::{LayoutOutput, target_parser};
use super::output::Output;
use super::progress_bar::plan;
use super::text;

#[derive(Debug, clap::Args)]
#[command(
    after_help = input::PLACEMENT_HELP,
    override_usage = "guideway convert [OPTIONS] <FILE>... <OUTPUT>\n       \
                      guideway convert [OPTIONS] <FILE>... -o <OUTPUT>"
)]
pub(crate) struct Args {
    /// Layout files; the content decides the format. The last one is the file to write, unless -o
    /// names it
    #[arg(required = true, value_name = "FILE")]
    files: Vec<OsString>,
    /// File to write; its extension selects the format unless --to is given. LIF stays in the
    /// version that was read. `-` is standard output, in the format that was read unless --to is
    /// given
    #[arg(long, short)]
    output: Option<PathBuf>,
    /// Format of the output
    #[arg(long, value_name = "FORMAT", value_parser = target_parser())]
    to: Option<Target>,
    /// Sort the paths along a Hilbert curve, and keep their draw order as ranks: `render --center
    /// --scale` then reads only the part of an Arrow file near its view
    #[arg(long)]
    hilbert: bool,
}

impl Args {
    /// The files to read and the one to write.
    fn files(&self) -> Result<(Vec<Input>, PathBuf), UserError> {
        let (files, output) = match (&self.output, self.files.split_last()) {
            (None, Some((last, files @ [_, ..]))) => (files, PathBuf::from(last)),
            (None, _) => {
                return Err(usage_error(
                    "the file to write is missing",
                    "Name it after the files to read, or by -o",
                ));
            }
            (Some(output), _) => (&self.files[..], output.clone()),
        };
        let input = |file: &OsString| {
            let shown = file.to_string_lossy();
            let refused = |why| usage_error(format!("`{}`: {why}", shown_text(&shown)), HELP);
            Input::parse(file.clone()).map_err(refused)
        };
        let inputs = files.iter().map(input).collect::<Result<_, _>>()?;
        Ok((inputs, output))
    }
}

/// The remedy for a placement that cannot be read.
const HELP: &str = "Write a placement such as FILE@scale=0.001,rotate=90,offset=12.5,-3";

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    let (inputs, path) = args.files()?;
    let paths = inputs.iter().map(|input| input.path.as_path());
    let output = LayoutOutput::new(&path, args.to, paths, out)?;
    // Reading, merging, writing.
    plan(inputs.len(), &[5.0, 0.1, 5.0]);
    let (mut layout, read_ms) = input::read_all(&inputs, out)?;
    if args.hilbert {
        sort_paths(&mut layout);
    }
    let written = output.write(&layout, output.target(&layout)?, out)?;
    let (write_ms, bytes) = (written.ms, written.bytes);
    let body = json!({
        "file": input::names(&inputs),
        "output": path.to_string_lossy(),
        "format": written.target.name(),
        "paths": layout.paths.len(),
        "bytes": bytes,
        "not_stored": written.losses_json(),
        "ms": { "read": read_ms, "write": write_ms, "total": read_ms + write_ms },
    });
    out.beside(Some(&path)).report("convert", &body, || {
        let text = format!(
            "{}: {}, {}\n",
            shown_path(&path),
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
