//! `guideway convert`: a layout in another format.

use std::path::PathBuf;

use guideway::formats::arrow::{WriteOptions, write_layout};
use serde_json::{Value, json};

use super::{Exit, Failure, Output, arrow, input, text};

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Layout file: LIF, openTCS or Arrow, found from its content
    input: PathBuf,
    /// File to write; its name ends in .arrow or .feather
    output: PathBuf,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, Failure> {
    arrow::check_output(Some(&args.input), &args.output)?;
    let (layout, read_ms) = input::read(&args.input, out)?;
    let activity = out.activity(format!("writing {}", args.output.display()));
    let (losses, bytes) = arrow::replace(&args.output, |file| {
        write_layout(&layout, file, &WriteOptions::default())
    })?;
    let write_ms = activity.finish();

    let lost: Vec<Value> = losses
        .iter()
        .map(|loss| json!({ "place": loss.place.element, "message": loss.message }))
        .collect();
    let body = json!({
        "file": args.input.to_string_lossy(),
        "output": args.output.to_string_lossy(),
        "format": "Arrow",
        "paths": layout.paths.len(),
        "bytes": bytes,
        "not_stored": lost,
        "ms": { "read": read_ms, "write": write_ms, "total": read_ms + write_ms },
    });
    out.report("convert", &body, || {
        let mut text = format!(
            "{}: {}, {}\n",
            args.output.display(),
            text::counted(layout.paths.len() as u64, "path"),
            text::bytes(bytes)
        );
        if !losses.is_empty() {
            text += "what an Arrow file cannot hold, so keep the source:\n";
        }
        for loss in losses.iter() {
            let place = text::plain(&loss.place.element, 80);
            text += &format!("  {place}: {}\n", text::plain(&loss.message, 200));
        }
        text + &format!(
            "took {}: reading {}, writing {}\n",
            text::time(read_ms + write_ms),
            text::time(read_ms),
            text::time(write_ms)
        )
    })?;
    Ok(Exit::Clean)
}
