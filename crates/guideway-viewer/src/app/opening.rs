//! Opens files of any kind: at the start, dropped on the window, or named by the user.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use guideway_compose::FloorPlanKind;

use super::state::App;
use crate::LaunchOptions;
use crate::background::RepaintHandle;
use crate::project::is_project;
use crate::services::AppServices;

impl App {
    /// Starts the application and begins to read the files of `options`. Background threads call
    /// `repaint`.
    pub(crate) fn launch(
        repaint: RepaintHandle,
        services: Arc<dyn AppServices>,
        options: LaunchOptions,
    ) -> Self {
        let mut app = Self::new(repaint, services, options.method);
        let (method, scene) = (app.methods.name(), app.settings.scene_options());
        app.files.open_left_drafts(method, &scene);
        for file in options.files {
            app.open_any(file);
        }
        // A project may have a floor plan of its own.
        match app.project_reader.is_busy() {
            true => app.project_reader.plan_after = options.floor_plan,
            false if !options.floor_plan.is_empty() => app.show_floor_plan(&options.floor_plan),
            false => {}
        }
        app
    }

    /// Opens a layout or a project.
    pub(crate) fn open_any(&mut self, path: PathBuf) {
        match is_project(&path) {
            true => self.open_project(path),
            false if self.project_reader.is_busy() => self.project_reader.files_after.push(path),
            false => self.open(path),
        }
    }

    /// Opens a dropped layout. A dropped map of ROS, image or PDF becomes the
    /// floor plan.
    pub(super) fn open_dropped(&mut self, file: &Path) {
        match FloorPlanKind::of_file(file) {
            FloorPlanKind::Layout => self.open_any(file.to_path_buf()),
            FloorPlanKind::RosMap | FloorPlanKind::Image | FloorPlanKind::PdfPage => {
                self.set_floor_plan_file(file);
            }
        }
    }
}
