//! Findings of a file, and their number by severity and kind.

use guideway::envelope::ClearanceWork;
use guideway::layout::{Diagnostics, Severity};

use crate::cli::exit::Exit;
use crate::cli::text;

/// A file with its findings.
pub(super) struct CheckedFile {
    pub(super) file: String,
    pub(super) paths: u64,
    /// Paths that could not be drawn; `paths` includes them.
    pub(super) refused: u64,
    pub(super) found: Diagnostics,
    /// The work of the clearance check, if it was requested.
    pub(super) clearance: Option<ClearanceWork>,
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

    pub(super) fn exit(&self, is_strict: bool) -> Exit {
        if self.errors > 0 {
            Exit::Errors
        } else if is_strict && self.warnings > 0 {
            Exit::Warnings
        } else {
            Exit::Clean
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
