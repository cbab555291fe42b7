//! What is written of an open file, and what survives a crash.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use guideway_document::{Document, Saved, Snapshot};
use guideway_scene::SceneOptions;

use super::{Layer, LayerNews, PATIENCE, Work};
use crate::app::recovery::Recovery;
use crate::host::Host;
use crate::work::Wake;
use crate::work::loader::Loader;

/// What is written down of the work on a document. It goes where the document goes.
#[derive(Default)]
pub(crate) struct Journal {
    /// None until there is a document, or where it cannot be written.
    recovery: Option<Recovery>,
    /// What was saved before that which is being saved. Meanwhile nothing is written: it would be of neither state.
    saving: Option<Saved>,
}

impl Journal {
    /// That of a layout file that was just read.
    pub(super) fn of(file: &Path) -> Self {
        Self {
            recovery: Some(Recovery::of(file)),
            saving: None,
        }
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

    /// Goes on without a journal where there can be none.
    fn or_without(&mut self, outcome: io::Result<()>, file: &Path) -> Result<(), String> {
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
        let recovery = self.journal.recovery.as_ref();
        recovery.is_some_and(Recovery::has_found)
    }

    /// Reads the file again as it was, to do with it what was found.
    pub(crate) fn recover(&mut self, host: &Arc<dyn Host>, options: SceneOptions, wake: &Wake) {
        if let Some(recovery) = &mut self.journal.recovery {
            let (acts, file) = recovery.take_found(&self.path);
            self.to_replay = Some(acts);
            self.options = options.clone();
            let (host, wake) = (Arc::clone(host), Arc::clone(wake));
            self.loader = Some(Loader::start(host, file, options, wake));
        }
    }

    /// Nothing of what was done, or found, needs to survive.
    pub(crate) fn drop_journal(&mut self) {
        if let Some(recovery) = &mut self.journal.recovery {
            recovery.clear();
        }
    }

    /// Writes down what is not written yet.
    pub(super) fn record(&mut self) -> Option<LayerNews> {
        let document = self.document.as_mut()?;
        let outcome = self.journal.record(document, &self.path);
        outcome.err().map(LayerNews::Notice)
    }

    /// What is to be written, and what is to be said.
    pub(crate) fn begin_saving(&mut self) -> Option<(Snapshot, Option<LayerNews>)> {
        let unwritten = self.record();
        let document = self.document.as_mut()?;
        let snapshot = document.snapshot();
        // From here on it may differ from what is written.
        self.journal.saving = Some(document.set_saved());
        let recovery = self.journal.recovery.as_ref();
        let kept = recovery.map_or(Ok(()), |recovery| recovery.keep_base(&self.path));
        let lost = self.journal.or_without(kept, &self.path).err();
        Some((snapshot, unwritten.or(lost.map(LayerNews::Notice))))
    }

    /// The layout is written, at this path; or it could not be.
    pub(crate) fn end_saving(&mut self, path: Option<PathBuf>, wake: &Wake) -> Option<LayerNews> {
        let work = match path {
            Some(path) => {
                self.path.clone_from(&path);
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
                    document.set_saved_as_before(before);
                }
                Ok(())
            }),
        };
        self.work(work, PATIENCE, wake)
    }
}
