use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::TryRecvError;

use eframe::egui::{Context, TextureHandle, TextureOptions};
use guideway_document::{Document, replay};
use guideway_layout::{Diagnostics, Layout};
use guideway_render::{Report, View};
use guideway_scene::SceneOptions;
use guideway_spline::Bounds;

use super::overlay::Overlay;
use super::recovery::Recovery;
use crate::host::{Host, Load};
use crate::work::Wake;
use crate::work::loader::{Loaded, Loader};
use crate::work::renderer::{FALLBACK, Outcome, Picture, Renderer, Shot};

/// One open file.
pub(crate) struct Layer {
    pub(crate) path: PathBuf,
    pub(crate) is_visible: bool,
    pub(crate) document: Option<Document>,
    pub(crate) findings: Option<Diagnostics>,
    pub(crate) overlay: Overlay,
    /// What its scene is made with.
    options: SceneOptions,
    /// Why there is no layout, or no picture of it.
    pub(crate) trouble: Option<String>,
    /// The last picture, and what it shows.
    pub(crate) shown: Option<Shown>,
    loader: Option<Loader>,
    renderer: Renderer,
    asked: Option<Shot>,
    /// The journal; none until there is a document, or where it cannot be written.
    recovery: Option<Recovery>,
    /// Acts to be done with the document that is being read.
    to_replay: Option<Vec<u8>>,
    /// While it is, nothing is written to the journal: it would be of neither state.
    is_saving: bool,
}

pub(crate) struct Shown {
    pub(crate) texture: TextureHandle,
    pub(crate) view: View,
    pub(crate) report: Report,
    pub(crate) wall_ms: f64,
}

/// What has happened to a layer that concerns the whole window.
pub(crate) enum LayerNews {
    /// It can be seen for the first time, and this is where it is.
    Appeared(Option<Bounds<f64>>),
    /// Its document is there.
    IsRead,
    /// To be told to the person.
    Notice(String),
}

impl Drop for Layer {
    fn drop(&mut self) {
        // It is closed on purpose, unless the program is coming down; what was found and not decided about stays.
        if !std::thread::panicking() && !self.has_found_work() {
            self.drop_journal();
        }
    }
}

impl Layer {
    pub(crate) fn open(
        path: PathBuf,
        host: &Arc<dyn Host>,
        method: &str,
        options: SceneOptions,
        wake: &Wake,
    ) -> Self {
        Self {
            loader: Some(Loader::start(
                Arc::clone(host),
                path.clone(),
                options.clone(),
                Arc::clone(wake),
            )),
            renderer: Renderer::start(Arc::clone(host), method, Arc::clone(wake)),
            path,
            options,
            is_visible: true,
            document: None,
            findings: None,
            overlay: Overlay::default(),
            trouble: None,
            shown: None,
            asked: None,
            recovery: None,
            to_replay: None,
            is_saving: false,
        }
    }

    /// The file's name.
    pub(crate) fn name(&self) -> String {
        let name = self.path.file_name().unwrap_or(self.path.as_os_str());
        name.to_string_lossy().into_owned()
    }

    pub(crate) fn is_changed(&self) -> bool {
        self.document.as_ref().is_some_and(Document::is_changed)
    }

    /// The load under way, if there is one.
    pub(crate) fn load(&self) -> Option<&Load> {
        let loader = self.loader.as_ref()?;
        self.document.is_none().then(|| loader.load())
    }

    pub(crate) fn cancel_load(&mut self) {
        self.loader = None;
        if self.document.is_none() {
            self.trouble = Some("loading was cancelled".into());
        }
    }

    /// Reads the file again. The old layout stays until the new one is there.
    pub(crate) fn reload(&mut self, host: &Arc<dyn Host>, options: SceneOptions, wake: &Wake) {
        let (host, wake) = (Arc::clone(host), Arc::clone(wake));
        self.options = options.clone();
        self.loader = Some(Loader::start(host, self.path.clone(), options, wake));
    }

    pub(crate) fn set_method(&mut self, name: &str) {
        self.renderer.set_method(name);
        self.asked = None;
    }

    /// Gives the paths other colours, unless they have them.
    ///
    /// # Errors
    /// A sentence on why they cannot have them; the old ones stay.
    pub(crate) fn recolor(&mut self, options: SceneOptions) -> Result<(), String> {
        let is_same =
            self.options.color == options.color && self.options.color_by == options.color_by;
        let name = self.name();
        let Some(document) = self.document.as_mut().filter(|_| !is_same) else {
            return Ok(());
        };
        let outcome = document.recolor(&options);
        // Asked for once, whatever came of it.
        self.options = options;
        self.send_scene();
        outcome.map_err(|error| format!("{name}: {error}"))
    }

