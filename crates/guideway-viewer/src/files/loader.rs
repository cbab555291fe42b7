//! Reads or makes one layout on its own thread: scene, then document, then findings.

use std::convert::Infallible;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender, TryIter};
use std::time::Duration;

use guideway_document::{Document, ReplayProgress};
use guideway_layout::{CheckOptions, Layout, UserError};
use guideway_scene::{Scene, SceneOptions};

use super::draft_file::write_draft;
use super::watcher::Stamp;
use crate::background::RepaintHandle;
use crate::editing::{Findings, UnsavedWork};
use crate::language::{say, start_thread, t};
use crate::services::{AppServices, Job, WINDOW_ERROR};

/// Longest time that the loader waits for the first picture before it builds the document: until
/// then the render method gets all cores.
const FIRST_PICTURE_WAIT: Duration = Duration::from_secs(1);

/// A layout that is in no file yet.
#[derive(Clone, Debug)]
pub(crate) enum NewLayout {
    /// The thread that loads it makes it.
    By(fn(&dyn AppServices) -> Result<Layout, UserError>),
    Ready(Arc<Layout>),
    /// Left by an earlier run as this draft.
    Draft(PathBuf),
}

impl NewLayout {
    fn layout(&self, services: &dyn AppServices, job: &Job) -> Result<Arc<Layout>, UserError> {
        match self {
            Self::Draft(path) => services.read_layout(path, job).map(Arc::new),
            Self::By(make) => make(services).map(Arc::new),
            Self::Ready(layout) => Ok(Arc::clone(layout)),
        }
    }
}

/// The origin of a layout.
#[derive(Clone, Debug)]
pub(crate) enum Source {
    File(PathBuf),
    /// No file yet, and the draft to write.
    New(NewLayout, Option<PathBuf>),
}

/// The thread that reads a file.
pub(crate) struct Loader {
    job: Arc<Job>,
    pieces: Receiver<Loaded>,
    /// Dropped when there is a first picture, which ends the loader's wait.
    first_picture: Option<Sender<Infallible>>,
    is_recovering: bool,
}

/// The pieces that a loader sends, in this order.
pub(crate) enum Loaded {
    /// The scene, ready to render.
    Scene(Arc<Scene>),
    /// The document, ready to edit, how much unsaved work was replayed on it, and the state of its
    /// file before it was read.
    Document(Box<Document>, Option<ReplayProgress>, Stamp),
    /// The result of the check.
    Findings(Findings),
    /// The file cannot be read.
    Failed(UserError),
}

impl Loader {
    /// Reads a file. With unsaved work it reads the base of that work instead and sends no scene:
    /// the old picture stays until the work is replayed.
    pub(crate) fn start(
        services: Arc<dyn AppServices>,
        source: Source,
        unsaved: Option<UnsavedWork>,
        options: SceneOptions,
        repaint: RepaintHandle,
    ) -> Self {
        let job = Arc::<Job>::default();
        let (sender, pieces) = mpsc::channel();
        let (first_picture, picture_wait) = mpsc::channel();
        let is_recovering = unsaved.is_some();
        let watched = Arc::clone(&job);
        let failed = sender.clone();
        let started = start_thread(move || {
            let send = |piece| {
                // The receiver is gone if the file was closed in the meantime.
                let _ = sender.send(piece);
                repaint();
            };
            let stamp = match &source {
                Source::File(path) => services.file_stamp(path),
                Source::New(..) => None,
            };
            let base = unsaved.as_ref().map(|work| Source::File(work.base.clone()));
            let source = base.unwrap_or(source);
            let scene = match read(&*services, &source, &options, &watched) {
                Ok(scene) => scene,
                Err(error) => return send(Loaded::Failed(error)),
            };
            if unsaved.is_none() {
                // Computed here, so that the window's thread finds the bounds cached.
                scene.bounds();
                send(Loaded::Scene(Arc::new(scene.clone())));
                // Nothing is ever sent: the wait ends by disconnection or timeout.
                let _ = picture_wait.recv_timeout(FIRST_PICTURE_WAIT);
            }
            let mut document = Document::from_scene(scene);
            let progress = unsaved.map(|work| work.replay(&mut document, &watched));
            match progress.transpose() {
                Ok(progress) => {
                    let snapshot = document.snapshot();
                    send(Loaded::Document(Box::new(document), progress, stamp));
                    let findings = Findings::of(&snapshot, &CheckOptions::default());
                    send(Loaded::Findings(findings));
                }
                Err(error) => send(Loaded::Failed(error)),
            }
        });
        if let Err(error) = started {
            let message = say!("cannot start a thread that reads the file: {error}", error);
            let remedy = t("Close some programs or files, and open it again");
            let error = UserError::new(WINDOW_ERROR, message, remedy);
            // The receiver is below.
            let _ = failed.send(Loaded::Failed(error));
        }
        Self {
            job,
            pieces,
            first_picture: Some(first_picture),
            is_recovering,
        }
    }

    /// Returns `true` if it replays unsaved work.
    pub(crate) fn is_recovering(&self) -> bool {
        self.is_recovering
    }

    /// Ends the wait for the first picture.
    pub(crate) fn continue_after_first_picture(&mut self) {
        self.first_picture = None;
    }

    pub(crate) fn job(&self) -> &Job {
        &self.job
    }

    /// The pieces that have arrived.
    pub(crate) fn pieces(&self) -> TryIter<'_, Loaded> {
        self.pieces.try_iter()
    }
}

impl Drop for Loader {
    fn drop(&mut self) {
        self.job.cancel();
    }
}

fn read(
    services: &dyn AppServices,
    source: &Source,
    options: &SceneOptions,
    job: &Job,
) -> Result<Scene, UserError> {
    let layout = match source {
        Source::File(path) => Arc::new(services.read_layout(path, job)?),
        Source::New(new, draft) => {
            let layout = new.layout(services, job)?;
            if let Some(draft) = draft {
                write_draft(services, &layout, draft);
            }
            layout
        }
    };
    // The color column may exist in another open file only.
    let scene = Scene::new(Arc::clone(&layout), options);
    Ok(scene.or_else(|_| Scene::new(layout, &without_column(options)))?)
}

fn without_column(options: &SceneOptions) -> SceneOptions {
    SceneOptions {
        color_by: None,
        ..options.clone()
    }
}
