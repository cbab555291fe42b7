use std::convert::Infallible;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender, TryIter};
use std::thread;
use std::time::Duration;

use guideway_document::Document;
use guideway_layout::{CheckOptions, Diagnostics, Layout, check};
use guideway_scene::{Scene, SceneOptions};

use super::Wake;
use crate::host::{Host, Job, Trouble};

/// How long the first picture may have the processor to itself.
const PATIENCE: Duration = Duration::from_secs(1);

/// A file being read.
pub(crate) struct Loader {
    load: Arc<Job>,
    news: Receiver<Loaded>,
    /// Held until there is a first picture.
    has_no_picture: Option<Sender<Infallible>>,
}

/// What a loader has, piece by piece in this order.
pub(crate) enum Loaded {
    /// It can be drawn.
    Scene(Arc<Scene>),
    /// It can be edited.
    Document(Box<Document>),
    /// What is odd in it.
    Findings(Diagnostics),
    /// There is nothing, and this is why.
    Failed(Trouble),
}

impl Loader {
    pub(crate) fn start(
        host: Arc<dyn Host>,
        path: PathBuf,
        options: SceneOptions,
        wake: Wake,
    ) -> Self {
        let load = Arc::<Job>::default();
        let (sender, news) = mpsc::channel();
        let (has_no_picture, picture) = mpsc::channel();
        let watched = Arc::clone(&load);
        thread::spawn(move || {
            let tell = |piece| {
                // Nobody hears it if the file was closed in the meantime.
                let _ = sender.send(piece);
                wake();
            };
            let layout = match host.open(&path, &watched) {
                Ok(layout) => layout,
                Err(trouble) => return tell(Loaded::Failed(trouble)),
            };
            let layout = Arc::new(layout);
            // A colour that another file has columns for need not be one of this file.
            let scene = Scene::new(Arc::clone(&layout), &options)
                .or_else(|_| Scene::new(Arc::clone(&layout), &without_column(&options)));
            match scene {
                Ok(scene) => {
                    // Found here, and not when the window asks where to look.
                    scene.bounds();
                    tell(Loaded::Scene(Arc::new(scene.clone())));
                    // It ends as an error, for nothing is ever sent.
                    let _ = picture.recv_timeout(PATIENCE);
                    tell(Loaded::Document(Box::new(Document::from_scene(scene))));
                    tell(Loaded::Findings(findings(&layout)));
                }
                Err(error) => tell(Loaded::Failed(Trouble {
                    message: error.to_string(),
                    remedy: "Open the file again".into(),
                })),
            }
        });
        Self {
            load,
            news,
            has_no_picture: Some(has_no_picture),
        }
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

/// What the reader found, and what is odd in the layout as it is.
pub(crate) fn findings(layout: &Layout) -> Diagnostics {
    let mut found = layout.diagnostics.clone();
    found.append(check(layout, &CheckOptions::default()));
    found
}

fn without_column(options: &SceneOptions) -> SceneOptions {
    SceneOptions {
        color_by: None,
        ..options.clone()
    }
}
