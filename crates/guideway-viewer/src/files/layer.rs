//! One open file: routes between its loader, document slot, picture and background tasks.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use eframe::egui::Context;
use guideway_document::{Document, ReplayProgress, Snapshot};
use guideway_layout::shown_path;
use guideway_scene::SceneOptions;

use super::layer_context::LayerContext;
use super::layer_event::LayerEvent;
use super::layer_look::LayerLook;
use super::loader::{Loaded, Loader, MakeLayout, Source};
use super::save_state::{SaveState, changed_on_disk};
use crate::background::RepaintHandle;
use crate::editing::{
    BackgroundTasks, DocumentSlot, EDIT_WAIT, EditReturn, EditTask, Journal, TaskEvent, UnsavedWork,
};
use crate::render_queue::{LayerPicture, PictureEvent};
use crate::services::{Job, LoadStage};

/// One open file.
pub(crate) struct Layer {
    pub(super) path: PathBuf,
    pub(crate) is_visible: bool,
    pub(crate) look: LayerLook,
    pub(crate) slot: DocumentSlot,
    pub(crate) picture: LayerPicture,
    pub(crate) tasks: BackgroundTasks,
    pub(crate) save: SaveState,
    /// Why there is no layout or no picture.
    error: Option<String>,
    loader: Option<Loader>,
    /// True if the render thread waits for the scene of a document that an edit has.
    owes_scene: bool,
    /// True if unsaved work is recorded beside the file.
    keeps_journal: bool,
    /// Makes the layout again until it has a file; `path` is the suggested name then.
    made_by: Option<MakeLayout>,
}

impl Drop for Layer {
    fn drop(&mut self) {
        // The user closed the file, unless the program crashes. Unsaved work of an earlier run
        // stays until the user decides about it.
        if !std::thread::panicking() && !self.has_unsaved_work() {
            self.discard_journal();
        }
    }
}

