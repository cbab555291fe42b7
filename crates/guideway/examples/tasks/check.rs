//! Checks a site: findings of its file, geometry and network, each with place and remedy.

use std::error::Error;
use std::path::Path;

use guideway::layout::Severity;

pub(super) fn run(site: &Path, _folder: &Path) -> Result<String, Box<dyn Error>> {
    let layout = guideway::open(site)?;
    let findings = guideway::check(&layout);
    let grave = findings.iter().filter(|f| f.severity >= Severity::Warning);
    let lines: Vec<_> = grave
        .map(|f| format!("{}: {}. {}", f.place, f.message, f.remedy))
        .collect();
    Ok(format!(
        "{} warnings and errors {}",
        lines.len(),
        lines.join("\n")
    ))
}
