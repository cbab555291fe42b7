//! The result of a layout check, and the document state that it is about.

use guideway_document::Snapshot;
use guideway_layout::{CheckOptions, Diagnostics};

/// Findings of one document state.
pub(crate) struct Findings {
    pub(crate) diagnostics: Diagnostics,
    /// The checked state, to compare with [`Document::state`](guideway_document::Document::state).
    pub(crate) state: u64,
}

impl Findings {
    /// Checks a snapshot; takes seconds for a million paths.
    pub(crate) fn of(snapshot: &Snapshot, options: &CheckOptions) -> Self {
        Self {
            diagnostics: snapshot.findings(options),
            state: snapshot.state(),
        }
    }
}