impl Layer {
    /// Opens a file, or a layout that has none yet and would be saved as `path`: starts to read or
    /// make it, and starts its render thread.
    pub(crate) fn open(
        path: PathBuf,
        made_by: Option<MakeLayout>,
        method: &str,
        options: SceneOptions,
        context: &LayerContext,
    ) -> Self {
        let mut layer = Self {
            picture: LayerPicture::start(&context.services, method, &context.repaint),
            path,
            is_visible: true,
            look: LayerLook::default(),
            slot: DocumentSlot::default(),
            tasks: BackgroundTasks::new(options.clone()),
            save: SaveState::default(),
            error: None,
            loader: None,
            owes_scene: false,
            keeps_journal: context.services.keeps_journals(),
            made_by,
        };
        layer.load(None, options, context);
        layer
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The file name without its folder.
    pub(crate) fn name(&self) -> String {
        let name = self.path.file_name().unwrap_or(self.path.as_os_str());
        shown_path(Path::new(name))
    }

    /// The document, unless it is not loaded or an edit has it.
    pub(crate) fn document(&self) -> Option<&Document> {
        self.slot.document()
    }

    /// Returns `true` if the layout has no file yet.
    pub(crate) fn is_untitled(&self) -> bool {
        self.made_by.is_some()
    }

    /// Why there is no layout or no picture.
    pub(crate) fn error(&self) -> Option<&str> {
        self.error.as_deref()
    }

    /// Returns `true` if the document differs from its file, or may after the edit or save in
    /// progress.
    pub(crate) fn is_changed(&self) -> bool {
        let is_pending = self.slot.is_editing() || self.save.is_saving();
        self.document().is_some_and(Document::is_changed) || is_pending
    }

    /// Returns `true` if an edit, a recoloring or a query is in progress.
    pub(crate) fn is_busy(&self) -> bool {
        self.tasks.is_busy() || self.slot.is_editing()
    }

    /// Returns `true` if nothing is in progress and the last requested picture is on screen.
    pub(crate) fn is_settled(&self) -> bool {
        let is_drawn = self.picture.is_settled() && !self.slot.is_overlay_busy();
        !self.is_busy() && self.document().is_some() && is_drawn
    }

    /// Returns `true` if the file has a picture, or an error in its place.
    pub(crate) fn has_picture_or_error(&self) -> bool {
        self.picture.shown().is_some() || self.error.is_some()
    }

    /// Returns `true` if the loader has more to send.
    #[cfg(test)]
    pub(crate) fn is_loading(&self) -> bool {
        self.loader.is_some()
    }

    /// The job of a load that the user waits for: the first one, or a recovery.
    pub(crate) fn load_job(&self) -> Option<&Job> {
        let loader = self.loader.as_ref()?;
        let is_first = self.document().is_none() && !self.slot.is_editing();
        (is_first || self.is_recovering()).then(|| loader.job())
    }

    /// Returns `true` if unsaved work of an earlier run awaits a decision.
    pub(crate) fn has_unsaved_work(&self) -> bool {
        self.slot.journal().has_unsaved_work()
    }

    /// Returns `true` if unsaved work is being replayed.
    pub(crate) fn is_recovering(&self) -> bool {
        let loader = self.loader.as_ref();
        self.has_unsaved_work() && loader.is_some_and(Loader::is_recovering)
    }

    /// Cancels the load in progress.
    pub(crate) fn cancel_load(&mut self) {
        self.end_load();
        if self.document().is_none() {
            self.error = Some("loading was cancelled; File > Reload reads the file again".into());
        }
    }

    /// Reads the file again. The old layout stays until the new one is loaded; it stays for good if
    /// it has changes by then and `drops_changes` is false.
    pub(crate) fn reload(
        &mut self,
        options: SceneOptions,
        drops_changes: bool,
        context: &LayerContext,
    ) {
        self.save.begin_reload(drops_changes);
        self.load(None, options, context);
    }

    /// Reads the base of the unsaved work and replays the work on it.
    pub(crate) fn recover(&mut self, options: SceneOptions, context: &LayerContext) {
        if let Some(work) = self.slot.journal().unsaved_work(&self.path) {
            self.save.keep_changes();
            self.load(Some(work), options, context);
        }
    }

    fn load(
        &mut self,
        unsaved: Option<UnsavedWork>,
        options: SceneOptions,
        context: &LayerContext,
    ) {
        self.tasks.set_options(options.clone());
        let LayerContext { services, repaint } = context.clone();
        let of_file = || Source::File(self.path.clone());
        let source = self.made_by.map_or_else(of_file, Source::Made);
        let stamp = services.file_stamp(&self.path);
        self.save.begin_load(stamp.filter(|_| !self.is_untitled()));
        self.loader = Some(Loader::start(services, source, unsaved, options, repaint));
    }

    fn end_load(&mut self) {
        self.loader = None;
        self.save.end_reload();
    }

    /// Begins a save: see [`SaveState::begin`].
    pub(crate) fn begin_save(&mut self) -> Option<(Snapshot, Vec<String>)> {
        self.save.begin(&mut self.slot, &self.path)
    }

    /// Ends a save; with a path, the layout was written there.
    pub(crate) fn end_save(
        &mut self,
        saved_as: Option<PathBuf>,
        context: &LayerContext,
    ) -> Option<LayerEvent> {
        if let Some(path) = &saved_as {
            self.path.clone_from(path);
        }
        let state = context.services.file_stamp(&self.path);
        let is_new = saved_as.is_some() && self.made_by.take().is_some();
        let complete = self.save.end(saved_as, state, is_new && self.keeps_journal);
        self.run(complete, EDIT_WAIT, &context.repaint)
    }

    /// Deletes the journal: its work is saved or unwanted.
    pub(crate) fn discard_journal(&mut self) {
        self.slot.journal_mut().discard();
    }

    /// Runs an edit, behind those in progress. Waits for it for at most `wait`.
    pub(crate) fn run(
        &mut self,
        task: EditTask,
        wait: Duration,
        repaint: &RepaintHandle,
    ) -> Option<LayerEvent> {
        let returned = self.slot.run(task, wait, &self.path, repaint);
        self.take_return(returned, repaint)
    }

    fn take_return(
        &mut self,
        returned: Option<EditReturn>,
        repaint: &RepaintHandle,
    ) -> Option<LayerEvent> {
        let notice = match returned? {
            EditReturn::Returned(notice) => notice,
            EditReturn::Lost(error) => {
                self.error = Some(error);
                None
            }
        };
        if std::mem::take(&mut self.owes_scene) {
            self.send_scene();
        }
        self.slot.start_queued(&self.path, repaint);
        notice.map(LayerEvent::Notice)
    }

    /// Sends the document's scene to the render thread, once the document is in place.
    fn send_scene(&mut self) {
        match self.slot.document() {
            Some(document) => self.picture.set_scene(Arc::new(document.scene().clone())),
            None => self.owes_scene = true,
        }
    }

    /// Takes the results of all threads.
    pub(crate) fn poll(&mut self, ctx: &Context, context: &LayerContext) -> Vec<LayerEvent> {
        let repaint = &context.repaint;
        let mut events = Vec::new();
        self.slot.poll_overlay();
        let returned = self.slot.poll(Duration::ZERO);
        events.extend(self.take_return(returned, repaint));
        let recorded = self.slot.record(&self.path);
        events.extend(recorded.err().map(LayerEvent::Notice));
        for event in self.tasks.poll(&mut self.slot, &self.path, repaint) {
            match event {
                TaskEvent::Edit(task) => events.extend(self.run(task, EDIT_WAIT, repaint)),
                TaskEvent::Recolored => self.send_scene(),
                TaskEvent::Notice(notice) => events.push(LayerEvent::Notice(notice)),
            }
        }
        self.poll_loader(&mut events);
        self.poll_picture(ctx, context, &mut events);
        events
    }

    fn poll_loader(&mut self, events: &mut Vec<LayerEvent>) {
        if self.has_picture_or_error()
            && let Some(loader) = &mut self.loader
        {
            loader.continue_after_first_picture();
        }
        if !self.slot.is_editing() {
            let pieces: Vec<Loaded> = self.loader.iter().flat_map(Loader::pieces).collect();
            for piece in pieces {
                self.take_loaded(piece, events);
            }
        }
    }

    fn poll_picture(
        &mut self,
        ctx: &Context,
        context: &LayerContext,
        events: &mut Vec<LayerEvent>,
    ) {
        let name = self.name();
        let LayerContext { services, repaint } = context;
        for event in self.picture.poll(ctx, &name, services, repaint) {
            match event {
                PictureEvent::Shown { is_first } => {
                    self.error = None;
                    events.extend(is_first.then_some(LayerEvent::Reached(LoadStage::Shown)));
                }
                PictureEvent::NeedsScene => self.send_scene(),
                PictureEvent::FellBack(why) => events.push(LayerEvent::FellBack(why)),
                PictureEvent::Failed(why) => self.error = Some(why),
            }
        }
    }

    fn take_loaded(&mut self, piece: Loaded, events: &mut Vec<LayerEvent>) {
        match piece {
            Loaded::Scene(scene) => {
                self.error = None;
                // After a reload the old document stays in place until the new one is ready.
                if self.document().is_none() {
                    events.push(LayerEvent::Reached(LoadStage::Read));
                    events.push(LayerEvent::Appeared(scene.bounds()));
                    self.picture.set_scene(scene);
                }
            }
            Loaded::Document(document, done) => self.take_document(*document, done, events),
            Loaded::Findings(findings) => {
                self.tasks.set_findings(findings);
                events.push(LayerEvent::Reached(LoadStage::Checked));
                self.loader = None;
            }
            Loaded::Failed(error) => {
                self.end_load();
                if self.document().is_none() {
                    self.error = Some(error.to_string());
                } else {
                    events.push(LayerEvent::Notice(error.to_string()));
                }
            }
        }
    }

    /// Puts a loaded document in place, unless the present one has changes to keep.
    fn take_document(
        &mut self,
        mut document: Document,
        done: Option<ReplayProgress>,
        events: &mut Vec<LayerEvent>,
    ) {
        self.save.end_reload();
        if self.is_changed() && !self.save.drops_changes() {
            self.loader = None;
            events.push(LayerEvent::Notice(changed_on_disk(&self.name())));
            return;
        }
        self.save.complete_load();
        let notice = match done {
            Some(done) => self.slot.journal_mut().resume(done, &self.path),
            None => {
                if !self.has_unsaved_work() {
                    // The journal of the replaced document.
                    self.discard_journal();
                }
                self.open_journal()
            }
        };
        events.extend(notice.map(LayerEvent::Notice));
        // Edits replayed so far are in the scene that the render thread gets.
        let queue = self.picture.queue();
        document.on_edit(move |edit| queue.edit(edit.clone()));
        let is_reload = self.slot.replace(document);
        self.tasks.reset_findings();
        if is_reload || std::mem::take(&mut self.owes_scene) {
            self.send_scene();
        }
        events.push(LayerEvent::Reached(LoadStage::Editable));
    }

    /// Opens the journal of the file, if this run keeps journals. Returns a notice about it.
    fn open_journal(&mut self) -> Option<String> {
        let journal = self.slot.journal_mut();
        // The present one has a lock that would keep the next one out.
        *journal = Journal::default();
        if self.keeps_journal && self.made_by.is_none() {
            *journal = Journal::open(&self.path);
        }
        journal.take_notice()
    }

    /// Returns `true` if this is the file at `path`.
    pub(crate) fn is_at(&self, path: &Path) -> bool {
        self.path == path
    }
}
