//! The open files and the active one among them; updates the watcher and the recent files.

use std::path::{Path, PathBuf};

use eframe::egui::Context;
use guideway_document::Document;
use guideway_scene::SceneOptions;
use guideway_spline::Bounds;

use super::draft_file::DraftFile;
use super::layer::Layer;
use super::layer_context::LayerContext;
use super::layer_event::LayerEvent;
use super::loader::NewLayout;
use super::new_layouts::{NewLayoutRequest, NewLayouts, draft_state, free_name};
use super::recent_files::RecentFiles;
use super::save_state::{SavedFile, changed_on_disk, gone_from_disk};
use super::watcher::Watcher;
use crate::language::say;

/// The open files from the top; the active one is edited, and drawn above all.
pub(crate) struct OpenFiles {
    layers: Vec<Layer>,
    active: usize,
    recent: RecentFiles,
    watcher: Watcher,
    /// True if the watcher's list is outdated.
    is_watch_outdated: bool,
    new_layouts: NewLayouts,
    context: LayerContext,
}

impl OpenFiles {
    pub(crate) fn new(context: LayerContext) -> Self {
        Self {
            layers: Vec::new(),
            active: 0,
            recent: RecentFiles::load(context.services.state_folder()),
            watcher: Watcher::start(context.repaint.clone()),
            is_watch_outdated: false,
            new_layouts: NewLayouts::default(),
            context,
        }
    }

    pub(crate) fn layers(&self) -> &[Layer] {
        &self.layers
    }

    pub(crate) fn layers_mut(&mut self) -> &mut [Layer] {
        &mut self.layers
    }

    pub(crate) fn recent(&self) -> &RecentFiles {
        &self.recent
    }

    pub(crate) fn active_index(&self) -> usize {
        self.active
    }

    /// The file that is edited.
    pub(crate) fn active(&self) -> Option<&Layer> {
        self.layers.get(self.active)
    }

    pub(crate) fn active_mut(&mut self) -> Option<&mut Layer> {
        self.layers.get_mut(self.active)
    }

    /// The index of the file at `path`.
    pub(crate) fn index_of(&self, path: &Path) -> Option<usize> {
        self.layers.iter().position(|layer| layer.is_at(path))
    }

    /// The document that is edited, unless it is not loaded or an edit has it.
    pub(crate) fn document(&self) -> Option<&Document> {
        self.active()?.document()
    }

    /// Moves a file in the list; the active one stays active.
    pub(crate) fn move_layer(&mut self, from: usize, to: usize) {
        let count = self.layers.len();
        if from >= count || to >= count {
            return;
        }
        let layer = self.layers.remove(from);
        self.layers.insert(to, layer);
        self.active = match self.active {
            active if active == from => to,
            active if from < active && active <= to => active - 1,
            active if to <= active && active < from => active + 1,
            active => active,
        };
    }

    /// The visible files, from the bottom; the active one is on top.
    pub(crate) fn visible(&self) -> impl Iterator<Item = &Layer> {
        let others = self.layers.iter().enumerate().rev();
        let others = others.filter(|(index, _)| *index != self.active);
        let all = others.map(|(_, layer)| layer).chain(self.active());
        all.filter(|layer| layer.is_visible)
    }

    /// The box around all visible documents.
    pub(crate) fn visible_bounds(&self) -> Option<Bounds<f64>> {
        let bounds = self
            .visible()
            .filter_map(|layer| layer.document()?.bounds());
        bounds.reduce(Bounds::union)
    }

    pub(crate) fn has_changes(&self) -> bool {
        self.layers.iter().any(Layer::is_changed)
    }

    /// Returns `true` if nothing is in progress in any file.
    pub(crate) fn is_settled(&self) -> bool {
        self.new_layouts.is_empty() && self.layers.iter().all(Layer::is_settled)
    }

    /// Edits the next file from now on.
    pub(crate) fn activate_next(&mut self) {
        self.active = (self.active + 1) % self.layers.len().max(1);
    }

    pub(crate) fn activate(&mut self, index: usize) {
        self.active = index.min(self.layers.len().saturating_sub(1));
    }

    /// Opens a file, or activates it if it is open.
    pub(crate) fn open(&mut self, path: PathBuf, method: &str, options: SceneOptions) {
        let is_open = |layer: &Layer| layer.is_at(&path) && !layer.is_untitled();
        if let Some(index) = self.layers.iter().position(is_open) {
            self.active = index;
            return;
        }
        let layer = Layer::open(path, (None, None), method, options, &self.context);
        self.push(layer);
    }

