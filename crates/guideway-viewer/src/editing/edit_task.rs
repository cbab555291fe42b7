//! One edit of a document, as a closure that can run on another thread.

use std::sync::mpsc::{self, Receiver, SendError, TryRecvError};
use std::time::Duration;

use guideway_document::Document;

use super::journal::Journal;
use super::notice::Notice;
use crate::language::t;

/// Longest time that a frame waits for an edit before it continues without the document: half a
/// frame at 60 Hz.
pub(crate) const EDIT_WAIT: Duration = Duration::from_millis(8);

/// A change of a document or of its journal. It returns a notice for the user if it fails.
pub(crate) struct EditTask(Box<EditFn>);

type EditFn = dyn FnOnce(&mut Document, &mut Journal) -> Result<(), Notice> + Send;

impl EditTask {
    /// Changes selection or visibility, which the journal does not record.
    pub(crate) fn view_change(change: impl FnOnce(&mut Document) + Send + 'static) -> Self {
        Self::with_journal(move |document, _| {
            change(document);
            Ok(())
        })
    }

    /// Edits the layout; refused while unsaved work of an earlier run awaits a decision.
    pub(crate) fn edit<E: ToString>(
        edit: impl FnOnce(&mut Document) -> Result<(), E> + Send + 'static,
    ) -> Self {
        Self::with_journal(move |document, journal| {
            journal.check_is_decided()?;
            edit(document).map_err(|error| error.to_string())
        })
    }

    /// Changes document and journal.
    pub(crate) fn with_journal(
        change: impl FnOnce(&mut Document, &mut Journal) -> Result<(), Notice> + Send + 'static,
    ) -> Self {
        Self(Box::new(move |document, journal| {
            document.end_preview();
            change(document, journal)
        }))
    }

    /// Shows an edit until the next task; one that is refused shows nothing.
    pub(crate) fn preview<E>(
        edit: impl FnOnce(&mut Document) -> Result<(), E> + Send + 'static,
    ) -> Self {
        Self(Box::new(move |document, _| {
            // Confirming the edit tells why it is refused.
            let _ = document.preview_edit(edit);
            Ok(())
        }))
    }

    /// The same edit, whose asker learns how it ends, and tells the user if it is refused.
    pub(crate) fn with_outcome(self) -> (Self, EditOutcome) {
        let (send, outcome) = mpsc::channel();
        let told = Self(Box::new(move |document, journal| {
            // The user hears of it as of other edits, if the asker does not wait any more.
            let sent = send.send(self.run(document, journal));
            sent.or_else(|SendError(result)| result)
        }));
        (told, EditOutcome(outcome))
    }

    /// Takes back the edit that is shown, as any other task does.
    pub(crate) fn end_preview() -> Self {
        Self::view_change(|_| {})
    }

    /// Runs the edit.
    ///
    /// # Errors
    /// The notice of a refused edit.
    pub(super) fn run(self, document: &mut Document, journal: &mut Journal) -> Result<(), Notice> {
        (self.0)(document, journal)
    }
}

/// The end of an edit, for the one who asked for it.
pub(crate) struct EditOutcome(Receiver<Result<(), Notice>>);

impl EditOutcome {
    /// The result, once there is one. An edit that never ran, since its document was replaced or
    /// in use, is refused.
    pub(crate) fn poll(&self) -> Option<Result<(), Notice>> {
        match self.0.try_recv() {
            Ok(result) => Some(result),
            Err(TryRecvError::Disconnected) => {
                Some(Err(t("the layout is in use; try again").to_owned()))
            }
            Err(TryRecvError::Empty) => None,
        }
    }
}
