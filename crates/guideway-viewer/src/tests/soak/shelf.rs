use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use guideway_layout::Layout;
use guideway_scene::{Frame, Method, View};

use crate::host::{Export, FloorPlan, Host, Job, MethodChoice, Trouble};
use crate::tests::table::Table;

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

impl Host for Shelf {
    fn open(&self, path: &Path, _job: &Job) -> Result<Layout, Trouble> {
        self.layout(path).ok_or_else(|| Trouble {
            message: "there is no such file".into(),
            remedy: "Look elsewhere".into(),
        })
    }

    fn check_in_place(&self, layout: &Layout, file: &Path) -> Result<(), Trouble> {
        self.table.check_in_place(layout, file)
    }

    fn save(&self, layout: &Layout, path: &Path) -> Result<Vec<String>, Trouble> {
        if *self
            .table
            .is_full
            .lock()
            .expect("no test panics while it holds this")
            || path != self.file
        {
            return Err(Trouble {
                message: "the disk is full".into(),
                remedy: "Look elsewhere".into(),
            });
        }
        self.put(layout);
        Ok(Vec::new())
    }

    fn save_picture(
        &self,
        export: &Export,
        method: &str,
        job: &Job,
        path: &Path,
    ) -> Result<(), Trouble> {
        self.table.save_picture(export, method, job, path)
    }

    fn picture(&self, export: &Export, method: &str) -> Result<Frame, Trouble> {
        self.table.picture(export, method)
    }

    fn save_drawing(&self, export: &Export, path: &Path) -> Result<(), Trouble> {
        self.table.save_drawing(export, path)
    }

    fn floor_plan(&self, plan: &str) -> Result<Arc<dyn FloorPlan>, Trouble> {
        self.table.floor_plan(plan)
    }

    fn swept(
        &self,
        layout: &Layout,
        rows: &[u32],
        vehicle: &str,
        view: &View,
    ) -> Result<Frame, Trouble> {
        self.table.swept(layout, rows, vehicle, view)
    }

    fn methods(&self) -> Vec<MethodChoice> {
        self.table.methods()
    }

    fn method(&self, name: &str) -> Result<Box<dyn Method>, Trouble> {
        self.table.method(name)
    }
}