    /// Opens a layout that has no file yet, once it has a name. The name begins with `stem`, with a
    /// number behind it where an open file or one on disk has that name.
    pub(crate) fn open_untitled(
        &mut self,
        stem: &str,
        new: NewLayout,
        method: &str,
        options: SceneOptions,
    ) {
        self.new_layouts.push(NewLayoutRequest {
            stem: stem.to_owned(),
            new,
            method: method.to_owned(),
            options,
        });
        self.name_new_layout();
    }

    fn name_new_layout(&mut self) {
        let taken = self.layers.iter().map(|layer| layer.path().to_owned());
        self.new_layouts.start(taken.collect(), &self.context);
    }

    /// Opens the layouts without a file that have got their names.
    pub(crate) fn poll_new_layouts(&mut self) {
        while let Some((request, (path, draft))) = self.new_layouts.poll() {
            if self.index_of(&path).is_some() {
                draft.iter().for_each(DraftFile::delete);
                self.new_layouts.put_back(request);
            } else {
                let (new, method) = ((Some(request.new), draft), request.method);
                let layer = Layer::open(path, new, &method, request.options, &self.context);
                self.push(layer);
            }
            self.name_new_layout();
        }
    }

    /// Opens the layouts without a file that earlier runs left with unsaved work. Called before
    /// the first frame.
    pub(crate) fn open_left_drafts(&mut self, method: &str, options: &SceneOptions) {
        let state = draft_state(&*self.context.services);
        for draft in state.iter().flat_map(|state| DraftFile::left(state)) {
            // Two windows may have left drafts of one name, and a file may have it by now.
            let is_open = |path: &Path| self.index_of(path).is_some();
            let stem = draft.suggested_stem();
            let path = free_name(&stem, is_open, &*self.context.services);
            let new = (Some(NewLayout::Draft(draft.path().to_owned())), Some(draft));
            let layer = Layer::open(path, new, method, options.clone(), &self.context);
            self.push(layer);
        }
    }

    fn push(&mut self, layer: Layer) {
        self.layers.push(layer);
        self.active = self.layers.len() - 1;
        self.is_watch_outdated = true;
    }

    pub(crate) fn close(&mut self, index: usize) {
        self.layers.remove(index);
        self.active = self.active.min(self.layers.len().saturating_sub(1));
        self.is_watch_outdated = true;
    }

    /// Reads a file again. Returns a notice if that has to wait.
    pub(crate) fn reload(
        &mut self,
        index: usize,
        options: SceneOptions,
        drops_changes: bool,
    ) -> Option<String> {
        let layer = self.layers.get_mut(index)?;
        if layer.save.is_saving() {
            let name = layer.name();
            return Some(say!("{name} is being saved; try again in a moment", name));
        }
        layer.reload(options, drops_changes, &self.context);
        // The watcher takes the present state on disk as known.
        self.is_watch_outdated = true;
        None
    }

    /// Replays the unsaved work of a file.
    pub(crate) fn recover(&mut self, index: usize, options: SceneOptions) {
        if let Some(layer) = self.layers.get_mut(index) {
            layer.recover(options, &self.context);
        }
    }

    /// Recolors all files whose scenes have other options.
    pub(crate) fn recolor(&mut self, options: &SceneOptions) {
        (0..self.layers.len()).for_each(|index| self.recolor_one(index, options));
    }

    /// Recolors one file if its scene has other options.
    pub(crate) fn recolor_one(&mut self, index: usize, options: &SceneOptions) {
        let layer = &mut self.layers[index];
        let options = layer.look.scene_options(options);
        let repaint = &self.context.repaint;
        layer.tasks.recolor(layer.slot.document(), options, repaint);
    }

    /// Replaces the render method of all files.
    pub(crate) fn set_method(&mut self, name: &str) {
        let layers = self.layers.iter();
        layers.for_each(|layer| layer.picture.set_method(name));
    }

    /// Takes the results of the threads of one file.
    pub(crate) fn poll_layer(&mut self, ctx: &Context, index: usize) -> Vec<LayerEvent> {
        self.layers[index].poll(ctx, &self.context)
    }

    /// Reloads files that other programs changed. Returns notices for the user.
    pub(crate) fn poll_watcher(&mut self, options: &SceneOptions) -> Vec<String> {
        if std::mem::take(&mut self.is_watch_outdated) {
            let on_disk = self.layers.iter().filter(|layer| !layer.is_untitled());
            let paths = on_disk.map(|layer| layer.path().to_owned());
            self.watcher.set_files(paths.collect());
        }
        let mut notices = Vec::new();
        for (path, state) in self.watcher.changed().collect::<Vec<_>>() {
            if state.is_none() {
                notices.push(gone_from_disk(&path));
                continue;
            }
            let is_foreign = |l: &Layer| {
                l.is_at(&path) && !l.is_untitled() && l.save.is_changed_by_others(state)
            };
            let Some(index) = self.layers.iter().position(is_foreign) else {
                continue;
            };
            let name = self.layers[index].name();
            if self.layers[index].is_changed() {
                notices.push(changed_on_disk(&name));
            } else {
                notices.extend(self.reload(index, options.clone(), false));
                notices.push(say!("{name} has changed on disk and is reloaded", name));
            }
        }
        notices
    }

