//! The findings of a file as a table for people.

use guideway::layout::{FindingKind, Severity, shown_path, shown_text};

use super::findings::{CheckedFile, SeverityCounts};
use crate::cli::text;

/// The findings of a file by kind, the most severe first, from a severity on.
pub(super) fn findings(file: &CheckedFile, shown_per_kind: usize, least: Severity) -> String {
    let found = &file.found;
    let mut text = String::new();
    for kind in FindingKind::of([found]) {
        let FindingKind {
            code,
            severity,
            count,
        } = kind;
        if severity < least {
            continue;
        }
        text += &format!(
            "{severity}: {code} ({})\n  {}\n",
            text::count(count),
            code.meaning()
        );
        let of_kind = || found.iter().filter(|finding| kind.has(finding));
        let mut last_remedy = "";
        for finding in of_kind().take(shown_per_kind) {
            let place = text::single_line(&finding.place.to_string(), 200);
            let message = text::single_line(&finding.message, 400);
            text += &format!("  - {place}: {message}\n");
            // Findings of a kind mostly share their remedy: once is enough.
            if finding.remedy != last_remedy {
                text += &format!("    hint: {}\n", text::single_line(&finding.remedy, 400));
                last_remedy = &finding.remedy;
            }
        }
        let rest = count - (of_kind().count().min(shown_per_kind) as u64);
        if rest > 0 {
            text += &format!("  - and {} more\n", text::count(rest));
        }
        text.push('\n');
    }
    text
}

/// All findings of a file, and their number.
pub(super) fn text(file: &CheckedFile, shown_per_kind: usize) -> String {
    let mut text = findings(file, shown_per_kind, Severity::Info);
    let mut paths = text::counted(file.paths, "path");
    if file.refused > 0 {
        paths += &format!(", {} of them refused", text::count(file.refused));
    }
    if file.unread.is_some() {
        "not read".clone_into(&mut paths);
    }
    let counts = SeverityCounts::of(std::iter::once(&file.found)).text();
    text += &format!("{}: {paths}, {counts}\n", shown_text(&file.file));
    if let Some(config) = &file.config {
        text += &format!("options of {}\n", shown_path(config));
    }
    text
}
