use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui::{Color32, ColorImage, Context};
use guideway_render::{Budget, Cancel, Frame, FrameSize, Style, View};

use super::{App, Layer, LayerNews};
use crate::host::Trouble;
use crate::work::saver::Saver;

/// A question that takes a line of text.
pub(crate) struct Prompt {
    pub(crate) kind: PromptKind,
    pub(crate) text: String,
    /// Width of an exported picture, in pixels.
    pub(crate) width_px: u32,
    pub(crate) is_new: bool,
}

/// A layout being written: the path that it has, and the one that it gets.
pub(super) struct Saving {
    from: PathBuf,
    to: PathBuf,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PromptKind {
    Open,
    SaveAs,
    Picture,
    Drawing,
}

impl App {
    pub(crate) fn open(&mut self, path: PathBuf) {
        if let Some(index) = self.layers.iter().position(|layer| layer.is_at(&path)) {
            self.active = index;
            return;
        }
        let options = self.look.scene_options();
        let layer = Layer::open(path, &self.host, &self.method, options, &self.wake);
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
            self.open(file.path().to_path_buf());
        }
        if std::mem::take(&mut self.has_new_files) {
            self.watch();
        }
        for path in self.watcher.changed().collect::<Vec<_>>() {
            let Some(index) = self.layers.iter().position(|layer| layer.is_at(&path)) else {
                continue;
            };
            let name = self.layers[index].name();
            if self.layers[index].is_changed() {
                self.notify(format!(
                    "{name} has changed on disk; File > Read again takes it and drops your changes"
                ));
            } else {
                self.reload(index);
                self.notify(format!("{name} has changed on disk and is read again"));
            }
        }
        let outcome = self.saver.as_ref().and_then(|(saver, _)| saver.outcome());
        if let Some(outcome) = outcome {
            self.saved(outcome);
        }
    }

    fn watch(&self) {
        let files = self.layers.iter().map(|layer| layer.path.clone()).collect();
        self.watcher.set_files(files);
    }

    pub(crate) fn reload(&mut self, index: usize) {
        let options = self.look.scene_options();
        if let Some(layer) = self.layers.get_mut(index) {
            layer.reload(&self.host, options, &self.wake);
        }
    }

    pub(crate) fn ask_for(&mut self, kind: PromptKind) {
        let file = self.layers.get(self.active).map(|layer| layer.path.clone());
        let ending = match kind {
            PromptKind::Open | PromptKind::SaveAs => None,
            PromptKind::Picture => Some("png"),
            PromptKind::Drawing => Some("svg"),
        };
        let suggested = match (file, ending) {
            (Some(file), Some(ending)) => file.with_extension(ending),
            (Some(file), None) if kind == PromptKind::SaveAs => file,
            _ => PathBuf::new(),
        };
        self.prompt = Some(Prompt {
            kind,
            text: suggested.display().to_string(),
            width_px: 3840,
            is_new: true,
        });
    }

    /// Does what a prompt asked for.
    pub(crate) fn answer(&mut self, prompt: &Prompt) {
        let path = PathBuf::from(prompt.text.trim());
        if path.as_os_str().is_empty() {
            return;
        }
        match prompt.kind {
            PromptKind::Open => self.open(path),
            PromptKind::SaveAs => self.save(path),
            PromptKind::Picture => self.export_picture(path, prompt.width_px),
            PromptKind::Drawing => self.export_drawing(path),
        }
    }

    /// Whether nothing is being written; says so if something is.
    fn is_free_to_write(&mut self) -> bool {
        let is_free = self.saver.is_none();
        if !is_free {
            self.notify("another file is still being written; try again in a moment");
        }
        is_free
    }

    pub(crate) fn save(&mut self, path: PathBuf) {
        if !self.is_free_to_write() {
            return;
        }
        let Some(layer) = self.layers.get_mut(self.active) else {
            return;
        };
        let from = layer.path.clone();
        let Some(layout) = layer.begin_saving() else {
            return;
        };
        let host = Arc::clone(&self.host);
        let to = path.clone();
        let saver = Saver::start(Arc::clone(&self.wake), move || {
            let lost = host.save(&layout, &path)?;
            let mut text = format!("{} is saved", path.display());
            if !lost.is_empty() {
                text += &format!("; its format cannot hold: {}", lost.join("; "));
            }
            Ok(text)
        });
        self.saver = Some((saver, Some(Saving { from, to })));
    }