    /// Has the renderer draw the document's scene as it is now.
    pub(crate) fn send_scene(&mut self) {
        if let Some(document) = &mut self.document {
            document.take_news();
            self.renderer.set_scene(Arc::new(document.scene().clone()));
            self.asked = None;
        }
    }

    /// Asks for a picture, unless it was already asked for or is there.
    pub(crate) fn ask(&mut self, shot: Shot) {
        for edit in self.document.iter_mut().flat_map(Document::take_news) {
            self.renderer.edit(edit);
            self.asked = None;
        }
        if self.asked != Some(shot) {
            self.renderer.ask(shot);
            self.asked = Some(shot);
        }
    }

    /// Takes what the threads have brought.
    pub(crate) fn poll(
        &mut self,
        ctx: &Context,
        host: &Arc<dyn Host>,
        wake: &Wake,
    ) -> Vec<LayerNews> {
        let mut news = Vec::new();
        news.extend(self.record());
        let loaded: Vec<Loaded> = self.loader.iter().flat_map(Loader::news).collect();
        for piece in loaded {
            self.take(piece, &mut news);
        }
        loop {
            match self.renderer.outcome() {
                Ok(Outcome::Picture(picture)) => self.show(ctx, *picture),
                Ok(Outcome::NeedsScene) => self.send_scene(),
                Ok(Outcome::Notice(text)) => news.push(LayerNews::Notice(text)),
                Ok(Outcome::Failed(why)) => self.trouble = Some(why),
                Err(TryRecvError::Empty) => return news,
                Err(TryRecvError::Disconnected) => {
                    news.push(LayerNews::Notice(format!(
                        "drawing {} stopped; it goes on by {FALLBACK}",
                        self.name()
                    )));
                    self.renderer = Renderer::start(Arc::clone(host), FALLBACK, Arc::clone(wake));
                    self.send_scene();
                    return news;
                }
            }
        }
    }

    fn take(&mut self, piece: Loaded, news: &mut Vec<LayerNews>) {
        match piece {
            Loaded::Scene(scene) => {
                self.trouble = None;
                // One that is read again is shown when it can be edited: until then the old one is.
                if self.document.is_none() {
                    news.push(LayerNews::Appeared(scene.bounds()));
                    self.renderer.set_scene(scene);
                    self.asked = None;
                }
            }
            Loaded::Document(document) => {
                let is_again = self.document.is_some();
                let document = self.document.insert(*document);
                if let Some(acts) = self.to_replay.take() {
                    let done = replay(&acts, document);
                    news.push(LayerNews::Notice(format!(
                        "{} steps are done again",
                        done.acts
                    )));
                } else {
                    self.recovery = Some(Recovery::of(&self.path));
                }
                self.findings = None;
                if is_again {
                    self.send_scene();
                }
                news.push(LayerNews::IsRead);
            }
            Loaded::Findings(findings) => {
                self.findings = Some(findings);
                self.loader = None;
            }
            Loaded::Failed(trouble) => {
                self.loader = None;
                if self.document.is_none() {
                    self.trouble = Some(trouble.to_string());
                } else {
                    news.push(LayerNews::Notice(trouble.to_string()));
                }
            }
        }
    }

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
    fn record(&mut self) -> Option<LayerNews> {
        let (document, recovery) = (self.document.as_mut()?, self.recovery.as_mut()?);
        if self.is_saving {
            return None;
        }
        let outcome = recovery.record(document, &self.path);
        self.with_journal(outcome)
    }

    /// The layout as it is to be written.
    pub(crate) fn begin_saving(&mut self) -> Option<Layout> {
        self.record();
        let document = self.document.as_mut()?;
        let layout = document.to_layout();
        // From here on it may differ from what is written.
        document.set_saved();
        self.is_saving = true;
        if let Some(recovery) = &self.recovery {
            let outcome = recovery.keep_base(&self.path);
            self.with_journal(outcome);
        }
        Some(layout)
    }

    /// The layout is written, at this path; or it could not be.
    pub(crate) fn end_saving(&mut self, path: Option<PathBuf>) -> Option<LayerNews> {
        self.is_saving = false;
        let Some(path) = path else {
            self.document.as_mut()?.set_unsaved();
            return None;
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

    fn show(&mut self, ctx: &Context, picture: Picture) {
        self.trouble = None;
        let Picture {
            shot,
            image,
            report,
            wall_ms,
        } = picture;
        let options = TextureOptions::LINEAR;
        let texture = match self.shown.take() {
            Some(mut shown) => {
                shown.texture.set(image, options);
                shown.texture
            }
            None => ctx.load_texture(self.name(), image, options),
        };
        self.shown = Some(Shown {
            texture,
            view: shot.view,
            report,
            wall_ms,
        });
    }

    pub(crate) fn is_at(&self, path: &Path) -> bool {
        self.path == path
    }
}
