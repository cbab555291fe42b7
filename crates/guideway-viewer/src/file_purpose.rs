//! The purposes for which the window asks for a file name, and the answer.

use std::path::PathBuf;

/// The purpose of a file name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PromptKind {
    Open,
    SaveAs,
    ExportPng,
    ExportSvg,
    ExportPdf,
    FloorPlan,
    SaveProject,
}

/// The outcome of a question.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Picked {
    /// The user chose this file.
    File(PromptKind, PathBuf),
    /// There is no dialog: the user types the name, beginning with this one.
    Typed(PromptKind, PathBuf),
}
