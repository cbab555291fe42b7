//! The report of `reproduce` on the terminal.

use std::path::Path;

use guideway::layout::{UserError, shown_path};
use guideway_reproduce::report::PAGE;
use guideway_reproduce::reproduce::{Finding, PartFacts, Run, Verdict, findings};
use serde_json::json;

use super::saved::{REPORT, RUN_FILE};
use crate::cli::output::Output;
use crate::cli::text;

/// Prints the location of the page and the findings.
pub(super) fn report(folder: &Path, run: &Run, out: &Output) -> Result<(), UserError> {
    let findings = findings(run);
    let page = folder.join(PAGE);
    let body = json!({
        "page": page.to_string_lossy(),
        "run": folder.join(RUN_FILE).to_string_lossy(),
        "is_partial": run.is_partial,
        "is_whole": run.is_whole(),
        "findings": findings,
        "parts": run.parts,
        "ms": { "total": run.elapsed_s() * 1e3 },
    });
    out.report(REPORT, &body, || {
        let mut answer = format!("The report is in {}\n", shown_path(&page));
        if run.is_partial {
            answer += "The run was stopped; the report holds the parts measured so far.\n";
        }
        answer += &findings.iter().map(finding).collect::<String>();
        answer += &run.parts.iter().map(part).collect::<String>();
        answer + &format!("took {}\n", text::time(run.elapsed_s() * 1e3))
    })
}

fn finding(finding: &Finding) -> String {
    let verdict = match finding.verdict {
        Verdict::Holds => "holds",
        Verdict::DoesNotHold => "does not hold",
        Verdict::NotMeasured => "not measured",
    };
    format!("  {:<36} {verdict}\n", finding.title)
}

fn part(part: &PartFacts) -> String {
    match (&part.failure, part.is_cut) {
        (Some(failure), _) => format!("note: {}: {failure}\n", part.name),
        (None, true) => format!(
            "note: {}: the time limit left parts unmeasured\n",
            part.name
        ),
        (None, false) => String::new(),
    }
}
