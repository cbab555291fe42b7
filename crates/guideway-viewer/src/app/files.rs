use std::path::{Path, PathBuf};
use std::sync::Arc;

use eframe::egui::Context;

use super::layer::changed_on_disk;
use super::{App, Layer, LayerNews};
use crate::services::Job;
use crate::work::task::Task;
use guideway_layout::UserError;

/// A question that takes a line of text.
pub(crate) struct Prompt {
    pub(crate) kind: PromptKind,
    pub(crate) text: String,
    /// Width of an exported picture, in pixels.
    pub(crate) width_px: u32,
    pub(crate) is_new: bool,
}

/// Something being written.
pub(super) struct Saver {
    /// Says in a sentence what was done.
    pub(super) task: Task<Result<String, UserError>>,
    /// Where to, if it is the layout of the layer that is being saved.
    pub(super) layout_to: Option<PathBuf>,
    /// How far it is, if that is known.
    pub(super) job: Option<Arc<Job>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PromptKind {
    Open,
    SaveAs,
    Picture,
    Drawing,
    FloorPlan,
}

impl App {
    pub(crate) fn open(&mut self, path: PathBuf) {
        if let Some(index) = self.layers.iter().position(|layer| layer.is_at(&path)) {
            self.active = index;
            return;
        }
        let options = self.look.scene_options();
        let method = self.drawing.method();
        let layer = Layer::open(path, &self.services, method, options, &self.wake);
        self.layers.push(layer);
        self.active = self.layers.len() - 1;
        self.has_new_files = true;
    }

    pub(crate) fn close(&mut self, index: usize) {
        self.layers.remove(index);
        self.active = self.active.min(self.layers.len().saturating_sub(1));
        self.hover = None;
        self.has_new_files = true;
    }

    /// Files dropped on the window, changed on disk, or written.
    pub(super) fn poll_files(&mut self, ctx: &Context) {
        for file in ctx.input(|input| input.raw.dropped_files.clone()) {
            self.take_dropped(file.path());
        }
        if std::mem::take(&mut self.has_new_files) {
            self.watch();
        }
        let outcome = self.saver.as_ref().and_then(|saver| saver.task.outcome());
        if let Some(outcome) = outcome {
            self.saved(outcome.flatten());
        }
        for (path, state) in self.watcher.changed().collect::<Vec<_>>() {
            let is_news = |layer: &Layer| layer.is_at(&path) && !layer.has_written(state);
            let Some(index) = self.layers.iter().position(is_news) else {
                continue;
            };
            let name = self.layers[index].name();
            if self.layers[index].is_changed() {
                self.notify(changed_on_disk(&name));
            } else {
                self.reload(index, false);
                self.notify(format!("{name} has changed on disk and is read again"));
            }
        }
        let copied = self.copying.as_ref().and_then(Task::outcome);
        if let Some(copied) = copied {
            self.copying = None;
            match copied.flatten() {
                Ok(image) => {
                    ctx.copy_image(image);
                    self.notify("the picture is on the clipboard");
                }
                Err(trouble) => self.notify(trouble.to_string()),
            }
        }
    }

    /// An image is a floor plan, of which its size on the floor must be asked; anything else is a layout.
    fn take_dropped(&mut self, file: &Path) {
        if !file
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("png"))
        {
            self.open(file.to_path_buf());
            return;
        }
        self.ask_for(PromptKind::FloorPlan);
        if let Some(prompt) = &mut self.prompt {
            prompt.text = format!("{}@px-per-m=20,offset=0,0", file.display());
        }
    }

    fn watch(&self) {
        let files = self.layers.iter().map(|layer| layer.path.clone()).collect();
        self.watcher.set_files(files);
    }

    pub(crate) fn reload(&mut self, index: usize, drops_changes: bool) {
        let options = self.look.scene_options();
        let Some(layer) = self.layers.get_mut(index) else {
            return;
        };
        if layer.is_saving() {
            let name = layer.name();
            return self.notify(format!(
                "{name} is still being saved; try again in a moment"
            ));
        }
        layer.reload(&self.services, options, drops_changes, &self.wake);
        // As it is now it is read, so that is no change to tell of.
        self.has_new_files = true;
    }

