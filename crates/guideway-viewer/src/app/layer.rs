use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::TryRecvError;
use std::time::Duration;

use eframe::egui::{Context, TextureHandle, TextureOptions};
use guideway_document::{Document, PathSet, ReplayProgress, SelectMode};
use guideway_scene::{Report, View};
use guideway_scene::{Scene, SceneError, SceneOptions};
use guideway_spline::Bounds;

use self::away::Away;
use self::saving::Journal;
use super::overlay::Overlay;
use crate::services::{AppServices, Job, LoadStage};
use crate::work::Wake;
use crate::work::findings::Findings;
use crate::work::loader::{Loaded, Loader};
use crate::work::renderer::{FALLBACK, Outcome, Picture, Renderer, Shot};
use crate::work::task::Task;
use crate::work::watcher::Stamp;

mod answers;
mod away;
mod saving;

pub(crate) use away::{PATIENCE, Work};

/// One open file.
pub(crate) struct Layer {
    pub(crate) path: PathBuf,
    pub(crate) is_visible: bool,
    /// None until it is there, and while long work is done on it. Shared with the thread that makes its overlay.
    pub(crate) document: Option<Arc<Document>>,
    away: Away,
    pub(crate) findings: Option<Findings>,
    pub(crate) overlay: Overlay,
    /// What its scene is made with.
    options: SceneOptions,
    /// Why there is no layout, or no picture of it.
    pub(crate) trouble: Option<String>,
    /// The last picture, and what it shows.
    pub(crate) shown: Option<Shown>,
    loader: Option<Loader>,
    /// Findings on their way that were asked for.
    checking: Option<Task<Findings>>,
    /// Other colors on their way.
    coloring: Option<Task<Result<Scene, SceneError>>>,
    /// What a query asks for, and what the selection does with it.
    selecting: Option<(Task<PathSet>, SelectMode)>,
    renderer: Renderer,
    /// Whether the renderer waits for a scene that was not there when it asked.
    owes_scene: bool,
    asked: Option<Shot>,
    /// What is written down of the work on the document.
    journal: Journal,
    /// Whether the document that is being read takes the place of changes.
    drops_changes: bool,
    /// Whether a document is being read in place of the one that is there.
    is_read_again: bool,
    is_saving: bool,
    /// The state of its file that was last written here.
    written: Stamp,
}

pub(crate) struct Shown {
    pub(crate) texture: TextureHandle,
    /// Which picture of the file it is, from 1 on.
    pub(crate) number: u64,
    pub(crate) view: View,
    pub(crate) report: Report,
    pub(crate) wall_ms: f64,
}

