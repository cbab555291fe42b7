//! What is written of an open file, and what survives a crash.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use guideway_document::Snapshot;
use guideway_scene::SceneOptions;

use super::{Layer, LayerNews, PATIENCE, Work};
use crate::app::recovery::Recovery;
use crate::host::Host;
use crate::work::Wake;
use crate::work::loader::Loader;

impl Layer {
    /// Whether work that was never saved was found with the file.
    pub(crate) fn has_found_work(&self) -> bool {
        self.recovery.as_ref().is_some_and(Recovery::has_found)
    }

    /// Reads the file again as it was, to do with it what was found.
    pub(crate) fn recover(&mut self, host: &Arc<dyn Host>, options: SceneOptions, wake: &Wake) {
        if let Some(recovery) = &mut self.recovery {
            let (acts, file) = recovery.take_found(&self.path);
            self.to_replay = Some(acts);
            self.options = options.clone();
            let (host, wake) = (Arc::clone(host), Arc::clone(wake));
            self.loader = Some(Loader::start(host, file, options, wake));
        }
    }

    /// Nothing of what was done, or found, needs to survive.
    pub(crate) fn drop_journal(&mut self) {
        if let Some(recovery) = &mut self.recovery {
            recovery.clear();
        }
    }

    /// Writes down what was done, against a crash. Says once if that cannot be.
    pub(super) fn record(&mut self) -> Option<LayerNews> {
        let (document, recovery) = (self.document.as_mut()?, self.recovery.as_mut()?);
        if self.saving.is_some() {
            return None;
        }
        let outcome = recovery.record(document, &self.path);
        self.with_journal(outcome)
    }

    /// What is to be written.
    pub(crate) fn begin_saving(&mut self) -> Option<Snapshot> {
        self.record();
        let document = self.document.as_mut()?;
        let snapshot = document.snapshot();
        // From here on it may differ from what is written.
        self.saving = Some(document.set_saved());
        if let Some(recovery) = &self.recovery {
            let outcome = recovery.keep_base(&self.path);
            self.with_journal(outcome);
        }
        Some(snapshot)
    }

    /// The layout is written, at this path; or it could not be.
    pub(crate) fn end_saving(&mut self, path: Option<PathBuf>, wake: &Wake) -> Option<LayerNews> {
        let before = self.saving.take()?;
        let Some(path) = path else {
            let as_before = Work::new(move |document| document.set_saved_as_before(before));
            return self.work(as_before, PATIENCE, wake);
        };
        self.path = path;
        let outcome = self.recovery.as_mut()?.set_saved(&self.path);
        self.with_journal(outcome)
    }

    /// Goes on without a journal where there can be none.
    fn with_journal(&mut self, outcome: io::Result<()>) -> Option<LayerNews> {
        let problem = outcome.err()?;
        self.recovery = None;
        Some(LayerNews::Notice(format!(
            "{}: unsaved work would not survive a crash, for no journal can be written beside it: {problem}",
            self.name()
        )))
    }
}
