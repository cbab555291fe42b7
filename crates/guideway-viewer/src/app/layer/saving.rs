//! What is written of an open file, and what survives a crash.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use guideway_document::{Document, ReplayProgress, SavedState, Snapshot};
use guideway_scene::SceneOptions;

use super::{Layer, LayerNews, PATIENCE, Work};
use crate::services::AppServices;
use crate::work::Wake;
use crate::work::loader::Loader;
use crate::work::recovery::Recovery;
use crate::work::watcher::{Stamp, stamp};

/// What is written down of the work on a document. It goes where the document goes.
#[derive(Default)]
pub(crate) struct Journal {
    /// None until there is a document, or where it cannot be written.
    recovery: Option<Recovery>,
    /// What was saved before that which is being saved. Meanwhile nothing is written: it would be of neither state.
    saving: Option<SavedState>,
}

impl Journal {
    /// That of a layout file that was just read.
    pub(super) fn of(file: &Path) -> Self {
        Self {
            recovery: Some(Recovery::of(file)),
            saving: None,
        }
    }

    /// What to say of work of last time that is of another state of the file.
    pub(super) fn said_of_aside(&self, file: &Path) -> Option<String> {
        let aside = self.recovery.as_ref()?.aside()?;
        Some(format!(
            "{} has changed since work on it was left unsaved last time: that work is kept as {}",
            file.display(),
            aside.display()
        ))
    }

    /// Writes down what was done, against a crash. Says once if that cannot be.
    ///
    /// # Errors
    /// What to say.
    pub(super) fn record(&mut self, document: &mut Document, file: &Path) -> Result<(), String> {
        match &mut self.recovery {
            Some(recovery) if self.saving.is_none() => {
                let outcome = recovery.record(document, file);
                self.or_without(outcome, file)
            }
            _ => Ok(()),
        }
    }

    /// Until it is decided what becomes of work that was found, it could not be told from what is done now.
    ///
    /// # Errors
    /// What to say if it is not.
    pub(super) fn check_is_decided(&self) -> Result<(), String> {
        match self.has_found() {
            false => Ok(()),
            true => Err("choose first what becomes of the work of last time".into()),
        }
    }

    fn has_found(&self) -> bool {
        self.recovery.as_ref().is_some_and(Recovery::has_found)
    }

    /// Goes on without a journal where there can be none.
    fn or_without<T>(&mut self, outcome: io::Result<T>, file: &Path) -> Result<T, String> {
        outcome.map_err(|problem| {
            self.recovery = None;
            format!(
                "{}: unsaved work would not survive a crash, for no journal can be written beside it: {problem}",
                file.display()
            )
        })
    }
}

impl Layer {
    /// Whether work that was never saved was found with the file.
    pub(crate) fn has_found_work(&self) -> bool {
        self.journal.has_found()
    }

    /// Reads the file again as it was, to do with it what was found.
    pub(crate) fn recover(
        &mut self,
        services: &Arc<dyn AppServices>,
        options: SceneOptions,
        wake: &Wake,
    ) {
        let recovery = self.journal.recovery.as_ref();
        if let Some(found) = recovery.and_then(|recovery| recovery.found(&self.path)) {
            self.drops_changes = false;
            self.options = options.clone();
            let (services, wake, path) =
                (Arc::clone(services), Arc::clone(wake), self.path.clone());
            self.loader = Some(Loader::start(services, path, Some(found), options, wake));
        }
    }

    /// Writes down from here on what follows the work that was done again. Says how much that was.
    pub(super) fn go_on(&mut self, done: ReplayProgress) -> Option<LayerNews> {
        let recovery = self.journal.recovery.as_mut()?;
        let steps = match done.entries {
            1 => "1 step is done again".to_owned(),
            acts => format!("{acts} steps are done again"),
        };
        let outcome = recovery.go_on(done, &self.path).map(|is_all| match is_all {
            true => steps,
            false => format!("{steps}; what was written behind them is damaged and left out"),
        });
        let text = self.journal.or_without(outcome, &self.path);
        Some(LayerNews::Notice(text.unwrap_or_else(|trouble| trouble)))
    }

    /// Nothing of what was done, or found, needs to survive.
    pub(crate) fn drop_journal(&mut self) {
        if let Some(recovery) = &mut self.journal.recovery {
            recovery.clear();
        }
    }

    /// Writes down what is not written yet.
    pub(super) fn record(&mut self) -> Option<LayerNews> {
        let document = Arc::get_mut(self.document.as_mut()?)?;
        let outcome = self.journal.record(document, &self.path);
        outcome.err().map(LayerNews::Notice)
    }

    pub(crate) fn is_saving(&self) -> bool {
        self.is_saving
    }

    /// Whether its file was written here since it was read.
    pub(crate) fn is_written(&self) -> bool {
        self.written.is_some()
    }

    /// Whether it was written here that a file came into this state.
    pub(crate) fn has_written(&self, state: Stamp) -> bool {
        state.is_some() && self.written == state
    }

    /// What is to be written, and what is to be said. None as long as it is not certain what there is.
    pub(crate) fn begin_saving(&mut self) -> Option<(Snapshot, Option<LayerNews>)> {
        // What others have written into the file may be in the way of saving: first it must be known.
        if self.has_found_work() || self.is_read_again {
            return None;
        }
        let document = self.document_mut()?;
        let snapshot = document.snapshot();
        let before = document.mark_saved();
        self.is_saving = true;
        let unwritten = self.record();
        // From here on it may differ from what is written.
        self.journal.saving = Some(before);
        let recovery = self.journal.recovery.as_ref();
        let kept = recovery.map_or(Ok(()), |recovery| recovery.keep_base(&self.path));
        let lost = self.journal.or_without(kept, &self.path).err();
        Some((snapshot, unwritten.or(lost.map(LayerNews::Notice))))
    }

    /// The layout is written, at this path; or it could not be.
    pub(crate) fn end_saving(&mut self, path: Option<PathBuf>, wake: &Wake) -> Option<LayerNews> {
        self.is_saving = false;
        let work = match path {
            Some(path) => {
                self.path.clone_from(&path);
                self.written = stamp(&path);
                Work::with_journal(move |_, journal| {
                    journal.saving = None;
                    match &mut journal.recovery {
                        Some(recovery) => {
                            let outcome = recovery.set_saved(&path);
                            journal.or_without(outcome, &path)
                        }
                        None => Ok(()),
                    }
                })
            }
            None => Work::with_journal(|document, journal| {
                if let Some(before) = journal.saving.take() {
                    document.restore_saved(before);
                }
                Ok(())
            }),
        };
        self.work(work, PATIENCE, wake)
    }
}
