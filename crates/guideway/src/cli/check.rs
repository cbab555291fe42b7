//! `guideway check`: everything odd in a layout file, with what to do about it.

use std::path::{Path, PathBuf};

use guideway::layout::{CheckOptions, Code, Diagnostic, Diagnostics, Severity, check};
use serde_json::{Value, json};

use super::{Exit, Failure, Output, input, text, values};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "Exit codes: 0 nothing worse than a note (or a warning without --strict), \
    1 warnings under --strict, 2 errors."
)]
pub(crate) struct Args {
    /// Layout file: LIF, VDA 5050, openTCS, DXF, GeoJSON or Arrow, found from its content
    file: PathBuf,
    /// End with exit code 1 when there are warnings
    #[arg(long)]
    strict: bool,
    /// Findings shown of each kind; JSON holds all that are kept
    #[arg(long, value_name = "N", default_value_t = 10)]
    show: usize,
    /// Farthest that a path may begin or end from its node [default: 0.01]
    #[arg(long, value_name = "METRES", value_parser = values::not_negative, allow_hyphen_values = true)]
    gap: Option<f64>,
    /// Greatest jump of direction that still counts as smooth [default: 5]
    #[arg(long, value_name = "DEGREES", value_parser = values::not_negative, allow_hyphen_values = true)]
    kink: Option<f64>,
    /// Tightest bend that vehicles can drive; not looked at unless given
    #[arg(long, value_name = "METRES", value_parser = values::positive, allow_hyphen_values = true)]
    min_radius: Option<f64>,
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

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, Failure> {
    let (mut layout, read_ms) = input::read(&args.file, out)?;
    let activity = out.activity("checking");
    let mut found = std::mem::take(&mut layout.diagnostics);
    found.append(check(&layout, &args.options()));
    let check_ms = activity.finish();

    let tally = Tally::of(&found);
    let exit = tally.exit(args.strict);
    let body = json!({
        "file": args.file.to_string_lossy(),
        "paths": layout.path_count(),
        "errors": tally.errors,
        "warnings": tally.warnings,
        "notes": tally.notes,
        "exit_code": exit.code(),
        "kinds": found.counts().map(kind_json).collect::<Vec<Value>>(),
        "findings": found.iter().map(finding_json).collect::<Vec<Value>>(),
        "ms": { "read": read_ms, "check": check_ms, "total": read_ms + check_ms },
    });
    out.report("check", &body, || {
        let mut text = table(&found, args.show);
        text += &summary(&args.file, layout.path_count() as u64, &tally);
        text + &format!("took {}\n", text::time(read_ms + check_ms))
    })?;
    Ok(exit)
}

/// How many findings of each severity there are.
struct Tally {
    errors: u64,
    warnings: u64,
    notes: u64,
}

impl Tally {
    fn of(found: &Diagnostics) -> Self {
        let errors = found.count_at_least(Severity::Error);
        let odd = found.count_at_least(Severity::Warning);
        Self {
            errors,
            warnings: odd - errors,
            notes: found.count_at_least(Severity::Info) - odd,
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
}

fn kind_json((code, count): (Code, u64)) -> Value {
    json!({
        "code": code.name(),
        "severity": code.severity().to_string(),
        "count": count,
        "meaning": code.meaning(),
    })
}

fn finding_json(finding: &Diagnostic) -> Value {
    json!({
        "code": finding.code.name(),
        "severity": finding.severity().to_string(),
        "place": finding.place.element,
        "line": finding.place.line,
        "message": finding.message,
        "remedy": finding.remedy,
    })
}

/// The findings by kind, the worst kinds first.
fn table(found: &Diagnostics, shown_of_each: usize) -> String {
    let mut kinds: Vec<(Code, u64)> = found.counts().collect();
    kinds.sort_by_key(|(code, _)| (std::cmp::Reverse(code.severity()), *code));
    let mut text = String::new();
    for (code, count) in kinds {
        text += &format!(
            "{}: {code} ({})\n  {}\n",
            code.severity(),
            text::count(count),
            code.meaning()
        );
        let of_kind = || found.iter().filter(|finding| finding.code == code);
        let mut last_remedy = "";
        for finding in of_kind().take(shown_of_each) {
            let place = text::plain(&finding.place.to_string(), 200);
            let message = text::plain(&finding.message, 400);
            text += &format!("  - {place}: {message}\n");
            // Findings of a kind mostly share their remedy: said once, it is read.
            if finding.remedy != last_remedy {
                text += &format!("    hint: {}\n", text::plain(&finding.remedy, 400));
                last_remedy = &finding.remedy;
            }
        }
        let rest = count - (of_kind().count().min(shown_of_each) as u64);
        if rest > 0 {
            text += &format!("  - and {} more\n", text::count(rest));
        }
        text.push('\n');
    }
    text
}

fn summary(file: &Path, paths: u64, tally: &Tally) -> String {
    let file = file.display();
    let paths = text::counted(paths, "path");
    if tally.errors + tally.warnings + tally.notes == 0 {
        return format!("{file}: {paths}, nothing odd\n");
    }
    format!(
        "{file}: {paths}, {}, {}, {}\n",
        text::counted(tally.errors, "error"),
        text::counted(tally.warnings, "warning"),
        text::counted(tally.notes, "note"),
    )
}
