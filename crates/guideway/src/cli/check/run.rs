//! Arguments of `check`; checks each file by itself and against the others, prints the report.

use clap::ValueEnum;
use guideway::layout::{CheckOptions, Diagnostic, FindingKind, UserError, check, check_across};
use guideway::network::{AnalyzeOptions, analyze};
use serde_json::{Value, json};

use super::clearance::{self, ClearanceArgs};
use super::findings::{CheckedFile, SeverityCounts};
use super::{sarif, table};
use crate::cli::error::usage_error;
use crate::cli::exit::Exit;
use crate::cli::input::{self, Input};
use crate::cli::output::{Output, print};
use crate::cli::{text, values};

#[derive(Debug, clap::Args)]
#[command(
    after_help = format!("Exit codes: 0 no errors (under --strict: no warnings), \
    1 warnings under --strict, 2 errors.\n\n{}", input::PLACEMENT_HELP)
)]
pub(crate) struct Args {
    /// Layout files; the content decides the format
    #[arg(required = true, value_name = "FILE", value_parser = Input::parser())]
    inputs: Vec<Input>,
    /// Form of the report: a table, JSON (the same as --json), or SARIF 2.1.0 for code review tools
    #[arg(long, default_value = "table")]
    format: Format,
    /// Exit with code 1 if there are warnings
    #[arg(long)]
    strict: bool,
    /// Findings to show per kind; JSON and SARIF hold all
    #[arg(long, value_name = "N", default_value_t = 10)]
    show: usize,
    /// Maximum distance from the end of a path to its node [default: 0.01, and less in a layout of
    /// paths shorter than a meter]
    #[arg(
        long,
        value_name = "METERS",
        value_parser = values::not_negative,
        allow_hyphen_values = true
    )]
    gap: Option<f64>,
    /// Maximum change of direction at a smooth joint [default: 5]
    #[arg(
        long,
        value_name = "DEGREES",
        value_parser = values::not_negative,
        allow_hyphen_values = true
    )]
    kink: Option<f64>,
    /// Minimum turning radius of the vehicles; without it, radii are not checked
    #[arg(
        long,
        value_name = "METERS",
        value_parser = values::positive,
        allow_hyphen_values = true
    )]
    min_radius: Option<f64>,
    /// Largest lateral acceleration in bends, in m/s²; without it, speeds are not checked
    #[arg(
        long,
        value_name = "VALUE",
        value_parser = values::positive,
        allow_hyphen_values = true
    )]
    lateral_acceleration: Option<f64>,
    #[command(flatten)]
    clearance: ClearanceArgs,
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
            gap_tolerance_m: self.gap,
            kink_angle_rad: self.kink.map_or(default.kink_angle_rad, f64::to_radians),
            min_radius_m: self.min_radius,
            ..default
        }
    }

    fn network_options(&self) -> AnalyzeOptions {
        AnalyzeOptions {
            lateral_acceleration_m_s2: self.lateral_acceleration,
            ..AnalyzeOptions::default()
        }
    }
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    if out.is_json() && args.format == Format::Sarif {
        return Err(usage_error(
            "--json and --format sarif select different reports",
            "Omit --json",
        ));
    }
    let (files, times) = checked(args, out)?;
    let counts = SeverityCounts::of(files.iter().map(|file| &file.found));
    let exit = counts.exit(args.strict);
    match args.format {
        Format::Sarif => print(&sarif::bytes(&files, exit)?)?,
        Format::Json => report(args, &Output::new(true, false), &files, &counts, &times)?,
        Format::Table => report(args, out, &files, &counts, &times)?,
    }
    Ok(exit)
}

struct Times {
    read_ms: f64,
    check_ms: f64,
}

/// Checks each file by itself, and against the files before it.
fn checked(args: &Args, out: &Output) -> Result<(Vec<CheckedFile>, Times), UserError> {
    let (mut layouts, read_ms) = input::read_each(&args.inputs, out)?;
    let clearance_check = args.clearance.check(out)?;
    let progress = out.progress("checking");
    let options = args.options();
    let across = check_across(&layouts.iter().collect::<Vec<_>>());
    let mut files = Vec::with_capacity(layouts.len());
    for ((input, layout), across) in args.inputs.iter().zip(&mut layouts).zip(across) {
        // A doubt about the unit comes first: findings of the reader may follow from it.
        let mut found = check(layout, &options);
        found.append(analyze(layout, &args.network_options()));
        found.append(std::mem::take(&mut layout.diagnostics));
        found.append(across);
        let clearance = clearance_check
            .as_ref()
            .map(|check| check.run(layout, &mut found));
        files.push(CheckedFile {
            file: input.path.to_string_lossy().into_owned(),
            paths: layout.path_count() as u64,
            refused: layout.refused.len() as u64,
            found,
            clearance: clearance.transpose()?,
        });
    }
    let check_ms = progress.finish();
    Ok((files, Times { read_ms, check_ms }))
}

fn report(
    args: &Args,
    out: &Output,
    files: &[CheckedFile],
    counts: &SeverityCounts,
    times: &Times,
) -> Result<(), UserError> {
    let total_ms = times.read_ms + times.check_ms;
    let kinds = FindingKind::of(files.iter().map(|file| &file.found));
    let found = || {
        files
            .iter()
            .flat_map(|file| file.found.iter().map(move |f| (file, f)))
    };
    let body = json!({
        "file": input::names(&args.inputs),
        "files": files.iter().map(file_json).collect::<Vec<Value>>(),
        "paths": files.iter().map(|file| file.paths).sum::<u64>(),
        "refused": files.iter().map(|file| file.refused).sum::<u64>(),
        "errors": counts.errors,
        "warnings": counts.warnings,
        "notes": counts.notes,
        "exit_code": counts.exit(args.strict).code(),
        "kinds": kinds.into_iter().map(kind_json).collect::<Vec<Value>>(),
        "findings": found().map(|(file, f)| finding_json(&file.file, f)).collect::<Vec<Value>>(),
        "clearance": clearance::json(&args.clearance, files),
        "ms": { "read": times.read_ms, "check": times.check_ms, "total": total_ms },
    });
    out.report("check", &body, || {
        let tables = files.iter().map(|file| table::text(file, args.show));
        let mut text: String = tables.collect();
        if files.len() > 1 {
            text += &format!("all files: {}\n", counts.text());
        }
        text += &clearance::text(files);
        text + &format!("took {}\n", text::time(total_ms))
    })
}

fn file_json(file: &CheckedFile) -> Value {
    let counts = SeverityCounts::of(std::iter::once(&file.found));
    json!({
        "file": file.file,
        "paths": file.paths,
        "refused": file.refused,
        "errors": counts.errors,
        "warnings": counts.warnings,
        "notes": counts.notes,
    })
}

fn kind_json(kind: FindingKind) -> Value {
    json!({
        "code": kind.code.name(),
        "severity": kind.severity.to_string(),
        "count": kind.count,
        "meaning": kind.code.meaning(),
    })
}

fn finding_json(file: &str, finding: &Diagnostic) -> Value {
    json!({
        "file": file,
        "code": finding.code.name(),
        "severity": finding.severity.to_string(),
        "place": finding.place.element,
        "line": finding.place.line,
        "message": finding.message,
        "remedy": finding.remedy,
    })
}
