//! File commands: open, close, reload, save, export. Each involves several parts: files, dialogs,
//! writer, canvas.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use guideway_compose::FloorPlanKind;
use guideway_layout::shown_path;

use super::state::App;
use crate::action::{Action, Export};
use crate::command::Command;
use crate::export::{PictureContent, png_picture};
use crate::files::LayerContext;
use crate::panels::dialogs::{PromptKind, Question, Risk};
use crate::services::{Job, PictureRequest};

/// Placement suggested for a dropped image: a scale that the user has to adapt.
const IMAGE_PLACEMENT: &str = "@px-per-m=20,offset=0,0";
/// Suggested extension where the format of the file has no writer, or saving would lose content.
const DEFAULT_EXTENSION: &str = "lif.json";

impl App {
    /// Opens a file, or activates it if it is open.
    pub(crate) fn open(&mut self, path: PathBuf) {
        let options = self.settings.scene_options();
        self.files.open(path, self.methods.name(), options);
    }

    /// Opens a dropped layout. A dropped map of ROS becomes the floor plan, as does an image once
    /// the user has entered its scale.
    pub(super) fn open_dropped(&mut self, file: &Path) {
        let name = shown_path(file);
        match FloorPlanKind::of_file(file) {
            FloorPlanKind::Layout => self.open(file.to_path_buf()),
            FloorPlanKind::RosMap => {
                let LayerContext { services, repaint } = &self.context;
                self.floor_plan.set(&name.to_string(), services, repaint);
            }
            FloorPlanKind::Image => {
                let text = format!("{name}{IMAGE_PLACEMENT}");
                let prompt = &mut self.dialogs.prompt;
                prompt.ask_with_text(PromptKind::FloorPlan, text);
            }
        }
    }

    pub(super) fn close(&mut self, index: usize) {
        self.files.close(index);
        self.tools.clear_hover();
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

    /// Saves the next file of those that close after saving. Gives up where a question comes up or
    /// the file is not written.
    pub(super) fn save_before_leaving(&mut self) {
        let Some(index) = self.dialogs.leave.next_to_save(&self.files) else {
            return;
        };
        let is_ready = self.files.layers()[index].document().is_some();
        if self.writer.is_busy() || !is_ready {
            return;
        }
        self.files.activate(index);
        self.save_in_place();
        if !self.writer.is_busy() {
            self.dialogs.leave.close();
        }
    }

    /// Reads a file again.
    pub(crate) fn reload(&mut self, index: usize, drops_changes: bool) {
        let options = self.settings.scene_options();
        if let Some(notice) = self.files.reload(index, options, drops_changes) {
            self.dialogs.notices.add(notice);
        }
    }

    /// Saves the active file in place; prompts for another name if that would lose content.
    pub(super) fn save_in_place(&mut self) {
        let Some(layer) = self.files.active() else {
            return;
        };
        let path = layer.path().to_owned();
        if layer.save.is_new() {
            let prompt = &mut self.dialogs.prompt;
            return prompt.ask(PromptKind::SaveAs, Some(&path));
        }
        // A file written by this window holds no more than the layout.
        let unwritten = layer.document().filter(|_| !layer.save.is_written());
        let services = &self.context.services;
        let check = unwritten.map(|d| services.check_save_in_place(d.layout(), &path));
        let Some(Err(error)) = check else {
            return self.save_as(path);
        };
        self.dialogs.notices.add(error.to_string());
        let suggestion = path.with_extension(DEFAULT_EXTENSION);
        let suggestion = suggestion.to_string_lossy().into_owned();
        let prompt = &mut self.dialogs.prompt;
        prompt.ask_with_text(PromptKind::SaveAs, suggestion);
    }

    /// Saves the active file under this name; asks before it overwrites what others wrote.
    pub(super) fn save_as(&mut self, path: PathBuf) {
        let Some(layer) = self.files.active() else {
            return;
        };
        let on_disk = self.context.services.file_stamp(&path);
        let risk = match layer.is_at(&path) {
            true if !layer.save.is_new() && layer.save.is_changed_by_others(on_disk) => {
                Some(Risk::OverwritesChanges)
            }
            is_own if on_disk.is_some() && (!is_own || layer.save.is_new()) => {
                Some(Risk::ReplacesFile(Command::SaveAs))
            }
            _ => None,
        };
        match risk {
            Some(risk) => self.dialogs.confirm.ask(Question {
                file: path.clone(),
                risk,
                confirmed: Action::SaveOver(path),
            }),
            None => self.save(path),
        }
    }

    /// Saves the active file under this name.
    pub(super) fn save(&mut self, path: PathBuf) {
        if self.is_writer_busy() {
            return;
        }
        let Some(layer) = self.files.active_mut() else {
            return;
        };
        let Some((snapshot, notices)) = layer.begin_save() else {
            let notice = "The file is still being loaded or edited; save again in a moment";
            return self.dialogs.notices.add(notice);
        };
        for notice in notices {
            self.dialogs.notices.add(notice);
        }
        let (services, file) = (Arc::clone(&self.context.services), path.clone());
        let write = move || {
            let losses = services.save_layout(&snapshot.to_layout(), &file)?;
            let mut text = format!("Saved {}", shown_path(&file));
            if !losses.is_empty() {
                text += &format!(". The format cannot hold: {}", losses.join("; "));
            }
            Ok(text)
        };
        self.writer
            .start(Some(path), None, &self.context.repaint, write);
    }

    /// Writes the canvas as a picture; asks before it replaces a file.
    pub(super) fn export_as(&mut self, export: Export) {
        if self.context.services.file_stamp(export.path()).is_none() {
            return self.export(export);
        }
        let again = match export {
            Export::Png { .. } => Command::ExportPng,
            Export::Svg { .. } => Command::ExportSvg,
        };
        self.dialogs.confirm.ask(Question {
            file: export.path().to_owned(),
            risk: Risk::ReplacesFile(again),
            confirmed: Action::ExportOver(export),
        });
    }

    /// Writes the canvas as a picture.
    pub(super) fn export(&mut self, export: Export) {
        let Some(picture) = self.picture() else {
            return;
        };
        if self.is_writer_busy() {
            return;
        }
        let services = Arc::clone(&self.context.services);
        let repaint = &self.context.repaint;
        match export {
            Export::Png { path, width_px } => {
                let job = Arc::<Job>::default();
                let (watched, method) = (Arc::clone(&job), self.method());
                let write =
                    move || png_picture(picture, width_px, &method, &*services, &watched, &path);
                self.writer.start(None, Some(job), repaint, write);
            }
            Export::Svg { path } => {
                let write = move || {
                    services.export_svg(&picture, &path)?;
                    Ok(format!("Wrote {}", shown_path(&path)))
                };
                self.writer.start(None, None, repaint, write);
            }
        }
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
    fn picture(&self) -> Option<PictureRequest> {
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
    fn is_writer_busy(&mut self) -> bool {
        let is_busy = self.writer.is_busy();
        if is_busy {
            let notice = "Another file is being written; try again in a moment";
            self.dialogs.notices.add(notice);
        }
        is_busy
    }
}
