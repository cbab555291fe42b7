//! `guideway check`: everything odd in layout files, with what to do about it.

mod clearance;
mod sarif;
mod table;

use clap::ValueEnum;
use guideway::envelope::ClearanceWork;
use guideway::layout::{
    CheckOptions, Code, Diagnostic, Diagnostics, Severity, check, check_across,
};
use serde_json::{Value, json};

use super::input::{self, Input};
use super::{Exit, Failure, Output, text, values};

#[derive(Debug, clap::Args)]
#[command(
    after_help = format!("Exit codes: 0 nothing worse than a note (or a warning without --strict), \
    1 warnings under --strict, 2 errors.\n\n{}", input::PLACEMENT_HELP)
)]
pub(crate) struct Args {
    /// Layout files of any format that is read, found from their content
    #[arg(required = true, value_name = "FILE", value_parser = Input::parser())]
    inputs: Vec<Input>,
    /// What the answer is: a table for people, JSON (as --json), or SARIF 2.1.0 for code review tools
    #[arg(long, default_value = "table")]
    format: Format,
    /// End with exit code 1 when there are warnings
    #[arg(long)]
    strict: bool,
    /// Findings shown of each kind; JSON and SARIF hold all that are kept
    #[arg(long, value_name = "N", default_value_t = 10)]
    show: usize,
    /// Farthest that a path may begin or end from its node [default: 0.01]
    #[arg(long, value_name = "METERS", value_parser = values::not_negative, allow_hyphen_values = true)]
    gap: Option<f64>,
    /// Greatest jump of direction that still counts as smooth [default: 5]
    #[arg(long, value_name = "DEGREES", value_parser = values::not_negative, allow_hyphen_values = true)]
    kink: Option<f64>,
    /// Tightest bend that vehicles can drive; not looked at unless given
    #[arg(long, value_name = "METERS", value_parser = values::positive, allow_hyphen_values = true)]
    min_radius: Option<f64>,
    #[command(flatten)]
    clearance: clearance::ClearanceArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    Table,
    Json,
    Sarif,
}

impl Args {
    fn options(&self) -> CheckOptions {
        let default = CheckOptions::default();
        CheckOptions {
            gap_tolerance_m: self.gap.unwrap_or(default.gap_tolerance_m),
            kink_angle_rad: self.kink.map_or(default.kink_angle_rad, f64::to_radians),
            min_radius_m: self.min_radius,
            ..default
        }
    }
}

