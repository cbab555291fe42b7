//! Document slot: holds the document of an open file. A long edit moves the document to another
//! thread; the slot is empty until it returns.

use std::path::Path;
use std::sync::Arc;
#[cfg(test)]
use std::sync::mpsc::Receiver;
use std::time::Duration;

use guideway_document::decorations::MarkOptions;
use guideway_document::{Document, Group};
use guideway_scene::{LayoutCopy, View};

use super::edit_task::EditTask;
use super::journal::Journal;
use super::notice::Notice;
use super::overlay::{Overlay, OverlayInput};
use crate::background::{BackgroundTask, RepaintHandle};
use crate::language::t;

/// A document with its queued edits, journal and overlay.
#[derive(Default)]
pub(crate) struct DocumentSlot {
    /// `None` before the first load and while an edit runs. Shared with the overlay's task.
    document: Option<Arc<Document>>,
    journal: Journal,
    overlay: Overlay,
    edit: BackgroundEdit,
}

/// The edit in progress and those behind it.
#[derive(Default)]
struct BackgroundEdit {
    task: Option<BackgroundTask<Returned>>,
    queued: Vec<EditTask>,
    /// True if elements were selected in the document that the edit has.
    had_elements_selected: bool,
    /// A copy of the layout for the next edit: see [`DocumentSlot::expect_edit`].
    layout_copy: Option<BackgroundTask<LayoutCopy>>,
}

/// Document and journal after an edit, and the notices for the user.
type Returned = (Box<(Arc<Document>, Journal)>, Vec<Notice>);

/// The end of an edit.
pub(crate) enum EditReturn {
    /// The document is back; the notices of refused edits, joined.
    Returned(Option<Notice>),
    /// The edit panicked and the document is lost; the journal has all earlier edits.
    Lost(String),
}

impl DocumentSlot {
    /// The document, unless an edit has it.
    pub(crate) fn document(&self) -> Option<&Document> {
        self.document.as_deref()
    }

    /// The document for changes on the window's thread. Waits until no task reads it.
    pub(crate) fn document_mut(&mut self) -> Option<&mut Document> {
        // A panic of the task was reported.
        let _ = self.overlay.abandon().map(BackgroundTask::wait);
        self.exclusive()
    }

    /// The document, unless another thread reads it.
    pub(crate) fn exclusive(&mut self) -> Option<&mut Document> {
        Arc::get_mut(self.document.as_mut()?)
    }

    /// Returns `true` if an edit has the document.
    pub(crate) fn is_editing(&self) -> bool {
        self.edit.task.is_some()
    }

    /// Returns `true` if elements were selected before the edit that has the document.
    pub(crate) fn had_elements_selected(&self) -> bool {
        self.edit.had_elements_selected
    }

    /// Returns `true` if the overlay's task reads the document.
    pub(crate) fn is_overlay_busy(&self) -> bool {
        self.overlay.is_busy()
    }

    pub(crate) fn journal(&self) -> &Journal {
        &self.journal
    }

    pub(crate) fn journal_mut(&mut self) -> &mut Journal {
        &mut self.journal
    }

    pub(crate) fn overlay(&self) -> &Overlay {
        &self.overlay
    }

    /// Puts another document in place; drops queued edits and overlay. Returns whether there was a
    /// document before.
    pub(crate) fn replace(&mut self, document: Document) -> bool {
        (self.overlay, self.edit) = Default::default();
        self.document.replace(Arc::new(document)).is_some()
    }

    /// Copies the layout in the background when the user begins to drag: an edit needs its own copy
    /// of a layout that a render method shares.
    pub(crate) fn expect_edit(&mut self, repaint: &RepaintHandle) {
        let scene = self.document.as_ref().map(|document| document.scene());
        if let Some(scene) = scene.filter(|scene| scene.is_layout_shared())
            && self.edit.layout_copy.is_none()
        {
            let layout = scene.shared_layout();
            let copy = BackgroundTask::start(repaint, move || LayoutCopy::new(layout));
            self.edit.layout_copy = Some(copy);
        }
    }

    /// Queues an edit. If it is not complete within `wait`, a later [`Self::poll`] returns it.
    pub(crate) fn run(
        &mut self,
        task: EditTask,
        wait: Duration,
        file: &Path,
        repaint: &RepaintHandle,
    ) -> Option<EditReturn> {
        if self.document.is_none() && !self.is_editing() {
            return None;
        }
        self.edit.queued.push(task);
        self.start_queued(file, repaint);
        self.poll(wait)
    }

