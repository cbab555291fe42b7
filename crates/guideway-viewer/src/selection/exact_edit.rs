//! The fields for moves, copies and rotations by exact numbers.

use guideway_document::Document;
use guideway_spline::{Affine, Point};

use crate::editing::EditTask;

/// The values of the fields.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct ExactEdit {
    pub(crate) by_x_m: f64,
    pub(crate) by_y_m: f64,
    pub(crate) angle_deg: f64,
    pub(crate) copies: u32,
    /// True if there is something to move.
    pub(crate) is_shown: bool,
}

impl Default for ExactEdit {
    fn default() -> Self {
        Self {
            by_x_m: 1.0,
            by_y_m: 0.0,
            angle_deg: 90.0,
            copies: 1,
            is_shown: false,
        }
    }
}

impl ExactEdit {
    fn by_m(&self) -> Point<f64> {
        Point::new(self.by_x_m, self.by_y_m)
    }

    /// Moves the selection.
    pub(crate) fn move_selection(&self) -> EditTask {
        let by = Affine::translation(self.by_m());
        EditTask::edit(move |document: &mut Document| document.transform_selection("move", by))
    }

    /// Copies the selection, each copy one step farther.
    pub(crate) fn copy_selection(&self) -> EditTask {
        let (count, step_m) = (self.copies, self.by_m());
        EditTask::edit(move |document: &mut Document| document.copy_selection(count, step_m))
    }

    /// Rotates the selection about the center of its bounding box.
    pub(crate) fn rotate_selection(&self) -> EditTask {
        let angle = self.angle_deg.to_radians();
        EditTask::edit(move |document: &mut Document| {
            let Some(bounds) = document.selection_bounds() else {
                return Ok(());
            };
            let by = Affine::rotation(angle, bounds.center());
            document.transform_selection("rotate", by)
        })
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;
    use std::time::Duration;

    use super::*;
    use crate::background::RepaintHandle;
    use crate::editing::DocumentSlot;
    use crate::tests::services::lanes;

    #[test]
    fn copies_are_one_step_apart() {
        let mut document = Document::new(lanes(1).into(), &Default::default()).unwrap();
        document.select_all();
        let mut slot = DocumentSlot::default();
        slot.replace(document);
        let exact = ExactEdit {
            copies: 2,
            by_x_m: 0.0,
            by_y_m: 3.0,
            ..ExactEdit::default()
        };
        let repaint: RepaintHandle = Arc::new(|| {});
        let wait = Duration::from_secs(60);
        slot.run(exact.copy_selection(), wait, Path::new("a"), &repaint);
        let paths = &slot.document().unwrap().layout().paths;
        let start_y = |row| paths.get(row).ends().unwrap().0.y;
        assert_eq!([1, 2].map(start_y), [3.0, 6.0]);
    }
}
