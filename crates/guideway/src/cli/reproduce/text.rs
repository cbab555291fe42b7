use std::path::Path;

use guideway_reproduce::report::PAGE;
use guideway_reproduce::reproduce::{Finding, PartFacts, Run, Verdict, findings};
use serde_json::json;

use super::saved::RUN;
use crate::cli::{Failure, Output, text};

/// Name of the report, in the answer and in the file.
pub(super) const REPORT: &str = "reproduce";

/// Says where the report is and what it found.
pub(super) fn answer(folder: &Path, run: &Run, out: &Output) -> Result<(), Failure> {
    let findings = findings(run);
    let page = folder.join(PAGE);
    let body = json!({
        "page": page.to_string_lossy(),
        "run": folder.join(RUN).to_string_lossy(),
        "is_partial": run.is_partial,
        "is_whole": run.is_whole(),
        "findings": findings,
        "parts": run.parts,
        "ms": { "total": run.elapsed_s() * 1e3 },
    });
    out.report(REPORT, &body, || {
        let mut answer = format!("The report is in {}\n", page.display());
        if run.is_partial {
            answer += "It was stopped: what was measured until then is in it.\n";
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
        (None, true) => format!("note: {}: its time did not do for all of it\n", part.name),
        (None, false) => String::new(),
    }
}