    /// Runs all queued edits in one background task, if the document is in place.
    pub(crate) fn start_queued(&mut self, file: &Path, repaint: &RepaintHandle) {
        if self.edit.queued.is_empty() {
            return;
        }
        let Some(document) = self.document.take() else {
            return;
        };
        self.edit.had_elements_selected = document.selected().has_elements();
        let journal = std::mem::take(&mut self.journal);
        let mut both = Box::new((document, journal));
        let (overlay, copy) = (self.overlay.abandon(), self.edit.layout_copy.take());
        let edits = std::mem::take(&mut self.edit.queued);
        let file = file.to_owned();
        self.edit.task = Some(BackgroundTask::start(repaint, move || {
            // A panic of the overlay's task was reported.
            let _ = overlay.map(BackgroundTask::wait);
            let copy = copy.and_then(|copy| copy.wait().ok());
            let (document, journal) = &mut *both;
            let Some(document) = Arc::get_mut(document) else {
                let notice = t("the layout is in use; try again").to_owned();
                return (both, vec![notice]);
            };
            if let Some(copy) = copy {
                document.adopt_copy(copy);
            }
            let results = edits.into_iter().map(|edit| edit.run(document, journal));
            let mut notices: Vec<Notice> = results.filter_map(Result::err).collect();
            notices.extend(journal.record(document, &file).err());
            (both, notices)
        }));
    }

    /// Takes the document back if its edits complete within `wait`. The caller then starts the
    /// queued ones: see [`Self::start_queued`].
    pub(crate) fn poll(&mut self, wait: Duration) -> Option<EditReturn> {
        let result = self.edit.task.as_ref()?.result_within(wait)?;
        self.edit.task = None;
        let returned = match result {
            Ok((both, notices)) => {
                let (document, journal) = *both;
                (self.document, self.journal) = (Some(document), journal);
                EditReturn::Returned((!notices.is_empty()).then(|| notices.join("; ")))
            }
            Err(error) => {
                self.edit.queued.clear();
                EditReturn::Lost(error.to_string())
            }
        };
        Some(returned)
    }

    /// Records edits that were made on the window's thread.
    ///
    /// # Errors
    /// Once, when the journal cannot be written.
    pub(crate) fn record(&mut self, file: &Path) -> Result<(), Notice> {
        let document = self.document.as_mut().and_then(Arc::get_mut);
        document.map_or(Ok(()), |document| self.journal.record(document, file))
    }

    /// Takes a finished overlay.
    pub(crate) fn poll_overlay(&mut self) {
        self.overlay.poll(Duration::ZERO);
    }

    /// Requests the overlay of a view: see [`Overlay::request`].
    pub(crate) fn request_overlay(
        &mut self,
        view: &View,
        options: &MarkOptions,
        highlighted: Option<&Group>,
        wait: Duration,
        repaint: &RepaintHandle,
    ) {
        if let Some(document) = &self.document {
            let input = OverlayInput {
                view: *view,
                options: *options,
                highlighted: highlighted.cloned(),
                revision: document.revision(),
            };
            self.overlay.request(document, input, wait, repaint);
        }
    }

    /// Repeats the overlay with a task that blocks until `rest` yields or disconnects.
    #[cfg(test)]
    pub(crate) fn block_overlay(&mut self, repaint: &RepaintHandle, rest: Receiver<()>) {
        let document = self.document.as_ref().expect("no edit is in progress");
        self.overlay.repeat_blocked(document, repaint, rest);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::services::lanes;

    const LONG: Duration = Duration::from_secs(60);

    fn slot() -> DocumentSlot {
        let mut slot = DocumentSlot::default();
        let document = Document::new(lanes(3).into(), &Default::default()).unwrap();
        assert!(!slot.replace(document));
        slot
    }

    #[test]
    fn document_is_away_while_an_edit_runs_and_returns_with_its_notice() {
        let mut slot = slot();
        let repaint: RepaintHandle = Arc::new(|| {});
        let (finish, rest) = std::sync::mpsc::channel::<()>();
        let slow = EditTask::edit(move |document: &mut Document| {
            document.select_all();
            let _ = rest.recv();
            Err::<(), _>("refused")
        });
        let file = Path::new("site.arrow");
        assert!(slot.run(slow, Duration::ZERO, file, &repaint).is_none());
        assert!(slot.document().is_none() && slot.is_editing());
        drop(finish);
        let returned = slot.poll(LONG);
        let Some(EditReturn::Returned(Some(notice))) = returned else {
            panic!("the edit was refused");
        };
        assert_eq!(notice, "refused");
        assert_eq!(slot.document().unwrap().selection().len(), 3);
    }

    #[test]
    fn edit_without_a_document_is_dropped() {
        let mut slot = DocumentSlot::default();
        let repaint: RepaintHandle = Arc::new(|| {});
        let edit = EditTask::view_change(Document::select_all);
        let returned = slot.run(edit, LONG, Path::new("site.arrow"), &repaint);
        assert!(returned.is_none() && !slot.is_editing());
    }
}