    fn saved(&mut self, outcome: Result<String, Trouble>) {
        let saving = self.saver.take().and_then(|(_, saving)| saving);
        if let Some(Saving { from, to }) = saving
            && let Some(layer) = self.layers.iter_mut().find(|layer| layer.is_at(&from))
            && let Some(LayerNews::Notice(text)) = layer.end_saving(outcome.is_ok().then_some(to))
        {
            self.notify(text);
        }
        match outcome {
            Ok(text) => self.notify(text),
            Err(trouble) => self.notify(trouble.to_string()),
        }
        // What was written just now is no change from outside.
        self.watch();
    }

    fn export_picture(&mut self, path: PathBuf, width_px: u32) {
        let (Some(view), Some(document)) = (self.camera.view(), self.document()) else {
            return;
        };
        let factor = f64::from(width_px) / f64::from(view.size().width());
        let height_px = (f64::from(view.size().height()) * factor).round() as u32;
        let scene = Arc::new(document.scene().clone());
        let style = Style {
            background: self.look.paper(),
            ..self.look.style()
        };
        if !self.is_free_to_write() {
            return;
        }
        let (host, method) = (Arc::clone(&self.host), self.method.clone());
        let saver = Saver::start(Arc::clone(&self.wake), move || {
            let fail = |error: guideway_render::RenderError| Trouble {
                message: error.to_string(),
                remedy: "Ask for a smaller picture, or another way of drawing".into(),
            };
            let size = FrameSize::new(width_px, height_px).map_err(fail)?;
            let scale = view.px_per_m() * factor;
            let view = View::new(size, view.center_m(), scale).map_err(fail)?;
            let budget = Budget::default();
            let mut prepared = host
                .method(&method)?
                .prepare(scene, &budget)
                .map_err(fail)?;
            let mut frame = Frame::new(size);
            let cancel = Cancel::default();
            prepared
                .render(&view, &style, &cancel, &mut frame)
                .map_err(fail)?;
            host.save_picture(&frame, &path)?;
            Ok(format!(
                "{} is written, {width_px} x {height_px} pixels",
                path.display()
            ))
        });
        self.saver = Some((saver, None));
    }

    fn export_drawing(&mut self, path: PathBuf) {
        let (Some(view), Some(document)) = (self.camera.view(), self.document()) else {
            return;
        };
        let scene = document.scene().clone();
        let style = Style {
            background: self.look.paper(),
            ..self.look.style()
        };
        if !self.is_free_to_write() {
            return;
        }
        let host = Arc::clone(&self.host);
        let saver = Saver::start(Arc::clone(&self.wake), move || {
            host.save_drawing(&scene, &view, &style, &path)?;
            Ok(format!("{} is written", path.display()))
        });
        self.saver = Some((saver, None));
    }

    /// The picture of the active layer as it is on the screen, for the clipboard.
    pub(crate) fn copy_picture(&mut self, ctx: &Context) {
        let (Some(view), Some(document)) = (self.camera.view(), self.document()) else {
            return;
        };
        let style = Style {
            background: self.look.paper(),
            ..self.look.style()
        };
        let scene = Arc::new(document.scene().clone());
        let mut frame = Frame::new(view.size());
        let drawn = self.host.method(&self.method).and_then(|method| {
            let fail = |error: guideway_render::RenderError| Trouble {
                message: error.to_string(),
                remedy: "Choose another way of drawing".into(),
            };
            let mut prepared = method.prepare(scene, &Budget::default()).map_err(fail)?;
            let cancel = Cancel::default();
            prepared
                .render(&view, &style, &cancel, &mut frame)
                .map_err(fail)
        });
        match drawn {
            Ok(_) => {
                let size = [
                    frame.size().width() as usize,
                    frame.size().height() as usize,
                ];
                let color = |&[r, g, b, a]: &[u8; 4]| Color32::from_rgba_unmultiplied(r, g, b, a);
                let pixels = frame.pixels().iter().map(color).collect();
                ctx.copy_image(ColorImage::new(size, pixels));
                self.notify("the picture is on the clipboard");
            }
            Err(trouble) => self.notify(trouble.to_string()),
        }
    }
}
