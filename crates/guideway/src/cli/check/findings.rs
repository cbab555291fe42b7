//! Findings of a file, and their number by severity and kind.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use guideway::envelope::ClearanceWork;
use guideway::layout::{Diagnostics, Place, Severity, UserError};

use super::baseline::Entry;
use super::codes::FailOn;
use super::config::Rules;
use crate::cli::error::Exit;
use crate::cli::input::Input;
use crate::cli::text;

/// Bytes that tell a text.
const BEGIN_BYTES: u64 = 4096;

/// A file with its findings.
pub(super) struct CheckedFile {
    pub(super) path: PathBuf,
    /// The path as text, for reports.
    pub(super) file: String,
    /// The file of settings that applies.
    pub(super) config: Option<PathBuf>,
    pub(super) rules: Rules,
    /// The file is a text, whose findings have lines.
    pub(super) is_text: bool,
    /// Why the file could not be read.
    pub(super) unread: Option<UserError>,
    pub(super) paths: u64,
    /// Paths that could not be drawn; `paths` includes them.
    pub(super) refused: u64,
    pub(super) found: Diagnostics,
    /// Findings of the baseline, which `found` does not have.
    pub(super) known: u64,
    /// Findings of the baseline that the file does not have.
    pub(super) gone: Vec<Entry>,
    /// The work of the clearance check, if it was requested.
    pub(super) clearance: Option<ClearanceWork>,
}

impl CheckedFile {
    /// A file without findings.
    pub(super) fn new(input: &Input, config: Option<PathBuf>, rules: &Rules) -> Self {
        Self {
            path: input.path.clone(),
            file: input.path.to_string_lossy().into_owned(),
            config,
            rules: rules.clone(),
            is_text: is_text(&input.path),
            unread: None,
            paths: 0,
            refused: 0,
            found: Diagnostics::default(),
            known: 0,
            gone: Vec::new(),
            clearance: None,
        }
    }

    /// The line of a finding: of one about a text as a whole, the first.
    pub(super) fn line(&self, place: &Place) -> Option<u32> {
        place.line.or_else(|| self.is_text.then_some(1))
    }

    /// The least severity of findings that the command does not pass.
    pub(super) fn fail_on(&self) -> Severity {
        self.rules.fail_on.unwrap_or(FailOn::Error).severity()
    }
}

/// Returns `true` if a file is a text: the begin of a table or another binary file has a zero. A
/// pipe can be read once only, so nothing is said of it.
fn is_text(path: &Path) -> bool {
    if !path.is_file() {
        return false;
    }
    let mut begin = Vec::new();
    let read = File::open(path).and_then(|file| file.take(BEGIN_BYTES).read_to_end(&mut begin));
    read.is_ok() && !begin.contains(&0)
}

/// The exit code for some files.
pub(super) fn exit(files: &[CheckedFile]) -> Exit {
    let fails = |file: &CheckedFile| file.found.count_at_least(file.fail_on()) > 0;
    if files.iter().all(|file| file.unread.is_some()) {
        Exit::Failed
    } else if files.iter().any(fails) {
        Exit::Found
    } else {
        Exit::Clean
    }
}

/// Number of findings by severity.
pub(super) struct SeverityCounts {
    pub(super) errors: u64,
    pub(super) warnings: u64,
    pub(super) notes: u64,
}

impl SeverityCounts {
    pub(super) fn of<'a>(found: impl Iterator<Item = &'a Diagnostics> + Clone) -> Self {
        let at_least = |severity| {
            found
                .clone()
                .map(|f| f.count_at_least(severity))
                .sum::<u64>()
        };
        let (errors, warnings) = (at_least(Severity::Error), at_least(Severity::Warning));
        Self {
            errors,
            warnings: warnings - errors,
            notes: at_least(Severity::Info) - warnings,
        }
    }

    pub(super) fn text(&self) -> String {
        if self.errors + self.warnings + self.notes == 0 {
            return "no findings".to_owned();
        }
        format!(
            "{}, {}, {}",
            text::counted(self.errors, "error"),
            text::counted(self.warnings, "warning"),
            text::counted(self.notes, "note"),
        )
    }
}
