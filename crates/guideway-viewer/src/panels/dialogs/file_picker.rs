//! The file dialog of the desktop: opens it, and waits for its answer on another thread.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui::{Context, Id, Modal};

use crate::background::{BackgroundTask, RepaintHandle};
use crate::file_purpose::{Picked, PromptKind};
use crate::language::t;
use crate::services::{AppServices, FileAnswer};

/// A dialog that ends without a file within this time was not shown. Derived: nobody reads a dialog
/// and cancels it in half a second, and a desktop without dialogs says so at once.
const SHORTEST_ANSWER: Duration = Duration::from_millis(500);

/// The dialog of the desktop, while it is open.
#[derive(Default)]
pub(crate) struct FilePicker {
    open: Option<OpenPicker>,
}

struct OpenPicker {
    kind: PromptKind,
    suggestion: PathBuf,
    /// The answer, and the time that it took: the window may look at it much later.
    answer: BackgroundTask<(FileAnswer, Duration)>,
}

impl FilePicker {
    /// Opens the dialog. Returns `false` if there is none.
    pub(crate) fn ask(
        &mut self,
        kind: PromptKind,
        suggestion: PathBuf,
        active: Option<&Path>,
        services: &Arc<dyn AppServices>,
        repaint: &RepaintHandle,
    ) -> bool {
        let question = kind.question(&suggestion, active, &**services);
        let Some(pending) = services.ask_for_file(&question) else {
            return false;
        };
        self.open = Some(OpenPicker {
            kind,
            suggestion,
            answer: BackgroundTask::start(repaint, || {
                let since = Instant::now();
                (pending(), since.elapsed())
            }),
        });
        true
    }

    pub(crate) fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// Forgets the question; an answer that comes later has no effect.
    pub(super) fn close(&mut self) {
        self.open = None;
    }

    /// Takes the answer. Until it comes, covers the window and offers to type the name.
    pub(super) fn show(&mut self, ctx: &Context) -> Option<Picked> {
        let open = self.open.as_ref()?;
        if let Some(answer) = open.answer.result() {
            let open = self.open.take()?;
            return match answer {
                Ok((FileAnswer::Chosen(path), _)) => Some(Picked::File(open.kind, path)),
                Ok((FileAnswer::Cancelled, took)) if took >= SHORTEST_ANSWER => None,
                _ => Some(Picked::Typed(open.kind, open.suggestion)),
            };
        }
        let (mut types, mut cancels) = (false, false);
        Modal::new(Id::unique("file picker")).show(ctx, |ui| {
            ui.label(t("Choose a file in the dialog of your desktop."));
            ui.horizontal(|ui| {
                types = ui.button(t("Type its name here")).clicked();
                cancels = ui.button(t("Cancel")).clicked();
            });
        });
        let open = self.open.take_if(|_| types || cancels)?;
        types.then_some(Picked::Typed(open.kind, open.suggestion))
    }
}
