//! `guideway edit`: edits a layout by a script of steps in JSON.

use std::path::PathBuf;

use guideway::layout::{UserError, shown_path};
use guideway::scene::Table;
use guideway::script::{self, Applied, AppliedStep, SHOWN_NAMES, Script};
use serde_json::{Value, json};

use super::convert::{target_to_save, write};
use super::error::Exit;
use super::input::{self, Input};
use super::output::Output;
use super::{limits, text};

#[derive(Debug, clap::Args)]
#[command(after_help = "`guideway edit --help` lists the steps.", after_long_help = script::help())]
pub(crate) struct Args {
    /// Layout file; the content decides the format
    #[arg(value_name = "FILE", value_parser = Input::parser())]
    input: Input,
    /// Steps, as JSON: {"steps": [{"do": "rename", "node": "N7", "to": "gate"}]}
    #[arg(long, value_name = "STEPS")]
    script: PathBuf,
    /// File to write; its extension selects the format. LIF stays in the version that was read
    #[arg(short, long, value_name = "OUT", required_unless_present = "dry_run")]
    output: Option<PathBuf>,
    /// List what each step would touch, and write nothing
    #[arg(long)]
    dry_run: bool,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    let script = Script::read(&args.script, limits::limits().file_bytes)?;
    let output = args.output.as_ref().filter(|_| !args.dry_run);
    if let Some(output) = output {
        let inputs = [args.input.path.as_path(), args.script.as_path()];
        input::check_output(inputs, output)?;
    }
    let (layout, read_ms) = input::read_all(std::slice::from_ref(&args.input), out)?;
    let refused = layout.refused.len();
    let target = output
        .map(|output| target_to_save(&layout, output))
        .transpose()?;
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
    let mut write_ms = 0.0;
    let mut written = None;
    if let (Some(output), Some(target)) = (output, target) {
        let progress = out.progress(format!("writing {}", shown_path(output)));
        written = Some((output, target, write(target, &layout, output, &progress)?));
        write_ms = progress.finish();
    }
    let total_ms = read_ms + edit_ms + write_ms;
    let lost = written.iter().flat_map(|(_, _, (losses, _))| losses.iter());
    let lost = lost.map(
        |loss| json!({ "place": loss.what, "count": loss.count, "message": loss.to_string() }),
    );
    let body = json!({
        "file": args.input.path.to_string_lossy(),
        "script": args.script.to_string_lossy(),
        "output": output.map(|output| output.to_string_lossy()),
        "dry_run": args.dry_run,
        "steps": steps.iter().zip(1..).map(step_json).collect::<Vec<_>>(),
        "refused": refused,
        "not_stored": lost.collect::<Vec<Value>>(),
        "ms": { "read": read_ms, "edit": edit_ms, "write": write_ms, "total": total_ms },
    });
    out.report("edit", &body, || {
        let lines = steps
            .iter()
            .zip(1..)
            .map(|(step, number)| step_line(step, number));
        let mut words: String = lines.collect();
        match &written {
            None => words += "nothing was written\n",
            Some((output, target, (losses, bytes))) => {
                if !losses.is_empty() {
                    words += &format!("{} cannot hold, or holds in another form:\n", target.name());
                }
                for loss in losses.iter() {
                    let what = text::single_line(&loss.what, 80);
                    let detail = text::single_line(&loss.noun(), 200);
                    words += &format!("  {what}: {} {detail}\n", text::count(loss.count));
                }
                let (name, size) = (shown_path(output), text::bytes(*bytes));
                words += &format!("{name}: {size}\n");
            }
        }
        words + &format!("took {}\n", text::time(total_ms))
    })?;
    Ok(Exit::Clean)
}

fn step_json((step, number): (&AppliedStep, u32)) -> Value {
    let touched = &step.touched;
    json!({
        "step": number,
        "do": step.name,
        "paths": touched.count(Table::Paths),
        "nodes": touched.count(Table::Nodes),
        "stations": touched.count(Table::Stations),
        "names": touched.names.iter().take(SHOWN_NAMES).collect::<Vec<_>>(),
        "lost": touched.lost,
        "ms": step.ms,
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
