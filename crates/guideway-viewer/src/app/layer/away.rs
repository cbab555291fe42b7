//! Work on a document that may take longer than a frame: it is done and written down beside the window, and the document
//! is away meanwhile.

use std::sync::Arc;
use std::time::Duration;

use guideway_document::Document;
use guideway_scene::LayoutCopy;

use super::saving::Journal;
use super::{Layer, LayerNews};
use crate::work::Wake;
use crate::work::task::Task;

/// How long the window waits for work before it goes on without the document: half a frame.
pub(crate) const PATIENCE: Duration = Duration::from_millis(8);

/// Something that is done to a document or its journal, or why it cannot be.
pub(crate) struct Work(Box<Deed>);

type Deed = dyn FnOnce(&mut Document, &mut Journal) -> Result<(), String> + Send;

impl Work {
    /// What changes no more than what is seen.
    pub(crate) fn new(work: impl FnOnce(&mut Document) + Send + 'static) -> Self {
        Self::with_journal(move |document, _| {
            work(document);
            Ok(())
        })
    }

    /// An edit. If it is not possible it says why.
    pub(crate) fn edit<E: ToString>(
        edit: impl FnOnce(&mut Document) -> Result<(), E> + Send + 'static,
    ) -> Self {
        Self::with_journal(move |document, journal| {
            journal.check_is_decided()?;
            edit(document).map_err(|error| error.to_string())
        })
    }

    /// The same, of what concerns the journal too.
    pub(super) fn with_journal(
        work: impl FnOnce(&mut Document, &mut Journal) -> Result<(), String> + Send + 'static,
    ) -> Self {
        Self(Box::new(work))
    }
}

/// Where the document of a layer is when it is not there.
#[derive(Default)]
pub(super) struct Away {
    task: Option<Task<Returned>>,
    /// What is to be done next.
    waiting: Vec<Work>,
    /// A copy of the layout for the next edit of it.
    copying: Option<Task<LayoutCopy>>,
}

/// What comes back, and what is to be said.
type Returned = (Box<(Arc<Document>, Journal)>, Vec<String>);

impl Away {
    pub(super) fn is_at_work(&self) -> bool {
        self.task.is_some()
    }
}

impl Layer {
    /// A hand takes hold of the layout: what an edit of it needs is made ready while it moves.
    pub(crate) fn expect_edit(&mut self, wake: &Wake) {
        let scene = self.document.as_ref().map(|document| document.scene());
        if let Some(scene) = scene.filter(|scene| scene.is_layout_shared())
            && self.away.copying.is_none()
        {
            let layout = scene.shared_layout();
            self.away.copying = Some(Task::start(wake, move || LayoutCopy::new(layout)));
        }
    }

    /// Does work on the document, behind what waits to be done. Where it is not done within `patience`, the document
    /// comes back with a later [`Layer::poll`].
    pub(crate) fn work(
        &mut self,
        work: Work,
        patience: Duration,
        wake: &Wake,
    ) -> Option<LayerNews> {
        if self.document.is_none() && !self.away.is_at_work() {
            return None;
        }
        self.away.waiting.push(work);
        self.begin_work(wake);
        self.take_back(patience, wake)
    }

    fn begin_work(&mut self, wake: &Wake) {
        if self.away.waiting.is_empty() {
            return;
        }
        let Some(document) = self.document.take() else {
            return;
        };
        let journal = std::mem::take(&mut self.journal);
        let mut both = Box::new((document, journal));
        let (overlay, copying) = (self.overlay.give_up(), self.away.copying.take());
        let all = std::mem::take(&mut self.away.waiting);
        let file = self.path.clone();
        self.away.task = Some(Task::start(wake, move || {
            // If it broke down, that was shown.
            let _ = overlay.map(Task::wait);
            let copy = copying.and_then(|copying| copying.wait().ok());
            let (document, journal) = &mut *both;
            let Some(document) = Arc::get_mut(document) else {
                let trouble = "the layout is in use; try again".to_owned();
                return (both, vec![trouble]);
            };
            if let Some(copy) = copy {
                document.adopt_copy(copy);
            }
            let outcomes = all.into_iter().map(|Work(work)| work(document, journal));
            let mut troubles: Vec<String> = outcomes.filter_map(Result::err).collect();
            troubles.extend(journal.record(document, &file).err());
            (both, troubles)
        }));
    }

    /// Takes the document back if its work is done, and begins what waits.
    pub(super) fn take_back(&mut self, patience: Duration, wake: &Wake) -> Option<LayerNews> {
        let outcome = self.away.task.as_ref()?.outcome_within(patience)?;
        self.away.task = None;
        let notice = match outcome {
            Ok((both, troubles)) => {
                let (document, journal) = *both;
                (self.document, self.journal) = (Some(document), journal);
                (!troubles.is_empty()).then(|| troubles.join("; "))
            }
            Err(trouble) => {
                // What was done before is in the journal.
                self.trouble = Some(trouble.to_string());
                self.away.waiting.clear();
                None
            }
        };
        if std::mem::take(&mut self.owes_scene) {
            self.send_scene();
        }
        self.begin_work(wake);
        notice.map(LayerNews::Notice)
    }
}