/// What has happened to a layer that concerns the whole window.
pub(crate) enum LayerNews {
    /// It can be seen for the first time, and this is where it is.
    Appeared(Option<Bounds<f64>>),
    /// It has come so far for the first time.
    Reached(LoadStage),
    /// Its way of drawing was let down by its device: what happened, in a sentence.
    FellBack(String),
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
        services: &Arc<dyn AppServices>,
        method: &str,
        options: SceneOptions,
        wake: &Wake,
    ) -> Self {
        Self {
            loader: Some(Loader::start(
                Arc::clone(services),
                path.clone(),
                None,
                options.clone(),
                Arc::clone(wake),
            )),
            renderer: Renderer::start(Arc::clone(services), method, Arc::clone(wake)),
            path,
            options,
            is_visible: true,
            document: None,
            away: Away::default(),
            findings: None,
            overlay: Overlay::default(),
            trouble: None,
            shown: None,
            checking: None,
            coloring: None,
            selecting: None,
            owes_scene: false,
            asked: None,
            journal: Journal::default(),
            drops_changes: false,
            is_read_again: false,
            is_saving: false,
            written: None,
        }
    }

    /// The file's name.
    pub(crate) fn name(&self) -> String {
        let name = self.path.file_name().unwrap_or(self.path.as_os_str());
        name.to_string_lossy().into_owned()
    }

    /// Whether there is, or may be, more than its file has.
    pub(crate) fn is_changed(&self) -> bool {
        let is_changed = |document: &Arc<Document>| document.is_changed();
        let may_be = self.away.is_at_work() || self.is_saving;
        self.document.as_ref().is_some_and(is_changed) || may_be
    }

    /// Whether nothing is being done, and what was last asked for is shown.
    pub(crate) fn is_settled(&self) -> bool {
        let is_shown = |shot: &Shot| self.shown.as_ref().is_some_and(|s| s.view == shot.view);
        let is_drawn = self.asked.as_ref().is_none_or(is_shown) && !self.renderer.is_busy();
        let is_over = is_drawn && !self.overlay.is_at_work();
        !self.is_busy() && self.document.is_some() && is_over
    }

    /// Whether there is a picture of it, or a reason why there is none.
    pub(crate) fn has_settled(&self) -> bool {
        self.shown.is_some() || self.trouble.is_some()
    }

    /// Whether the file is being read, or looked through.
    #[cfg(test)]
    pub(crate) fn is_reading(&self) -> bool {
        self.loader.is_some()
    }

    /// The load under way, if it is waited for.
    pub(crate) fn load(&self) -> Option<&Job> {
        let loader = self.loader.as_ref()?;
        let is_first = self.document.is_none() && !self.away.is_at_work();
        (is_first || self.is_recovering()).then(|| loader.load())
    }

    /// Whether work that was found is being done again.
    pub(crate) fn is_recovering(&self) -> bool {
        let loader = self.loader.as_ref();
        self.has_found_work() && loader.is_some_and(Loader::is_recovering)
    }

    pub(crate) fn cancel_load(&mut self) {
        (self.loader, self.is_read_again) = (None, false);
        if self.document.is_none() {
            self.trouble = Some("loading was cancelled".into());
        }
    }

    /// Reads the file again. The old layout stays until the new one is there, and for good if it has changes by
    /// then that are not to be dropped.
    pub(crate) fn reload(
        &mut self,
        services: &Arc<dyn AppServices>,
        options: SceneOptions,
        drops_changes: bool,
        wake: &Wake,
    ) {
        let (services, wake) = (Arc::clone(services), Arc::clone(wake));
        self.drops_changes = drops_changes;
        (self.is_read_again, self.written) = (true, None);
        self.options = options.clone();
        let path = self.path.clone();
        self.loader = Some(Loader::start(services, path, None, options, wake));
    }

    pub(crate) fn set_method(&mut self, name: &str) {
        self.renderer.set_method(name);
    }

    /// The document, to be changed on the window's thread, once nothing looks at it any more.
    pub(crate) fn document_mut(&mut self) -> Option<&mut Document> {
        // If it broke down, that was shown.
        let _ = self.overlay.give_up().map(Task::wait);
        Arc::get_mut(self.document.as_mut()?)
    }

    /// Has the renderer draw the document's scene as it is now.
    pub(crate) fn send_scene(&mut self) {
        if let Some(document) = &self.document {
            self.renderer.set_scene(Arc::new(document.scene().clone()));
        } else {
            self.owes_scene = true;
        }
    }

    /// Asks for a picture, unless it was already asked for or is there.
    pub(crate) fn ask(&mut self, shot: Shot) {
        if self.asked != Some(shot) {
            self.renderer.ask(shot);
            self.asked = Some(shot);
        }
    }

    /// Takes what the threads have brought.
    pub(crate) fn poll(
        &mut self,
        ctx: &Context,
        services: &Arc<dyn AppServices>,
        wake: &Wake,
    ) -> Vec<LayerNews> {
        let mut news = Vec::new();
        self.overlay.poll(Duration::ZERO);
        news.extend(self.take_back(Duration::ZERO, wake));
        news.extend(self.record());
        news.extend(self.take_answers(wake));
        news.extend(self.take_findings());
        if self.has_settled()
            && let Some(loader) = &mut self.loader
        {
            loader.go_on();
        }
        if !self.away.is_at_work() {
            let loaded: Vec<Loaded> = self.loader.iter().flat_map(Loader::news).collect();
            for piece in loaded {
                self.take(piece, &mut news);
            }
        }
        loop {
            match self.renderer.outcome() {
                Ok(Outcome::Picture(picture)) => {
                    if self.shown.is_none() {
                        news.push(LayerNews::Reached(LoadStage::Shown));
                    }
                    self.show(ctx, *picture);
                }
                Ok(Outcome::NeedsScene) => self.send_scene(),
                Ok(Outcome::FellBack(why)) => news.push(LayerNews::FellBack(why)),
                Ok(Outcome::Failed(why)) => self.trouble = Some(why),
                Err(TryRecvError::Empty) => return news,
                Err(TryRecvError::Disconnected) => {
                    let name = self.name();
                    news.push(LayerNews::FellBack(format!(
                        "drawing {name} stopped; it goes on by {FALLBACK}"
                    )));
                    self.renderer
                        .restart(Arc::clone(services), FALLBACK, Arc::clone(wake));
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
                    news.push(LayerNews::Reached(LoadStage::Read));
                    news.push(LayerNews::Appeared(scene.bounds()));
                    self.renderer.set_scene(scene);
                }
            }
            Loaded::Document(document, done) => self.take_document(*document, done, news),
            Loaded::Findings(findings) => {
                self.findings = Some(findings);
                news.push(LayerNews::Reached(LoadStage::Checked));
                self.loader = None;
            }
            Loaded::Failed(trouble) => {
                (self.loader, self.is_read_again) = (None, false);
                if self.document.is_none() {
                    self.trouble = Some(trouble.to_string());
                } else {
                    news.push(LayerNews::Notice(trouble.to_string()));
                }
            }
        }
    }

    /// Takes a document that was read, unless there is another one with changes.
    fn take_document(
        &mut self,
        mut document: Document,
        done: Option<ReplayProgress>,
        news: &mut Vec<LayerNews>,
    ) {
        self.is_read_again = false;
        if self.is_changed() && !self.drops_changes {
            self.loader = None;
            news.push(LayerNews::Notice(changed_on_disk(&self.name())));
            return;
        }
        match done {
            Some(done) => news.extend(self.go_on(done)),
            None => {
                if !self.has_found_work() {
                    // What was done with the layout before goes with it.
                    self.drop_journal();
                }
                self.journal = Journal::of(&self.path);
                let aside = self.journal.said_of_aside(&self.path);
                news.extend(aside.map(LayerNews::Notice));
            }
        }
        // What was done again before is in the scene that the renderer gets.
        let orders = self.renderer.orders();
        document.on_edit(move |edit| orders.edit(edit.clone()));
        (self.overlay, self.away) = Default::default();
        let is_again = self.document.replace(Arc::new(document)).is_some();
        (self.findings, self.checking) = (None, None);
        if is_again || std::mem::take(&mut self.owes_scene) {
            self.send_scene();
        }
        news.push(LayerNews::Reached(LoadStage::Editable));
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
        let number = self.shown.as_ref().map_or(0, |shown| shown.number) + 1;
        let texture = match self.shown.take() {
            Some(mut shown) => {
                shown.texture.set(image, options);
                shown.texture
            }
            None => ctx.load_texture(self.name(), image, options),
        };
        self.shown = Some(Shown {
            texture,
            number,
            view: shot.view,
            report,
            wall_ms,
        });
    }

    /// Whether a file is this one.
    pub(crate) fn is_at(&self, path: &Path) -> bool {
        self.path == path
    }
}

/// What to say of a file that others have changed, and the person too.
pub(crate) fn changed_on_disk(name: &str) -> String {
    format!("{name} has changed on disk; File > Read again takes it and drops your changes")
}
