//! `guideway edit`: edits a layout by a script of steps in JSON.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use guideway::formats::Target;
use guideway::json::edit_steps;
use guideway::layout::{UserError, shown_path};
use guideway::scene::Table;
use guideway::script::{self, Applied, AppliedStep, SHOWN_NAMES, Script};
use serde_json::json;

use super::error::{self, Exit};
use super::input::{self, Input};
use super::layout_output::{LayoutOutput, Written, target_parser};
use super::output::Output;
use super::{limits, text};

#[derive(Debug, clap::Args)]
#[command(after_help = "`guideway edit --help` lists the steps.", after_long_help = script::help())]
pub(crate) struct Args {
    /// Layout file; the content decides the format
    #[arg(value_name = "FILE", value_parser = Input::parser())]
    input: Input,
    /// Steps, as JSON: {"steps": [{"do": "rename", "node": "N7", "to": "gate"}]}. `-` is standard
    /// input
    #[arg(long, value_name = "STEPS")]
    script: PathBuf,
    /// File to write; its extension selects the format unless --to is given. LIF stays in the
    /// version that was read. `-` is standard output
    #[arg(short, long, value_name = "OUT", required_unless_present = "dry_run")]
    output: Option<PathBuf>,
    /// Format of the output
    #[arg(long, value_name = "FORMAT", value_parser = target_parser())]
    to: Option<Target>,
    /// List what each step would touch, and write nothing
    #[arg(long)]
    dry_run: bool,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    let inputs = || [args.input.path.as_path(), args.script.as_path()];
    input::check_stdin_paths(inputs())?;
    let script = read_script(&args.script)?;
    let output = args.output.as_deref().filter(|_| !args.dry_run);
    let target = output.map(|path| LayoutOutput::new(path, args.to, inputs(), out));
    let target = target.transpose()?;
    let (layout, read_ms) = input::read_all(std::slice::from_ref(&args.input), out)?;
    let refused = layout.refused.len();
    let target = match target {
        Some(output) => Some((output, output.target(&layout)?)),
        None => None,
    };
    let progress = out.progress("editing");
    let applied = script.apply(layout, &limits::read_options(None));
    let Applied { layout, steps } = applied.map_err(|error| {
        let message = format!("{}: {}", shown_path(&args.script), error.message);
        let remedy = format!("{} and nothing was written", error.remedy);
        UserError {
            message,
            remedy,
            ..error
        }
    })?;
    let edit_ms = progress.finish();
    let written = target.map(|(output, target)| output.write(&layout, target, out));
    let written = written.transpose()?;
    let write_ms = written.as_ref().map_or(0.0, |written| written.ms);
    let total_ms = read_ms + edit_ms + write_ms;
    let body = json!({
        "file": args.input.path.to_string_lossy(),
        "script": args.script.to_string_lossy(),
        "output": output.map(|output| output.to_string_lossy()),
        "dry_run": args.dry_run,
        "steps": edit_steps(&steps),
        "refused": refused,
        "not_stored": written.as_ref().map_or(json!([]), Written::losses_json),
        "ms": { "read": read_ms, "edit": edit_ms, "write": write_ms, "total": total_ms },
    });
    let out = out.beside(output);
    out.report("edit", &body, || {
        let lines = steps
            .iter()
            .zip(1..)
            .map(|(step, number)| step_line(step, number));
        let mut words: String = lines.collect();
        match (&written, output) {
            (Some(written), Some(output)) => {
                words += &written.losses_text();
                let (name, size) = (shown_path(output), text::bytes(written.bytes));
                words += &format!("{name}: {size}\n");
            }
            _ => words += "nothing was written\n",
        }
        words + &format!("took {}\n", text::time(total_ms))
    })?;
    Ok(Exit::Clean)
}

/// Reads a script from a file or standard input.
fn read_script(path: &Path) -> Result<Script, UserError> {
    let source: io::Result<Box<dyn Read>> = match input::is_stdin(path) {
        true => Ok(Box::new(io::stdin())),
        false => File::open(path).map(|file| Box::new(file) as Box<dyn Read>),
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    let unreadable = |error: io::Error| {
        let remedy = "Name a JSON file with steps";
        UserError::new("edit-script", error::unreadable(&error), remedy)
    };
    let script = source.map_err(unreadable);
    let script =
        script.and_then(|source| Script::read(source, folder, limits::limits().file_bytes));
    script.map_err(|error| {
        let message = format!("{}: {}", shown_path(path), error.message);
        UserError { message, ..error }
    })
}

/// `  3 set: 12 paths: aisle-1, aisle-2, ...`.
fn step_line(step: &AppliedStep, number: u32) -> String {
    let touched = &step.touched;
    let counts = [Table::Paths, Table::Nodes, Table::Stations].map(|of| (of, touched.count(of)));
    let counts = counts.iter().filter(|(_, count)| *count > 0);
    let counts: Vec<String> = counts
        .map(|(of, n)| text::counted(*n, of.element()))
        .collect();
    let counts = match counts.is_empty() {
        true => "nothing".to_owned(),
        false => counts.join(", "),
    };
    let mut names: Vec<String> = touched
        .names
        .iter()
        .map(|n| text::single_line(n, 40))
        .collect();
    if names.len() > SHOWN_NAMES {
        names.truncate(SHOWN_NAMES);
        names.push("...".to_owned());
    }
    let names = match names.is_empty() {
        true => String::new(),
        false => format!(": {}", names.join(", ")),
    };
    let lost = touched.lost.iter().map(|(name, &count)| {
        let values = text::counted(count as u64, "value");
        format!("    lost: {values} of {}\n", text::single_line(name, 40))
    });
    let lost: String = lost.collect();
    format!("{number:>3} {}: {counts}{names}\n{lost}", step.name)
}
