//! Services of the soak test: one real file that stands for a layout in memory.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use guideway_compose::{FloorPlan, VectorFormat};
use guideway_envelope::EnvelopeSource;
use guideway_layout::Layout;
use guideway_scene::{Frame, Method, View};

use crate::services::{
    AppServices, Job, LostPart, MethodChoice, PictureRequest, Saved, WINDOW_ERROR,
};
use crate::tests::services::TestServices;
use guideway_layout::UserError;

/// A folder with one file, which saves replace atomically. The file holds a key; the layout of each
/// key is in memory.
pub(super) struct FileStore {
    pub(super) disk: Arc<TestServices>,
    pub(super) file: PathBuf,
    _folder: tempfile::TempDir,
    layouts: Mutex<HashMap<String, Layout>>,
}

impl FileStore {
    pub(super) fn with(layout: &Layout) -> Arc<Self> {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        let store = Self {
            disk: TestServices::with([]),
            file: folder.path().join("site.arrow"),
            _folder: folder,
            layouts: Mutex::default(),
        };
        store.put(layout);
        Arc::new(store)
    }

    /// Replaces the file by one for this layout.
    pub(super) fn put(&self, layout: &Layout) {
        let mut layouts = self
            .layouts
            .lock()
            .expect("no test panics while it holds the lock");
        // Drops layouts whose keys no file holds.
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

    /// The layout of a file.
    pub(super) fn layout(&self, path: &Path) -> Option<Layout> {
        let key = fs::read_to_string(path).ok()?;
        let layouts = self
            .layouts
            .lock()
            .expect("no test panics while it holds the lock");
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

impl AppServices for FileStore {
    fn read_layout(&self, path: &Path, _job: &Job) -> Result<Layout, UserError> {
        self.layout(path).ok_or_else(|| UserError {
            code: WINDOW_ERROR,
            message: "no such file".into(),
            remedy: "Try another one".into(),
        })
    }

    fn check_save_in_place(&self, layout: &Layout, file: &Path) -> Result<(), UserError> {
        self.disk.check_save_in_place(layout, file)
    }

    fn save_layout(
        &self,
        layout: &Layout,
        path: &Path,
        _accepts: &dyn Fn(&[LostPart]) -> bool,
    ) -> Result<Saved, UserError> {
        if *self
            .disk
            .is_full
            .lock()
            .expect("no test panics while it holds the lock")
            || path != self.file
        {
            return Err(UserError {
                code: WINDOW_ERROR,
                message: "the disk is full".into(),
                remedy: "Try another one".into(),
            });
        }
        self.put(layout);
        Ok(Saved::Written(Vec::new()))
    }

    fn read_project(&self, path: &Path) -> Result<String, UserError> {
        self.disk.read_project(path)
    }

    fn write_project(&self, path: &Path, text: &str) -> Result<(), UserError> {
        self.disk.write_project(path, text)
    }

    fn export_png(
        &self,
        export: &PictureRequest,
        method: &str,
        job: &Job,
        path: &Path,
    ) -> Result<(), UserError> {
        self.disk.export_png(export, method, job, path)
    }

    fn render(&self, export: &PictureRequest, method: &str) -> Result<Frame, UserError> {
        self.disk.render(export, method)
    }

    fn export_vector(
        &self,
        export: &PictureRequest,
        format: VectorFormat,
        path: &Path,
    ) -> Result<(), UserError> {
        self.disk.export_vector(export, format, path)
    }

    fn read_floor_plan(&self, plan: &str) -> Result<FloorPlan, UserError> {
        self.disk.read_floor_plan(plan)
    }

    fn render_swept_areas(
        &self,
        layout: &Layout,
        rows: &[u32],
        vehicle: EnvelopeSource,
        view: &View,
    ) -> Result<Frame, UserError> {
        self.disk.render_swept_areas(layout, rows, vehicle, view)
    }

    fn methods(&self) -> Vec<MethodChoice> {
        self.disk.methods()
    }

    fn start_method(&self, name: &str) -> Result<Box<dyn Method>, UserError> {
        self.disk.start_method(name)
    }
}
