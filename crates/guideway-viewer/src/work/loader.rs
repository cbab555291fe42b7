use std::convert::Infallible;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender, TryIter};
use std::thread;
use std::time::Duration;

use guideway_document::{Document, ReplayProgress};
use guideway_layout::CheckOptions;
use guideway_scene::{Scene, SceneOptions};

use super::Wake;
use super::findings::Findings;
use super::recovery::Found;
use crate::services::{AppServices, Job, WINDOW_ERROR};
use guideway_layout::UserError;

/// How long the first picture may have the processor to itself.
const PATIENCE: Duration = Duration::from_secs(1);

/// A file being read.
pub(crate) struct Loader {
    load: Arc<Job>,
    news: Receiver<Loaded>,
    /// Held until there is a first picture.
    has_no_picture: Option<Sender<Infallible>>,
    is_recovering: bool,
}

/// What a loader has, piece by piece in this order.
pub(crate) enum Loaded {
    /// It can be drawn.
    Scene(Arc<Scene>),
    /// It can be edited; how much of the work that was found is done again.
    Document(Box<Document>, Option<ReplayProgress>),
    /// What is odd in it.
    Findings(Findings),
    /// There is nothing, and this is why.
    Failed(UserError),
}

impl Loader {
    /// Reads a file, or else the one that work was found with, to do that again: it is drawn when all is done.
    pub(crate) fn start(
        services: Arc<dyn AppServices>,
        path: PathBuf,
        found: Option<Found>,
        options: SceneOptions,
        wake: Wake,
    ) -> Self {
        let load = Arc::<Job>::default();
        let (sender, news) = mpsc::channel();
        let (has_no_picture, picture) = mpsc::channel();
        let is_recovering = found.is_some();
        let watched = Arc::clone(&load);
        thread::spawn(move || {
            let tell = |piece| {
                // Nobody hears it if the file was closed in the meantime.
                let _ = sender.send(piece);
                wake();
            };
            let path = found.as_ref().map_or(&path, |found| &found.file);
            let scene = match read(&*services, path, &options, &watched) {
                Ok(scene) => scene,
                Err(trouble) => return tell(Loaded::Failed(trouble)),
            };
            if found.is_none() {
                // Found here, and not when the window asks where to look.
                scene.bounds();
                tell(Loaded::Scene(Arc::new(scene.clone())));
                // It ends as an error, for nothing is ever sent.
                let _ = picture.recv_timeout(PATIENCE);
            }
            let mut document = Document::from_scene(scene);
            let done = found.map(|found| found.do_again(&mut document, &watched));
            match done.transpose() {
                Ok(done) => {
                    let snapshot = document.snapshot();
                    tell(Loaded::Document(Box::new(document), done));
                    let findings = Findings::of(&snapshot, &CheckOptions::default());
                    tell(Loaded::Findings(findings));
                }
                Err(trouble) => tell(Loaded::Failed(trouble)),
            }
        });
        Self {
            load,
            news,
            has_no_picture: Some(has_no_picture),
            is_recovering,
        }
    }

    /// Whether it does work again that was found.
    pub(crate) fn is_recovering(&self) -> bool {
        self.is_recovering
    }

    /// There is a picture of it: what takes long is in nobody's way any more.
    pub(crate) fn go_on(&mut self) {
        self.has_no_picture = None;
    }

    pub(crate) fn load(&self) -> &Job {
        &self.load
    }

    pub(crate) fn news(&self) -> TryIter<'_, Loaded> {
        self.news.try_iter()
    }
}

impl Drop for Loader {
    fn drop(&mut self) {
        self.load.cancel();
    }
}

fn read(
    services: &dyn AppServices,
    path: &Path,
    options: &SceneOptions,
    job: &Job,
) -> Result<Scene, UserError> {
    let layout = Arc::new(services.read_layout(path, job)?);
    // A color that another file has columns for need not be one of this file.
    let scene = Scene::new(Arc::clone(&layout), options);
    scene
        .or_else(|_| Scene::new(layout, &without_column(options)))
        .map_err(|error| UserError {
            code: WINDOW_ERROR,
            message: error.to_string(),
            remedy: "Open the file again".into(),
        })
}

fn without_column(options: &SceneOptions) -> SceneOptions {
    SceneOptions {
        color_by: None,
        ..options.clone()
    }
}