    /// Ends the save in progress; with a file, the layout was written there. Returns notices.
    pub(crate) fn end_save(&mut self, saved: Option<SavedFile>) -> Vec<String> {
        let is_saving = |layer: &Layer| layer.save.is_saving();
        let Some(index) = self.layers.iter().position(is_saving) else {
            return Vec::new();
        };
        let is_written = saved.is_some();
        let event = self.layers[index].end_save(saved, &self.context);
        self.is_watch_outdated = true;
        let mut notices = Vec::new();
        if let Some(LayerEvent::Notice(notice)) = event {
            notices.push(notice);
        }
        if is_written {
            notices.extend(self.remember(index));
        }
        notices
    }

    /// Adds a file to the recent files. Returns a notice if the list cannot be written.
    pub(crate) fn remember(&mut self, index: usize) -> Option<String> {
        let layer = &self.layers[index];
        let path = (!layer.is_untitled()).then(|| layer.path().to_owned());
        self.remember_path(&path?)
    }

    /// Adds a file to the recent files, as [`Self::remember`] does.
    pub(crate) fn remember_path(&mut self, path: &Path) -> Option<String> {
        let error = self.recent.add(path).err()?;
        Some(say!(
            "cannot write the list of recent files: {error}",
            error
        ))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::files::draft_file::tests::left_behind;
    use crate::tests::services::{TestServices, lanes};

    fn open_files() -> OpenFiles {
        let services = TestServices::with([("a.arrow", lanes(1)), ("b.arrow", lanes(2))]);
        let repaint: crate::background::RepaintHandle = Arc::new(|| {});
        let mut files = OpenFiles::new(LayerContext::new(services, repaint));
        for name in ["a.arrow", "b.arrow"] {
            files.open(name.into(), "cpu", SceneOptions::default());
        }
        files
    }

    #[test]
    fn opening_an_open_file_activates_it() {
        let mut files = open_files();
        assert_eq!(files.active_index(), 1);
        files.open("a.arrow".into(), "cpu", SceneOptions::default());
        assert_eq!((files.layers().len(), files.active_index()), (2, 0));
    }

    #[test]
    fn moved_file_stays_active() {
        let mut files = open_files();
        files.open("c.arrow".into(), "cpu", SceneOptions::default());
        let names =
            |files: &OpenFiles| -> Vec<String> { files.layers().iter().map(Layer::name).collect() };
        for (from, to, order) in [
            (2, 0, ["c.arrow", "a.arrow", "b.arrow"]),
            (2, 1, ["c.arrow", "b.arrow", "a.arrow"]),
            (1, 2, ["c.arrow", "a.arrow", "b.arrow"]),
            (1, 9, ["c.arrow", "a.arrow", "b.arrow"]),
        ] {
            files.move_layer(from, to);
            assert_eq!(names(&files), order);
            assert!(files.active().is_some_and(|l| l.name() == "c.arrow"));
        }
        let drawn: Vec<String> = files.visible().map(Layer::name).collect();
        assert_eq!(
            drawn,
            ["b.arrow", "a.arrow", "c.arrow"],
            "the first is on top"
        );
    }

    #[test]
    fn active_file_is_on_top_and_another_takes_over_when_it_closes() {
        let mut files = open_files();
        files.activate(0);
        let names: Vec<String> = files.visible().map(Layer::name).collect();
        assert_eq!(names, ["b.arrow", "a.arrow"]);
        files.activate_next();
        files.close(1);
        assert!(
            files
                .active()
                .is_some_and(|layer| layer.name() == "a.arrow")
        );
    }

    #[test]
    fn left_drafts_of_one_name_open_under_names_of_their_own() {
        let state = tempfile::tempdir().unwrap();
        let name = Path::new("untitled.lif.json");
        let _drafts = [(); 2].map(|()| left_behind(state.path(), name));
        let mut files = open_files();
        let services = TestServices::with([]);
        *services.state.lock().unwrap() = Some(state.path().into());
        files.context.services = services;
        files.open_left_drafts("cpu", &SceneOptions::default());
        let names: Vec<String> = files.layers()[2..].iter().map(Layer::name).collect();
        assert_eq!(names, ["untitled.lif.json", "untitled-2.lif.json"]);
    }
}
