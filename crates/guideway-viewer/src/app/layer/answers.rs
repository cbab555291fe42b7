//! What is asked of a layout beside the window: other colors, the paths that meet a query, and what is odd.

use std::sync::Arc;

use guideway_document::{Query, QueryError, SelectMode};
use guideway_layout::CheckOptions;
use guideway_scene::{Scene, SceneOptions};

use super::{Layer, LayerNews, PATIENCE, Work};
use crate::work::Wake;
use crate::work::findings::Findings;
use crate::work::task::Task;

impl Layer {
    /// Gives the paths other colors, unless they have them, or get them already.
    pub(crate) fn recolor(&mut self, options: SceneOptions, wake: &Wake) {
        let is_same =
            self.options.color == options.color && self.options.color_by == options.color_by;
        if let Some(document) = self.document.as_ref().filter(|_| !is_same) {
            self.options = options.clone();
            let layout = document.scene().shared_layout();
            self.coloring = Some(Task::start(wake, move || Scene::new(layout, &options)));
        }
    }

    /// Whether other colors, or what a query asks for, are on their way.
    pub(crate) fn is_busy(&self) -> bool {
        self.coloring.is_some() || self.selecting.is_some() || self.away.is_at_work()
    }

    /// Selects the paths that meet a query, once they are found.
    ///
    /// # Errors
    /// When the query cannot be understood; the selection is then as it was.
    pub(crate) fn select_where(
        &mut self,
        query: &str,
        how: SelectMode,
        wake: &Wake,
    ) -> Result<(), QueryError> {
        if let Some(document) = &self.document {
            let query = Query::parse(query, document.layout())?;
            let layout = document.scene().shared_layout();
            let task = Task::start(wake, move || query.rows(&layout));
            self.selecting = Some((task, how));
        }
        Ok(())
    }

    /// Looks through the document as it is now.
    pub(crate) fn check(&mut self, options: CheckOptions, wake: &Wake) {
        if let Some(document) = &self.document {
            let snapshot = document.snapshot();
            let check = move || Findings::of(&snapshot, &options);
            self.checking = Some(Task::start(wake, check));
        }
    }

    /// Whether it is being looked through, or there is nothing yet that can be.
    pub(crate) fn is_checking(&self) -> bool {
        self.checking.is_some() || self.findings.is_none()
    }

    pub(super) fn take_findings(&mut self) -> Option<LayerNews> {
        let outcome = self.checking.as_ref().and_then(Task::outcome)?;
        self.checking = None;
        match outcome {
            Ok(findings) => {
                self.findings = Some(findings);
                None
            }
            Err(trouble) => Some(LayerNews::Notice(trouble.to_string())),
        }
    }

    /// Takes what was asked of the layout as it was then.
    pub(super) fn take_answers(&mut self, wake: &Wake) -> Option<LayerNews> {
        // What still looks at it is not for long.
        let document = Arc::get_mut(self.document.as_mut()?)?;
        let selecting = self.selecting.as_ref();
        let selected = selecting.and_then(|(task, how)| Some((task.outcome()?, *how)));
        if let Some((rows, how)) = selected {
            self.selecting = None;
            match rows {
                Ok(rows) => {
                    let select = Work::new(move |document| document.select(rows, how));
                    return self.work(select, PATIENCE, wake);
                }
                Err(trouble) => return Some(LayerNews::Notice(trouble.to_string())),
            }
        }
        let colored = self.coloring.as_ref().and_then(Task::outcome)?;
        self.coloring = None;
        match colored {
            Ok(Ok(scene)) => {
                if document.adopt_colors(scene) {
                    self.send_scene();
                } else {
                    // The layout has changed since.
                    let layout = document.scene().shared_layout();
                    let options = self.options.clone();
                    self.coloring = Some(Task::start(wake, move || Scene::new(layout, &options)));
                }
                None
            }
            Ok(Err(error)) => Some(LayerNews::Notice(format!("{}: {error}", self.name()))),
            Err(trouble) => Some(LayerNews::Notice(trouble.to_string())),
        }
    }
}
