//! Layouts that wait for a name that no file has, and for the folder of their draft. Both are found
//! beside the window, because a disk may be slow or gone.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use guideway_scene::SceneOptions;

use super::draft_file::{DEFAULT_EXTENSION, DraftFile};
use super::layer_context::LayerContext;
use super::loader::NewLayout;
use crate::background::BackgroundTask;
use crate::services::AppServices;

/// A layout to open without a file.
pub(super) struct NewLayoutRequest {
    /// Begin of its suggested name.
    pub(super) stem: String,
    pub(super) new: NewLayout,
    pub(super) method: String,
    pub(super) options: SceneOptions,
}

/// The suggested name of a layout, and its draft where drafts are kept.
pub(super) type NewPlace = (PathBuf, Option<DraftFile>);

/// The layouts that wait, the first of which is being named.
#[derive(Default)]
pub(super) struct NewLayouts {
    waiting: VecDeque<NewLayoutRequest>,
    task: Option<BackgroundTask<NewPlace>>,
}

impl NewLayouts {
    /// Appends a layout.
    pub(super) fn push(&mut self, request: NewLayoutRequest) {
        self.waiting.push_back(request);
    }

    pub(super) fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Starts to name the first layout unless that is under way. Its name is none of `taken`.
    pub(super) fn start(&mut self, taken: Vec<PathBuf>, context: &LayerContext) {
        let Some(request) = self.waiting.front().filter(|_| self.task.is_none()) else {
            return;
        };
        let (stem, services) = (request.stem.clone(), Arc::clone(&context.services));
        self.task = Some(BackgroundTask::start(&context.repaint, move || {
            let path = free_name(&stem, |path| taken.iter().any(|t| t == path), &*services);
            let state = draft_state(&*services);
            let draft = state.and_then(|state| DraftFile::create(&state, &path));
            (path, draft)
        }));
    }

    /// Takes the first layout once it has a name.
    pub(super) fn poll(&mut self) -> Option<(NewLayoutRequest, NewPlace)> {
        let place = self.task.as_ref()?.result()?;
        self.task = None;
        let request = self.waiting.pop_front()?;
        // Without a thread, the name is a suggestion that a save checks.
        let place = place.unwrap_or_else(|_| (name(&request.stem), None));
        Some((request, place))
    }

    /// Puts a layout back whose name has been taken meanwhile.
    pub(super) fn put_back(&mut self, request: NewLayoutRequest) {
        self.waiting.push_front(request);
    }
}

/// The first name that begins with `stem`, is not taken, and that no file on disk has.
pub(super) fn free_name(
    stem: &str,
    is_taken: impl Fn(&Path) -> bool,
    services: &dyn AppServices,
) -> PathBuf {
    let numbered = (2..).map(|number: u64| name(&format!("{stem}-{number}")));
    let mut names = std::iter::once(name(stem)).chain(numbered);
    let is_free = |path: &PathBuf| !is_taken(path) && services.file_stamp(path).is_none();
    names.find(is_free).unwrap_or_default()
}

/// The state folder, if it keeps drafts.
pub(super) fn draft_state(services: &dyn AppServices) -> Option<PathBuf> {
    services
        .state_folder()
        .filter(|_| services.keeps_journals())
}

fn name(stem: &str) -> PathBuf {
    PathBuf::from(format!("{stem}.{DEFAULT_EXTENSION}"))
}
