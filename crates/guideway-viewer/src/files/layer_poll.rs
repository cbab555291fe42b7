//! Takes the results of the threads of one open file: edits, tasks, the loader, the picture.

use std::time::Duration;

use eframe::egui::Context;
use guideway_compose::usual_widths;
use guideway_document::{Document, ReplayProgress};

use super::layer::{Layer, name_of};
use super::layer_context::LayerContext;
use super::layer_event::LayerEvent;
use super::loader::{Loaded, Loader};
use super::save_state::changed_on_disk;
use super::watcher::Stamp;
use crate::editing::{EDIT_WAIT, Journal, TaskEvent};
use crate::render_queue::PictureEvent;
use crate::services::LoadStage;

impl Layer {
    /// Takes the results of all threads.
    pub(crate) fn poll(&mut self, ctx: &Context, context: &LayerContext) -> Vec<LayerEvent> {
        let repaint = &context.repaint;
        let mut events = Vec::new();
        self.slot.poll_overlay();
        let returned = self.slot.poll(Duration::ZERO);
        events.extend(self.take_return(returned, repaint));
        let home = self.journal_home().to_owned();
        let recorded = self.slot.record(&home);
        let recorded = recorded
            .err()
            .or_else(|| self.slot.journal_mut().take_notice());
        events.extend(recorded.map(LayerEvent::Notice));
        if let Some(wait) = self.slot.journal().retry_after() {
            ctx.request_repaint_after(wait);
        }
        for event in self.tasks.poll(&mut self.slot, &home, repaint) {
            match event {
                TaskEvent::Edit(task) => events.extend(self.run(task, EDIT_WAIT, repaint)),
                TaskEvent::Recolored(coloring) => self.picture.recolor(coloring),
                TaskEvent::Notice(notice) => events.push(LayerEvent::Notice(notice)),
            }
        }
        self.poll_loader(&mut events);
        if let Some(document) = self.document() {
            self.widths = usual_widths(document.layout());
        }
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
        let path = &self.path;
        let name = || name_of(path);
        let LayerContext {
            services, repaint, ..
        } = context;
        for event in self.picture.poll(ctx, name, services, repaint) {
            match event {
                PictureEvent::Shown { is_first } => {
                    self.error = None;
                    events.extend(is_first.then_some(LayerEvent::Reached(LoadStage::Shown)));
                }
                PictureEvent::NeedsScene => self.send_scene(),
                PictureEvent::FellBack(why) => events.push(LayerEvent::FellBack(why)),
                PictureEvent::Failed(why) => self.error = Some(why),
                PictureEvent::Crowded => events.push(LayerEvent::Crowded),
            }
        }
    }

    fn take_loaded(&mut self, piece: Loaded, events: &mut Vec<LayerEvent>) {
        match piece {
            Loaded::Scene(scene) => {
                self.error = None;
                // After a reload the old document stays in place until the new one is ready.
                if self.document().is_none() {
                    self.widths = usual_widths(scene.layout());
                    events.push(LayerEvent::Reached(LoadStage::Read));
                    events.push(LayerEvent::Appeared(scene.bounds()));
                    self.picture.set_scene(scene);
                }
            }
            Loaded::Document(document, done, stamp) => {
                self.take_document(*document, done, stamp, events);
            }
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
        stamp: Stamp,
        events: &mut Vec<LayerEvent>,
    ) {
        self.save.end_reload();
        if self.is_changed() && !self.save.drops_changes() {
            self.loader = None;
            events.push(LayerEvent::Notice(changed_on_disk(&self.name())));
            return;
        }
        self.save.complete_load(stamp);
        let notice = match done {
            Some(done) => {
                let home = self.journal_home().to_owned();
                self.slot.journal_mut().resume(done, &home)
            }
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
        document.on_edit(move |change| queue.change(change));
        let is_reload = self.slot.replace(document);
        self.tasks.reset_findings();
        if is_reload || std::mem::take(&mut self.owes_scene) {
            self.send_scene();
        }
        events.push(LayerEvent::Reached(LoadStage::Editable));
    }

    /// Opens the journal of the file, if this run keeps journals. Returns a notice about it.
    fn open_journal(&mut self) -> Option<String> {
        let has_home = !self.is_untitled() || self.draft.is_some();
        let home = self.journal_home().to_owned();
        let journal = self.slot.journal_mut();
        // The present one has a lock that would keep the next one out.
        *journal = Journal::default();
        if self.keeps_journal && has_home {
            *journal = Journal::open(&home);
        }
        journal.take_notice()
    }
}
