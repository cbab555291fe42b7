use guideway_document::Snapshot;
use guideway_layout::{CheckOptions, Diagnostics};

/// What is odd in a document.
pub(crate) struct Findings {
    pub(crate) found: Diagnostics,
    /// The state of the document that was looked at.
    pub(crate) state: u64,
}

impl Findings {
    pub(crate) fn of(snapshot: &Snapshot, options: &CheckOptions) -> Self {
        Self {
            found: snapshot.findings(options),
            state: snapshot.state(),
        }
    }
}
