use std::sync::Arc;
use std::time::{Duration, Instant};

use guideway_document::Document;
use guideway_document::marks::{MarkOptions, Marks, Outline, marks, outline};
use guideway_render::View;

use crate::work::Wake;
use crate::work::task::Task;

/// What is drawn over the picture of one document. As the picture is, it is made beside the window, and the last one is
/// shown where it now belongs until the next one is there.
#[derive(Default)]
pub(crate) struct Overlay {
    made: Option<Made>,
    task: Option<Task<Made>>,
    /// What the task, or else the last one, is of.
    asked: Option<Asked>,
}

#[derive(Clone, PartialEq)]
struct Asked {
    view: View,
    options: MarkOptions,
    revision: u64,
}

/// Marks and outlines of a view.
pub(crate) struct Made {
    pub(crate) view: View,
    pub(crate) marks: Marks,
    pub(crate) selection: Outline,
    elapsed: Duration,
}

impl Overlay {
    /// Has the overlay of a view made, unless it is there or another one still is being made. If the last one did not
    /// take that long, it is waited for with `patience`.
    pub(crate) fn ask(
        &mut self,
        document: &Arc<Document>,
        view: &View,
        options: &MarkOptions,
        patience: Duration,
        wake: &Wake,
    ) {
        let asked = Asked {
            view: *view,
            options: *options,
            revision: document.revision(),
        };
        if self.task.is_some() || self.asked.as_ref() == Some(&asked) {
            return;
        }
        self.asked = Some(asked);
        let (document, view, options) = (Arc::clone(document), *view, *options);
        self.task = Some(Task::start(wake, move || {
            Made::new(&document, &view, &options)
        }));
        if self.last().is_none_or(|last| last.elapsed < patience) {
            self.poll(patience);
        }
    }

    /// Takes what was made, if it is there within `patience`.
    pub(crate) fn poll(&mut self, patience: Duration) {
        let outcome = self
            .task
            .as_ref()
            .and_then(|task| task.outcome_within(patience));
        if let Some(made) = outcome {
            self.task = None;
            // If it broke down, which was shown, the last one stays.
            self.made = made.ok().or(self.made.take());
        }
    }

    /// The last one.
    pub(crate) fn last(&self) -> Option<&Made> {
        self.made.as_ref()
    }

    /// Whether something looks at the document for it.
    pub(crate) fn is_at_work(&self) -> bool {
        self.task.is_some()
    }

    /// Gives up what is being made, as the document is about to change. It is to be waited for, as it still looks at that.
    pub(crate) fn give_up(&mut self) -> Option<Task<Made>> {
        self.asked = None;
        self.task.take()
    }
}

impl Made {
    fn new(document: &Document, view: &View, options: &MarkOptions) -> Self {
        let started = Instant::now();
        Self {
            view: *view,
            marks: marks(document, view, options),
            selection: outline(document, document.selection(), view),
            elapsed: started.elapsed(),
        }
    }
}
