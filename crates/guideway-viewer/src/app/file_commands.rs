//! File commands: open, close, reload, export. Each involves several parts: files, dialogs,
//! writer, canvas.

use std::path::PathBuf;
use std::sync::Arc;

use guideway_compose::VectorFormat;
use guideway_layout::shown_path;

use super::state::App;
use crate::action::{Action, Export};
use crate::command::Command;
use crate::export::{PictureContent, png_picture};
use crate::files::{NewLayout, WriteOutcome, WriteTarget};
use crate::language::{say, t};
use crate::panels::dialogs::{Question, Risk};
use crate::services::{Job, PictureRequest};

impl App {
    /// Opens a file, or activates it if it is open.
    pub(crate) fn open(&mut self, path: PathBuf) {
        let options = self.settings.scene_options();
        self.files.open(path, self.methods.name(), options);
    }

    /// Opens the example site, which has no file.
    pub(super) fn open_example(&mut self) {
        let (method, options) = (self.methods.name(), self.settings.scene_options());
        let new = NewLayout::By(|services| services.example_site());
        let files = &mut self.files;
        files.open_untitled("example-site", new, method, options);
    }

    pub(super) fn close(&mut self, index: usize) {
        self.files.close(index);
        self.tools.clear_hover();
        // The next file may be no crowd.
        self.settings.is_crowded &= !self.files.layers().is_empty();
    }

    /// Closes a file; asks first if it has unsaved changes.
    pub(super) fn request_close(&mut self, index: usize) {
        match self.files.layers().get(index) {
            Some(layer) if layer.is_changed() => {
                let path = layer.path().to_owned();
                self.dialogs.leave.close_file(path);
            }
            Some(_) => self.close(index),
            None => {}
        }
    }

    /// Reads the active file again; asks first if it has unsaved changes.
    pub(super) fn request_reload(&mut self) {
        match self.files.active() {
            Some(layer) if layer.is_changed() => self.dialogs.confirm.ask(Question {
                file: layer.path().to_owned(),
                risk: Risk::DiscardsChanges,
                confirmed: Action::ReloadWithoutSaving,
            }),
            _ => self.reload(self.files.active_index(), true),
        }
    }

    /// Reads a file again.
    pub(crate) fn reload(&mut self, index: usize, drops_changes: bool) {
        let options = self.settings.scene_options();
        if let Some(notice) = self.files.reload(index, options, drops_changes) {
            self.dialogs.notices.add(notice);
        }
    }

    /// Writes the canvas as a picture; asks before it replaces a file.
    pub(super) fn export_as(&mut self, export: Export) {
        let again = match export {
            Export::Png { .. } => Command::ExportPng,
            Export::Vector { format, .. } => match format {
                VectorFormat::Svg => Command::ExportSvg,
                VectorFormat::Pdf => Command::ExportPdf,
            },
        };
        let question = Question {
            file: export.path().to_owned(),
            risk: Risk::ReplacesFile(again),
            confirmed: Action::ExportOver(export.clone()),
        };
        self.start_export(export, Some(question));
    }

    /// Writes the canvas as a picture, over what is there.
    pub(super) fn export(&mut self, export: Export) {
        self.start_export(export, None);
    }

    /// Starts to write the canvas as a picture. With a question, the write asks it if a file is
    /// there.
    fn start_export(&mut self, export: Export, question: Option<Question>) {
        let Some(picture) = self.picture() else {
            return;
        };
        if self.is_writer_busy() {
            return;
        }
        let asks = question.is_some();
        self.question_of_write = question;
        let services = Arc::clone(&self.context.services);
        let (method, repaint) = (self.method(), &self.context.repaint);
        let job = matches!(export, Export::Png { .. }).then(Arc::<Job>::default);
        let watched = job.clone().unwrap_or_default();
        let write = move || {
            if asks && services.file_stamp(export.path()).is_some() {
                return Ok(WriteOutcome::Exists);
            }
            let text = match export {
                Export::Png { path, width_px } => {
                    png_picture(picture, width_px, &method, &*services, &watched, &path)?
                }
                Export::Vector { path, format } => {
                    services.export_vector(&picture, format, &path)?;
                    say!("Wrote {path}", path = shown_path(&path))
                }
            };
            Ok(WriteOutcome::Written(text))
        };
        self.writer.start(WriteTarget::Picture, job, repaint, write);
    }

    /// Copies the canvas to the clipboard.
    pub(super) fn copy_picture(&mut self) {
        if let Some(picture) = self.picture() {
            let (method, context) = (self.method(), &self.context);
            let (services, repaint) = (&context.services, &context.repaint);
            self.clipboard.copy(picture, method, services, repaint);
        }
    }

    /// Everything that the canvas shows; `None` if no document is visible.
    pub(crate) fn picture(&self) -> Option<PictureRequest> {
        let content = PictureContent {
            view: self.canvas.camera.view()?,
            px_per_point: self.canvas.px_per_point(),
            settings: &self.settings,
            files: &self.files,
            floor_plan: &self.floor_plan,
            swept_areas: &self.swept_areas,
        };
        content.request()
    }

    fn method(&self) -> String {
        self.methods.name().to_owned()
    }

    /// Returns `true` if a file is being written; adds a notice if so.
    pub(super) fn is_writer_busy(&mut self) -> bool {
        let is_busy = self.writer.is_busy();
        if is_busy {
            let notice = t("Another file is being written; try again in a moment");
            self.dialogs.notices.add(notice);
        }
        is_busy
    }
}
