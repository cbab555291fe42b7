//! The rules of CONTRIBUTING.md that a machine can hold: line width, file length, module headers,
//! words that must not come back, and links between files.

mod links;
mod rules;
mod words;

use std::fmt;
use std::path::Path;
use std::process::Command;

pub use links::check_links;
pub use rules::check_file;

/// A line that breaks a rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    /// File relative to the repository.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// The rule, and what to do.
    pub message: String,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.file, self.line, self.message)
    }
}

/// Checks every file of the repository at `top` that git tracks or could track.
///
/// # Errors
/// When git cannot list the files.
pub fn check_repository(top: &Path) -> std::io::Result<Vec<Violation>> {
    let listed = Command::new("git")
        .args(["ls-files", "--cached", "--others", "--exclude-standard"])
        .current_dir(top)
        .output()?;
    let names = String::from_utf8_lossy(&listed.stdout).into_owned();
    let mut violations = Vec::new();
    for name in names.lines() {
        if let Ok(text) = std::fs::read_to_string(top.join(name)) {
            violations.extend(check_file(name, &text));
            if name.ends_with(".md") {
                violations.extend(check_links(top, name, &text));
            }
        }
    }
    Ok(violations)
}