    pub(crate) fn ask_for(&mut self, kind: PromptKind) {
        let file = self.layers.get(self.active).map(|layer| layer.path.clone());
        let ending = match kind {
            PromptKind::Open | PromptKind::SaveAs | PromptKind::FloorPlan => None,
            PromptKind::Picture => Some("png"),
            PromptKind::Drawing => Some("svg"),
        };
        let suggested = match (file, ending) {
            (Some(file), Some(ending)) => file.with_extension(ending),
            (Some(file), None) if kind == PromptKind::SaveAs => file,
            _ => PathBuf::new(),
        };
        let text = match kind {
            PromptKind::FloorPlan => self.floor.plan.clone(),
            _ => suggested.display().to_string(),
        };
        self.prompt = Some(Prompt {
            kind,
            text,
            width_px: 3840,
            is_new: true,
        });
    }

    /// Does what a prompt asked for.
    pub(crate) fn answer(&mut self, prompt: &Prompt) {
        if prompt.kind == PromptKind::FloorPlan {
            return self.lay_floor_plan(&prompt.text);
        }
        let path = PathBuf::from(prompt.text.trim());
        if path.as_os_str().is_empty() {
            return;
        }
        match prompt.kind {
            PromptKind::Open => self.open(path),
            PromptKind::SaveAs => self.save(path),
            PromptKind::Picture => self.export_picture(path, prompt.width_px),
            PromptKind::Drawing => self.export_drawing(path),
            PromptKind::FloorPlan => {}
        }
    }

    /// What is being written, where it is known how far it is.
    pub(crate) fn writing(&self) -> Option<&Job> {
        self.saver.as_ref()?.job.as_deref()
    }

    /// Whether a file is being written.
    #[cfg(test)]
    pub(crate) fn is_writing(&self) -> bool {
        self.saver.is_some()
    }

    /// Whether nothing is being written; says so if something is.
    pub(super) fn is_free_to_write(&mut self) -> bool {
        let is_free = self.saver.is_none();
        if !is_free {
            self.notify("another file is still being written; try again in a moment");
        }
        is_free
    }

    /// Saves a file where it is, if that loses nothing that is in it; else asks for a name.
    pub(super) fn save_in_place(&mut self) {
        let Some(layer) = self.layers.get(self.active) else {
            return;
        };
        let path = layer.path.clone();
        let is_as_read = layer.document.as_ref().filter(|_| !layer.is_written());
        let checked =
            is_as_read.map(|document| self.services.check_save_in_place(document.layout(), &path));
        let Some(Err(trouble)) = checked else {
            return self.save(path);
        };
        self.notify(trouble.to_string());
        self.ask_for(PromptKind::SaveAs);
        if let Some(prompt) = &mut self.prompt {
            prompt.text = path.with_extension("lif.json").display().to_string();
        }
    }

    fn save(&mut self, path: PathBuf) {
        if !self.is_free_to_write() {
            return;
        }
        let Some(layer) = self.layers.get_mut(self.active) else {
            return;
        };
        let Some((snapshot, news)) = layer.begin_saving() else {
            self.notify("the file is still being read or changed; save again in a moment");
            return;
        };
        if let Some(LayerNews::Notice(text)) = news {
            self.notify(text);
        }
        let services = Arc::clone(&self.services);
        let to = path.clone();
        let task = Task::start(&self.wake, move || {
            let lost = services.save_layout(&snapshot.to_layout(), &path)?;
            let mut text = format!("{} is saved", path.display());
            if !lost.is_empty() {
                text += &format!("; its format cannot hold: {}", lost.join("; "));
            }
            Ok(text)
        });
        self.saver = Some(Saver {
            task,
            layout_to: Some(to),
            job: None,
        });
    }

    fn saved(&mut self, outcome: Result<String, UserError>) {
        let layout_to = self.saver.take().and_then(|saver| saver.layout_to);
        if let Some(to) = layout_to
            && let Some(index) = self.layers.iter().position(Layer::is_saving)
        {
            let to = outcome.is_ok().then_some(to);
            let is_written = to.is_some();
            if let Some(LayerNews::Notice(text)) = self.layers[index].end_saving(to, &self.wake) {
                self.notify(text);
            }
            if is_written {
                self.remember(index);
            }
            self.has_new_files = true;
        }
        match outcome {
            Ok(text) => self.notify(text),
            Err(trouble) => self.notify(trouble.to_string()),
        }
    }
}
