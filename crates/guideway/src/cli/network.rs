//! `guideway network`: makes a network from the lines of a drawing, and checks it.

use std::fs;
use std::path::PathBuf;

use clap::ValueEnum;
use guideway::formats::Target;
use guideway::layout::{CheckOptions, FindingKind, UserError, check, shown_path};
use guideway::network::{AnalyzeOptions, BuildOptions, LayerRule, NoteSource, analyze, build};
use serde_json::{Value, json};

use super::error::{Exit, unreadable};
use super::input::{self, Input};
use super::layout_output::{LayoutOutput, target_parser};
use super::output::{Output, save};
use super::{text, values};

#[derive(Debug, clap::Args)]
#[command(after_help = input::PLACEMENT_HELP)]
pub(crate) struct Args {
    /// Drawings; the content decides the format
    #[arg(required = true, value_name = "PLAN", value_parser = Input::parser())]
    inputs: Vec<Input>,
    /// File to write; its extension selects the format unless --to is given. `-` is standard output
    #[arg(short, long, value_name = "SITE")]
    output: PathBuf,
    /// Format of the output
    #[arg(long, value_name = "FORMAT", value_parser = target_parser())]
    to: Option<Target>,
    /// Options and rules per layer, in TOML; arguments override them
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    /// Save the options of this call for --map
    #[arg(long, value_name = "FILE")]
    save_map: Option<PathBuf>,
    /// Distance within which ends become one node [default: 0.01]
    #[arg(
        long,
        value_name = "METERS",
        value_parser = values::not_negative,
        allow_hyphen_values = true
    )]
    weld: Option<f64>,
    /// Cut lines where ends meet them and where they cross
    #[arg(long)]
    split: bool,
    /// Cut lines where they cross
    #[arg(long, value_name = "YES|NO")]
    split_crossings: Option<YesNo>,
    /// Replace chains of short lines by curves within this distance
    #[arg(long, value_name = "METERS", value_parser = values::positive, allow_hyphen_values = true)]
    smooth: Option<f64>,
    /// Notes that are stations: text:LAYER, block:NAME, point:LAYER or circle:LAYER; repeatable
    #[arg(long, value_name = "SOURCE")]
    stations: Vec<NoteSource>,
    /// Notes that name nodes; repeatable
    #[arg(long, value_name = "SOURCE")]
    names: Vec<NoteSource>,
    /// Largest distance of a note from its node or line [default: 1]
    #[arg(
        long,
        value_name = "METERS",
        value_parser = values::not_negative,
        allow_hyphen_values = true
    )]
    reach: Option<f64>,
    /// Use the lines of this layer only; repeatable, `*` at the end stands for any rest
    #[arg(long, value_name = "LAYER")]
    layer: Vec<String>,
    /// Vehicles drive along lines as they were drawn, not both ways
    #[arg(long)]
    one_way: bool,
    /// Levels lie one over the other: their ends meet by chance
    #[arg(long)]
    levels_apart: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum YesNo {
    Yes,
    No,
}

impl Args {
    /// The options of the file, overridden by the arguments.
    fn options(&self) -> Result<BuildOptions, UserError> {
        let mut options = match &self.map {
            None => BuildOptions::default(),
            Some(file) => {
                let name = shown_path(file);
                let text = fs::read_to_string(file).map_err(|error| {
                    let remedy = "Name a TOML file; docs/network.md shows one";
                    UserError::new("map", format!("{name}: {}", unreadable(&error)), remedy)
                })?;
                BuildOptions::from_toml(&text).map_err(|error| {
                    let error = UserError::from(error);
                    let message = format!("{name}: {}", error.message);
                    UserError { message, ..error }
                })?
            }
        };
        options.weld_m = self.weld.unwrap_or(options.weld_m);
        options.reach_m = self.reach.unwrap_or(options.reach_m);
        options.smooth_m = self.smooth.or(options.smooth_m);
        options.split_junctions |= self.split;
        options.split_crossings |= self.split;
        if let Some(choice) = self.split_crossings {
            options.split_crossings = choice == YesNo::Yes;
        }
        options.stations.extend(self.stations.iter().cloned());
        options.names.extend(self.names.iter().cloned());
        options.two_way &= !self.one_way;
        options.levels_apart |= self.levels_apart;
        if !self.layer.is_empty() {
            options.other_layers = false;
            let rules = self.layer.iter().map(|name| LayerRule {
                name: name.clone(),
                ..LayerRule::default()
            });
            options.layers.extend(rules);
        }
        Ok(options)
    }
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    let options = args.options()?;
    let inputs = args.inputs.iter().map(|input| input.path.as_path());
    let output = LayoutOutput::new(&args.output, args.to, inputs, out)?;
    let (drawing, read_ms) = input::read_all(&args.inputs, out)?;
    let target = output.target(&drawing)?;
    let progress = out.progress("building the network");
    let made = build(&drawing, &options)?;
    let build_ms = progress.finish();
    drop(drawing);
    let progress = out.progress("checking");
    let mut found = check(&made.layout, &CheckOptions::default());
    found.append(analyze(&made.layout, &AnalyzeOptions::default()));
    let check_ms = progress.finish();
    let written = output.write(&made.layout, target, out)?;
    let (bytes, write_ms) = (written.bytes, written.ms);
    if let Some(file) = &args.save_map {
        save(file, options.to_toml()?.as_bytes())?;
    }
    let total_ms = read_ms + build_ms + check_ms + write_ms;
    let kinds = FindingKind::of([&found]);
    let counts = made.report.counts().into_iter();
    let counts: serde_json::Map<String, Value> = counts
        .map(|(name, count)| (name.to_owned(), json!(count)))
        .collect();
    let left = made.report.left_notes.iter();
    let left = left.map(|n| json!({ "name": n.name, "at_m": [n.position_m.x, n.position_m.y] }));
    let unmatched = made.report.unmatched_sources.iter();
    let unmatched = unmatched
        .map(|found| json!({ "source": found.source.to_string(), "present": found.present }));
    let body = json!({
        "file": input::names(&args.inputs),
        "output": args.output.to_string_lossy(),
        "format": target.name(),
        "counts": counts,
        "named_nodes": made.report.named,
        "values_left": made.report.values_left,
        "largest_move_m": made.report.largest_move_m,
        "left_notes": { "count": made.report.left_note_count, "first": left.collect::<Vec<_>>() },
        "unmatched_sources": unmatched.collect::<Vec<_>>(),
        "findings": kinds.iter().map(|kind| json!({
            "code": kind.code.name(),
            "severity": kind.severity.to_string(),
            "count": kind.count,
        })).collect::<Vec<_>>(),
        "not_stored": written.losses_json(),
        "bytes": bytes,
        "ms": {
            "read": read_ms, "build": build_ms, "check": check_ms, "write": write_ms,
            "total": total_ms,
        },
    });
    out.beside(Some(&args.output))
        .report("network", &body, || {
            let mut words = made.report.lines(&options).join("\n");
            words += "\ncheck: ";
            words += &match kinds.is_empty() {
                true => "no findings\n".to_owned(),
                false => {
                    let kinds = kinds
                        .iter()
                        .map(|k| format!("{} {} ({})", k.count, k.code, k.severity));
                    kinds.collect::<Vec<_>>().join(", ") + "\n"
                }
            };
            words += &written.losses_text();
            let (name, size) = (shown_path(&args.output), text::bytes(bytes));
            words + &format!("{name}: {size}, took {}\n", text::time(total_ms))
        })?;
    Ok(Exit::Clean)
}
