//! File commands: open, close, reload, save, export. Each involves several parts: files, dialogs,
//! writer, canvas.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use guideway_compose::FloorPlanKind;
use guideway_layout::shown_path;

use super::state::App;
use crate::export::{PictureContent, png_picture};
use crate::files::LayerContext;
use crate::panels::dialogs::PromptKind;
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

    /// Closes the active file, unless it has unsaved changes.
    pub(super) fn close_active(&mut self) {
        let Some(layer) = self.files.active() else {
            return;
        };
        if layer.is_changed() {
            let notice = format!(
                "{} has unsaved changes; save or undo them before you close it",
                layer.name()
            );
            self.dialogs.notices.add(notice);
        } else {
            self.close(self.files.active_index());
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
        // A file written by this window holds no more than the layout.
        let unwritten = layer.document().filter(|_| !layer.save.is_written());
        let services = &self.context.services;
        let check = unwritten.map(|d| services.check_save_in_place(d.layout(), &path));
        let Some(Err(error)) = check else {
            return self.save(path);
        };
        self.dialogs.notices.add(error.to_string());
        let suggestion = path.with_extension(DEFAULT_EXTENSION);
        let suggestion = suggestion.to_string_lossy().into_owned();
        let prompt = &mut self.dialogs.prompt;
        prompt.ask_with_text(PromptKind::SaveAs, suggestion);
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

    /// Writes the canvas as PNG of this width in pixels.
    pub(super) fn export_png(&mut self, path: PathBuf, width_px: u32) {
        let Some(picture) = self.picture() else {
            return;
        };
        if self.is_writer_busy() {
            return;
        }
        let job = Arc::<Job>::default();
        let watched = Arc::clone(&job);
        let (services, method) = (Arc::clone(&self.context.services), self.method());
        let write = move || png_picture(picture, width_px, &method, &*services, &watched, &path);
        self.writer
            .start(None, Some(job), &self.context.repaint, write);
    }

    /// Writes the canvas as SVG.
    pub(super) fn export_svg(&mut self, path: PathBuf) {
        let Some(picture) = self.picture() else {
            return;
        };
        if self.is_writer_busy() {
            return;
        }
        let services = Arc::clone(&self.context.services);
        let write = move || {
            services.export_svg(&picture, &path)?;
            Ok(format!("Wrote {}", shown_path(&path)))
        };
        self.writer.start(None, None, &self.context.repaint, write);
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
