//! One open file: routes between its loader, document slot, picture and background tasks.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use guideway_document::Document;
use guideway_layout::shown_path;
use guideway_scene::{LineRule, SceneOptions};

use super::draft_file::DraftFile;
use super::layer_context::LayerContext;
use super::layer_event::LayerEvent;
use super::layer_look::LayerLook;
use super::loader::{Loader, NewLayout, Source};
use super::save_state::{BegunSave, SaveState, SavedFile};
use crate::background::RepaintHandle;
use crate::editing::{BackgroundTasks, DocumentSlot, EDIT_WAIT, EditReturn, EditTask, UnsavedWork};
use crate::language::t;
use crate::render_queue::LayerPicture;
use crate::services::Job;

/// One open file.
pub(crate) struct Layer {
    pub(super) path: PathBuf,
    pub(crate) is_visible: bool,
    pub(crate) look: LayerLook,
    /// The widths of its lines until the user sets one. They are those of the file, and not of what
    /// the view shows as in pictures of the command: lines must not change while the view moves.
    pub(crate) widths: LineRule,
    pub(crate) slot: DocumentSlot,
    pub(crate) picture: LayerPicture,
    pub(crate) tasks: BackgroundTasks,
    pub(crate) save: SaveState,
    /// Why there is no layout or no picture.
    pub(super) error: Option<String>,
    pub(super) loader: Option<Loader>,
    /// True if the render thread waits for the scene of a document that an edit has.
    pub(super) owes_scene: bool,
    /// True if unsaved work is recorded beside the file.
    pub(super) keeps_journal: bool,
    /// The layout until it has a file; `path` is the suggested name then.
    new: Option<NewLayout>,
    /// The draft of a layout that began without a file; `None` where no state is kept. The journal
    /// moves away from it with the first save.
    pub(super) draft: Option<DraftFile>,
}

impl Drop for Layer {
    fn drop(&mut self) {
        // The user closed the file, unless the program crashes. Unsaved work of an earlier run
        // stays until the user decides about it.
        if !std::thread::panicking() && !self.has_unsaved_work() {
            self.discard_journal();
            if let Some(draft) = &self.draft {
                draft.delete();
            }
        }
    }
}

impl Layer {
    /// Opens a file, or a layout that has none yet and would be saved as `path`, with its draft:
    /// starts to read or make it, and starts its render thread.
    pub(super) fn open(
        path: PathBuf,
        (new, draft): (Option<NewLayout>, Option<DraftFile>),
        method: &str,
        options: SceneOptions,
        context: &LayerContext,
    ) -> Self {
        let mut layer = Self {
            picture: LayerPicture::start(
                &context.services,
                method,
                &context.repaint,
                &context.device,
            ),
            path,
            is_visible: true,
            look: LayerLook::default(),
            widths: LineRule::default(),
            slot: DocumentSlot::default(),
            tasks: BackgroundTasks::new(options.clone()),
            save: SaveState::default(),
            error: None,
            loader: None,
            owes_scene: false,
            keeps_journal: context.services.keeps_journals(),
            new,
            draft,
        };
        layer.load(None, options, context);
        layer
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The file name without its folder.
    pub(crate) fn name(&self) -> String {
        name_of(&self.path)
    }

    /// The document, unless it is not loaded or an edit has it.
    pub(crate) fn document(&self) -> Option<&Document> {
        self.slot.document()
    }

    /// Returns `true` if the layout has no file yet.
    pub(crate) fn is_untitled(&self) -> bool {
        self.new.is_some()
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
            self.error =
                Some(t("loading was cancelled; File > Reload reads the file again").into());
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
        if let Some(work) = self.slot.journal().unsaved_work(self.journal_home()) {
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
        let LayerContext {
            services, repaint, ..
        } = context.clone();
        let source = match &self.new {
            None => Source::File(self.path.clone()),
            Some(layout) => {
                // A reload must not change the file that the journal belongs to.
                let unwritten = self.draft.as_ref().filter(|draft| !draft.path().exists());
                let draft = unwritten.map(|draft| draft.path().to_owned());
                Source::New(layout.clone(), draft)
            }
        };
        self.loader = Some(Loader::start(services, source, unsaved, options, repaint));
    }

    pub(super) fn end_load(&mut self) {
        self.loader = None;
        self.save.end_reload();
    }

    /// Begins a save: see [`SaveState::begin`].
    pub(crate) fn begin_save(&mut self) -> Option<BegunSave> {
        let home = self.journal_home().to_owned();
        self.save.begin(&mut self.slot, &home)
    }

    /// Ends a save; with a file, the layout was written there.
    pub(crate) fn end_save(
        &mut self,
        saved: Option<SavedFile>,
        context: &LayerContext,
    ) -> Option<LayerEvent> {
        if let Some(file) = &saved {
            self.path.clone_from(&file.path);
        }
        let is_first = saved.is_some() && self.new.take().is_some();
        let opens_journal = is_first && self.draft.is_none() && self.keeps_journal;
        let complete = self.save.end(saved, opens_journal);
        self.run(complete, EDIT_WAIT, &context.repaint)
    }

    /// The file beside which the journal lies: the draft of a layout without a file.
    pub(super) fn journal_home(&self) -> &Path {
        let draft = self.draft.as_ref().filter(|_| self.is_untitled());
        draft.map_or(&self.path, DraftFile::path)
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
        let home = self.journal_home().to_owned();
        let returned = self.slot.run(task, wait, &home, repaint);
        self.take_return(returned, repaint)
    }

    pub(super) fn take_return(
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
        let home = self.journal_home().to_owned();
        self.slot.start_queued(&home, repaint);
        notice.map(LayerEvent::Notice)
    }

    /// Sends the document's scene to the render thread, once the document is in place.
    pub(super) fn send_scene(&mut self) {
        match self.slot.document() {
            Some(document) => self.picture.set_scene(Arc::new(document.scene().clone())),
            None => self.owes_scene = true,
        }
    }

    /// Returns `true` if this is the file at `path`.
    pub(crate) fn is_at(&self, path: &Path) -> bool {
        self.path == path
    }
}

/// The name of a file without its folder.
pub(super) fn name_of(file: &Path) -> String {
    let name = file.file_name().unwrap_or(file.as_os_str());
    shown_path(Path::new(name))
}
