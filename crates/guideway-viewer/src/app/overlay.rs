use std::sync::Arc;
#[cfg(test)]
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use guideway_document::Document;
use guideway_document::decorations::{MarkOptions, Marks, Outline, marks, outline};
use guideway_scene::View;

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
        let document = Arc::clone(document);
        self.begin(asked, wake, move |asked| Made::new(&document, asked));
        if self.last().is_none_or(|last| last.elapsed < patience) {
            self.poll(patience);
        }
    }

    fn begin(
        &mut self,
        asked: Asked,
        wake: &Wake,
        make: impl FnOnce(&Asked) -> Made + Send + 'static,
    ) {
        self.asked = Some(asked.clone());
        self.task = Some(Task::start(wake, move || make(&asked)));
    }

    /// Has the last one made again, which comes to no end before there is something to receive, or nobody to send it.
    #[cfg(test)]
    pub(crate) fn make_again(&mut self, document: &Arc<Document>, wake: &Wake, rest: Receiver<()>) {
        let asked = self.asked.clone().expect("one was asked for");
        let document = Arc::clone(document);
        self.begin(asked, wake, move |asked| {
            let _ = rest.recv();
            Made::new(&document, asked)
        });
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
    fn new(document: &Document, asked: &Asked) -> Self {
        let started = Instant::now();
        Self {
            view: asked.view,
            marks: marks(document, &asked.view, &asked.options),
            selection: outline(document, document.selection(), &asked.view),
            elapsed: started.elapsed(),
        }
    }
}
