//! New layouts: an empty document that has no file yet, and so no journal until it is opened again.

use std::path::PathBuf;
use std::sync::Arc;

use guideway_document::Document;
use guideway_layout::{CheckOptions, Layout, Level};
use guideway_scene::{SceneError, SceneOptions};

use super::layer::Layer;
use super::layer_context::LayerContext;
use super::open_files::OpenFiles;
use crate::editing::Findings;

/// Name of the only level of a new layout.
const FIRST_LEVEL: &str = "level 1";

impl Layer {
    /// A new layout with one level, which gets its file by the first save.
    ///
    /// # Errors
    /// When the options name a column.
    fn create(
        path: PathBuf,
        method: &str,
        options: SceneOptions,
        context: &LayerContext,
    ) -> Result<Self, SceneError> {
        let layout = Layout {
            levels: vec![Level {
                id: FIRST_LEVEL.to_owned(),
                ..Level::default()
            }],
            ..Layout::default()
        };
        // An empty layout has no columns to color by.
        let own = SceneOptions {
            color_by: None,
            ..options.clone()
        };
        let document = Document::new(Arc::new(layout), &own)?;
        let mut layer = Self::without_document(path, method, &options, context);
        layer.save.begin_new();
        let findings = Findings::of(&document.snapshot(), &CheckOptions::default());
        let scene = Arc::new(document.scene().clone());
        layer.picture.set_scene(scene);
        layer.take_document(document, None, &mut Vec::new());
        layer.tasks.set_findings(findings);
        Ok(layer)
    }
}

impl OpenFiles {
    /// Adds a new layout, and edits it from now on.
    ///
    /// # Errors
    /// When the options name a level.
    pub(crate) fn create(&mut self, method: &str, options: SceneOptions) -> Result<(), SceneError> {
        let layer = Layer::create(self.new_path(), method, options, &self.context)?;
        self.add(layer);
        Ok(())
    }

    /// A name that no open file and no file on disk has.
    fn new_path(&self) -> PathBuf {
        let numbered = (2..).map(|number: u64| format!("untitled-{number}.lif.json"));
        let names = std::iter::once("untitled.lif.json".to_owned()).chain(numbered);
        let services = &self.context.services;
        let is_free =
            |path: &PathBuf| self.index_of(path).is_none() && services.file_stamp(path).is_none();
        let mut paths = names.map(PathBuf::from);
        paths.find(is_free).unwrap_or_default()
    }
}
