//! Copies elements inside a document.

use std::sync::Arc;

use guideway_scene::EditError;
use guideway_spline::{Affine, Point};

use super::copies::{Copies, Source};
use crate::document::Document;
use crate::elements::Elements;

impl Document {
    /// Copies the selected paths with their nodes and stations, and selects the copied paths. See
    /// [`Self::copy`].
    ///
    /// # Errors
    /// As [`Self::copy`].
    pub fn copy_selection(&mut self, count: u32, step_m: Point<f64>) -> Result<(), EditError> {
        let selected = Arc::clone(&self.selection);
        self.copy(&selected, count, step_m).map(drop)
    }

    /// Copies elements `count` times, each copy `step_m` from the previous one, and selects the
    /// copied paths. Copies the end nodes of the paths too, and the stations whose nodes are all
    /// copied. Copies keep properties and style; their names are numbered. Returns their rows.
    ///
    /// # Errors
    /// When an element does not exist, or a copy would exceed the coordinate limit; the
    /// document is unchanged.
    pub fn copy(
        &mut self,
        elements: &Elements,
        count: u32,
        step_m: Point<f64>,
    ) -> Result<Elements, EditError> {
        self.check_exist(elements)?;
        let all = self.with_places(elements);
        if all.is_empty() || count == 0 {
            return Ok(Elements::default());
        }
        let layout = self.layout();
        let mut copies = Copies::into(&self.scene);
        for number in 1..=count {
            let source = Source {
                layout,
                elements: &all,
                is_own: true,
                number: Some(number),
                levels: None,
            };
            copies.add(&source, Affine::translation(step_m * f64::from(number)));
        }
        let (rows, changes) = (copies.rows(), copies.into_changes());
        self.perform("copy", changes)?;
        self.selection = Arc::new(Elements::of_paths(&rows.paths));
        Ok(rows)
    }
}