/// A file, and what was found in it.
struct Checked {
    file: String,
    paths: u64,
    found: Diagnostics,
    /// What looking for vehicles that are too near took, if that was asked for.
    clearance: Option<ClearanceWork>,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, Failure> {
    if out.is_json() && args.format == Format::Sarif {
        return Err(Failure::arguments(
            "--json and --format sarif are two answers",
            "Leave --json out",
        ));
    }
    let (files, times) = checked(args, out)?;
    let tally = Tally::of(files.iter().map(|file| &file.found));
    let exit = tally.exit(args.strict);
    match args.format {
        Format::Sarif => super::output::print(&sarif::bytes(&files, exit)?)?,
        Format::Json => answer(args, &Output::new(true, false), &files, &tally, &times)?,
        Format::Table => answer(args, out, &files, &tally, &times)?,
    }
    Ok(exit)
}

struct Times {
    read_ms: f64,
    check_ms: f64,
}

/// Each file by itself, and then against those before it.
fn checked(args: &Args, out: &Output) -> Result<(Vec<Checked>, Times), Failure> {
    let (mut layouts, read_ms) = input::read_each(&args.inputs, out)?;
    let question = args.clearance.question(out)?;
    let activity = out.activity("checking");
    let options = args.options();
    let across = check_across(&layouts.iter().collect::<Vec<_>>());
    let mut files = Vec::with_capacity(layouts.len());
    for ((input, layout), across) in args.inputs.iter().zip(&mut layouts).zip(across) {
        let mut found = std::mem::take(&mut layout.diagnostics);
        found.append(check(layout, &options));
        found.append(across);
        let clearance = question
            .as_ref()
            .map(|question| question.ask(layout, &mut found));
        files.push(Checked {
            file: input.path.to_string_lossy().into_owned(),
            paths: layout.path_count() as u64,
            found,
            clearance: clearance.transpose()?,
        });
    }
    let check_ms = activity.finish();
    Ok((files, Times { read_ms, check_ms }))
}

fn answer(
    args: &Args,
    out: &Output,
    files: &[Checked],
    tally: &Tally,
    times: &Times,
) -> Result<(), Failure> {
    let total_ms = times.read_ms + times.check_ms;
    let found = || {
        files
            .iter()
            .flat_map(|file| file.found.iter().map(move |f| (file, f)))
    };
    let body = json!({
        "file": input::names(&args.inputs),
        "files": files.iter().map(file_json).collect::<Vec<Value>>(),
        "paths": files.iter().map(|file| file.paths).sum::<u64>(),
        "errors": tally.errors,
        "warnings": tally.warnings,
        "notes": tally.notes,
        "exit_code": tally.exit(args.strict).code(),
        "kinds": kinds(files).into_iter().map(kind_json).collect::<Vec<Value>>(),
        "findings": found().map(|(file, f)| finding_json(&file.file, f)).collect::<Vec<Value>>(),
        "clearance": clearance::json(&args.clearance, files),
        "ms": { "read": times.read_ms, "check": times.check_ms, "total": total_ms },
    });
    out.report("check", &body, || {
        let tables = files.iter().map(|file| table::text(file, args.show));
        let mut text: String = tables.collect();
        if files.len() > 1 {
            text += &format!("all files: {}\n", tally.text());
        }
        text += &clearance::text(files);
        text + &format!("took {}\n", text::time(total_ms))
    })
}

/// How many findings of each severity there are.
struct Tally {
    errors: u64,
    warnings: u64,
    notes: u64,
}

impl Tally {
    fn of<'a>(found: impl Iterator<Item = &'a Diagnostics> + Clone) -> Self {
        let at_least = |severity| {
            found
                .clone()
                .map(|f| f.count_at_least(severity))
                .sum::<u64>()
        };
        let (errors, odd) = (at_least(Severity::Error), at_least(Severity::Warning));
        Self {
            errors,
            warnings: odd - errors,
            notes: at_least(Severity::Info) - odd,
        }
    }

    fn exit(&self, is_strict: bool) -> Exit {
        if self.errors > 0 {
            Exit::Errors
        } else if is_strict && self.warnings > 0 {
            Exit::Warnings
        } else {
            Exit::Clean
        }
    }

    fn text(&self) -> String {
        if self.errors + self.warnings + self.notes == 0 {
            return "nothing odd".to_owned();
        }
        format!(
            "{}, {}, {}",
            text::counted(self.errors, "error"),
            text::counted(self.warnings, "warning"),
            text::counted(self.notes, "note"),
        )
    }
}

/// The kinds of findings of all files with their number.
fn kinds(files: &[Checked]) -> Vec<(Code, u64)> {
    let count = |code| files.iter().map(|file| file.found.count(code)).sum();
    let kinds = Code::ALL.iter().map(|&code| (code, count(code)));
    kinds.filter(|(_, count)| *count > 0).collect()
}

fn file_json(file: &Checked) -> Value {
    let tally = Tally::of(std::iter::once(&file.found));
    json!({
        "file": file.file,
        "paths": file.paths,
        "errors": tally.errors,
        "warnings": tally.warnings,
        "notes": tally.notes,
    })
}

fn kind_json((code, count): (Code, u64)) -> Value {
    json!({
        "code": code.name(),
        "severity": code.severity().to_string(),
        "count": count,
        "meaning": code.meaning(),
    })
}

fn finding_json(file: &str, finding: &Diagnostic) -> Value {
    json!({
        "file": file,
        "code": finding.code.name(),
        "severity": finding.severity().to_string(),
        "place": finding.place.element,
        "line": finding.place.line,
        "message": finding.message,
        "remedy": finding.remedy,
    })
}
