use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use guideway_envelope::EnvelopeSource;
use guideway_layout::Layout;
use guideway_scene::{Frame, Method, View};

use crate::services::{AppServices, FloorPlan, Job, MethodChoice, PictureRequest, WINDOW_ERROR};
use crate::tests::table::Table;
use guideway_layout::UserError;

/// A folder with one file, replaced as a whole like any other that is saved. The file itself holds a number; what it
/// stands for is kept here.
pub(super) struct Shelf {
    pub(super) table: Arc<Table>,
    pub(super) file: PathBuf,
    _folder: tempfile::TempDir,
    layouts: Mutex<HashMap<String, Layout>>,
}

impl Shelf {
    pub(super) fn with(layout: &Layout) -> Arc<Self> {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        let shelf = Self {
            table: Table::with([]),
            file: folder.path().join("site.arrow"),
            _folder: folder,
            layouts: Mutex::default(),
        };
        shelf.put(layout);
        Arc::new(shelf)
    }

    /// Replaces the file.
    pub(super) fn put(&self, layout: &Layout) {
        let mut layouts = self
            .layouts
            .lock()
            .expect("no test panics while it holds this");
        // Only what a file or its other name still holds can be asked for again.
        let held = self
            .names()
            .filter_map(|path| fs::read_to_string(path).ok());
        let held: Vec<String> = held.collect();
        let next = layouts
            .keys()
            .filter_map(|key| key.parse::<u64>().ok())
            .max();
        let key = next.map_or(0, |last| last + 1).to_string();
        layouts.retain(|key, _| held.contains(key));
        layouts.insert(key.clone(), layout.clone());
        let new = self.file.with_extension("new");
        let written = fs::write(&new, key).and_then(|()| fs::rename(&new, &self.file));
        written.expect("there is room for a number");
    }

    /// What a file holds.
    pub(super) fn layout(&self, path: &Path) -> Option<Layout> {
        let key = fs::read_to_string(path).ok()?;
        let layouts = self
            .layouts
            .lock()
            .expect("no test panics while it holds this");
        layouts.get(&key).cloned()
    }

    fn names(&self) -> impl Iterator<Item = PathBuf> {
        let folder = self
            .file
            .parent()
            .and_then(|folder| fs::read_dir(folder).ok());
        folder
            .into_iter()
            .flatten()
            .flatten()
            .map(|entry| entry.path())
    }
}

impl AppServices for Shelf {
    fn read_layout(&self, path: &Path, _job: &Job) -> Result<Layout, UserError> {
        self.layout(path).ok_or_else(|| UserError {
            code: WINDOW_ERROR,
            message: "there is no such file".into(),
            remedy: "Look elsewhere".into(),
        })
    }

    fn check_save_in_place(&self, layout: &Layout, file: &Path) -> Result<(), UserError> {
        self.table.check_save_in_place(layout, file)
    }

    fn save_layout(&self, layout: &Layout, path: &Path) -> Result<Vec<String>, UserError> {
        if *self
            .table
            .is_full
            .lock()
            .expect("no test panics while it holds this")
            || path != self.file
        {
            return Err(UserError {
                code: WINDOW_ERROR,
                message: "the disk is full".into(),
                remedy: "Look elsewhere".into(),
            });
        }
        self.put(layout);
        Ok(Vec::new())
    }

    fn export_png(
        &self,
        export: &PictureRequest,
        method: &str,
        job: &Job,
        path: &Path,
    ) -> Result<(), UserError> {
        self.table.export_png(export, method, job, path)
    }

    fn render(&self, export: &PictureRequest, method: &str) -> Result<Frame, UserError> {
        self.table.render(export, method)
    }

    fn export_svg(&self, export: &PictureRequest, path: &Path) -> Result<(), UserError> {
        self.table.export_svg(export, path)
    }

    fn read_floor_plan(&self, plan: &str) -> Result<Arc<dyn FloorPlan>, UserError> {
        self.table.read_floor_plan(plan)
    }

    fn render_swept_areas(
        &self,
        layout: &Layout,
        rows: &[u32],
        vehicle: EnvelopeSource,
        view: &View,
    ) -> Result<Frame, UserError> {
        self.table.render_swept_areas(layout, rows, vehicle, view)
    }

    fn methods(&self) -> Vec<MethodChoice> {
        self.table.methods()
    }

    fn start_method(&self, name: &str) -> Result<Box<dyn Method>, UserError> {
        self.table.start_method(name)
    }
}
