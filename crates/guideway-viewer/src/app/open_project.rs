//! The project that is open: its file, and the parts that wait for files to arrive; and the project
//! that is being read.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use guideway_spline::Point;

use crate::background::BackgroundTask;
use crate::project::{Project, absolute_from};
use crate::services::AppServices;

/// The open project, if any.
#[derive(Default)]
pub(super) struct OpenProject {
    /// The file that the project was read from or written to.
    pub(super) path: Option<PathBuf>,
    /// Center and scale to show instead of the bounds of the first file.
    pub(super) view: Option<(Point<f64>, f64)>,
    /// Level to show once the active file is loaded.
    pub(super) level: Option<String>,
}

/// The project that is being read, if any.
#[derive(Default)]
pub(super) struct ProjectReader {
    task: Option<(PathBuf, BackgroundTask<Result<ReadProject, String>>)>,
    /// Files to open after it, because it closes those that are open.
    pub(super) files_after: Vec<PathBuf>,
    /// Floor plan to show in place of its own; empty for none.
    pub(super) plan_after: String,
}

/// A project, and what the disk has of its files.
pub(super) struct ReadProject {
    pub(super) project: Project,
    /// Files of the project that do not exist.
    pub(super) missing: HashSet<PathBuf>,
}

impl ReadProject {
    /// Reads a project and looks for its files.
    ///
    /// # Errors
    /// When the file cannot be read, or is no project.
    pub(super) fn read(path: &Path, services: &dyn AppServices) -> Result<Self, String> {
        let text = services.read_project(path);
        let project = Project::parse(&text.map_err(|error| error.to_string())?)?;
        let files = project.file.iter().map(|file| &file.path);
        let files = files.chain(project.floor_plan.as_ref().map(|plan| &plan.path));
        let files = files.map(|file| absolute_from(path, file));
        let missing = files.filter(|file| services.file_stamp(file).is_none());
        Ok(Self {
            missing: missing.collect(),
            project,
        })
    }
}

impl ProjectReader {
    pub(super) fn start(
        &mut self,
        path: PathBuf,
        task: BackgroundTask<Result<ReadProject, String>>,
    ) {
        self.task = Some((path, task));
    }

    pub(super) fn is_busy(&self) -> bool {
        self.task.is_some()
    }

    /// Takes the file and the project once it is read.
    pub(super) fn poll(&mut self) -> Option<(PathBuf, Result<ReadProject, String>)> {
        let read = self.task.as_ref()?.1.result()?;
        let (path, _) = self.task.take()?;
        Some((path, read.unwrap_or_else(|error| Err(error.to_string()))))
    }
}
