//! The report of `check` as a table or JSON.

use guideway::layout::{Diagnostic, FindingKind, Severity, UserError, shown_path, shown_text};
use serde_json::{Value, json};

use super::args::Args;
use super::findings::{CheckedFile, SeverityCounts, exit};
use super::fingerprint::fingerprint;
use super::{clearance, table};
use crate::cli::output::{Output, print_for_people};
use crate::cli::{input, text};

/// Findings that are gone that the table lists.
const SHOWN_GONE: usize = 10;

/// Durations of all files, in milliseconds.
#[derive(Default)]
pub(super) struct Times {
    pub(super) read_ms: f64,
    pub(super) check_ms: f64,
}

pub(super) fn report(
    args: &Args,
    out: &Output,
    files: &[CheckedFile],
    times: &Times,
) -> Result<(), UserError> {
    let counts = SeverityCounts::of(files.iter().map(|file| &file.found));
    let total_ms = times.read_ms + times.check_ms;
    let kinds = FindingKind::of(files.iter().map(|file| &file.found));
    let found = || {
        files
            .iter()
            .flat_map(|file| file.found.iter().map(move |f| (file, f)))
    };
    let sum = |of: fn(&CheckedFile) -> u64| files.iter().map(of).sum::<u64>();
    let body = json!({
        "file": input::names(&args.inputs),
        "files": files.iter().map(file_json).collect::<Vec<Value>>(),
        "paths": sum(|file| file.paths),
        "refused": sum(|file| file.refused),
        "errors": counts.errors,
        "warnings": counts.warnings,
        "notes": counts.notes,
        "known": sum(|file| file.known),
        "exit_code": exit(files).code(),
        "kinds": kinds.into_iter().map(kind_json).collect::<Vec<Value>>(),
        "findings": found().map(|(file, f)| finding_json(file, f)).collect::<Vec<Value>>(),
        "gone": files.iter().flat_map(gone_json).collect::<Vec<Value>>(),
        "clearance": clearance::json(&args.clearance, files),
        "ms": { "read": times.read_ms, "check": times.check_ms, "total": total_ms },
    });
    if out.is_quiet() && args.report_file().is_none() {
        let errors = files
            .iter()
            .map(|file| table::findings(file, args.show, Severity::Error));
        return print_for_people(&errors.collect::<String>());
    }
    out.report_to(args.report_file(), "check", &body, || {
        let tables = files.iter().map(|file| table::text(file, args.show));
        let mut text: String = tables.collect();
        if files.len() > 1 {
            text += &format!("all files: {}\n", counts.text());
        }
        text += &baseline_text(args, files);
        text += &clearance::text(files);
        text + &format!("took {}\n", text::time(total_ms))
    })
}

/// Known findings, and those that are gone.
fn baseline_text(args: &Args, files: &[CheckedFile]) -> String {
    let known: u64 = files.iter().map(|file| file.known).sum();
    let mut text = String::new();
    if let Some(path) = &args.write_baseline {
        let known = text::counted(known, "finding");
        return format!("{}: {known} saved as known\n", shown_path(path));
    }
    if let Some(path) = &args.baseline {
        let known = text::counted(known, "known finding");
        text += &format!("{}: {known} left out\n", shown_path(path));
    }
    let gone = || {
        files
            .iter()
            .flat_map(|file| file.gone.iter().map(move |e| (file, e)))
    };
    let count = gone().count();
    for (file, entry) in gone().take(SHOWN_GONE) {
        let place = text::single_line(&entry.place, 200);
        text += &format!(
            "  gone: {} at {place} in {} ({})\n",
            entry.code,
            shown_text(&file.file),
            entry.count
        );
    }
    if count > SHOWN_GONE {
        text += &format!(
            "  and {} more are gone\n",
            text::count((count - SHOWN_GONE) as u64)
        );
    }
    text
}

fn file_json(file: &CheckedFile) -> Value {
    let counts = SeverityCounts::of(std::iter::once(&file.found));
    json!({
        "file": file.file,
        "read": file.unread.is_none(),
        "config": file.config.as_ref().map(|path| path.to_string_lossy()),
        "fail_on": file.fail_on().to_string(),
        "paths": file.paths,
        "refused": file.refused,
        "errors": counts.errors,
        "warnings": counts.warnings,
        "notes": counts.notes,
        "known": file.known,
    })
}

fn gone_json(file: &CheckedFile) -> impl Iterator<Item = Value> {
    file.gone.iter().map(|entry| {
        json!({
            "file": file.file,
            "code": entry.code,
            "place": entry.place,
            "count": entry.count,
        })
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

fn finding_json(file: &CheckedFile, finding: &Diagnostic) -> Value {
    json!({
        "file": file.file,
        "code": finding.code.name(),
        "severity": finding.severity.to_string(),
        "place": finding.place.element,
        "line": file.line(&finding.place),
        "column": finding.place.column,
        "row": finding.place.row,
        "fingerprint": fingerprint(finding),
        "message": finding.message,
        "remedy": finding.remedy,
    })
}
