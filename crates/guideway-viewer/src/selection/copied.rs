//! Copied elements, to be pasted into the same or another open file.

use std::path::{Path, PathBuf};

use guideway_document::{Clip, Document, OperationError};
use guideway_spline::{Affine, Point};

use crate::editing::EditTask;

/// Copied elements, and how often they were pasted into the file that they are from.
pub(crate) struct CopiedElements {
    clip: Clip,
    /// The file that has them; `None` once they were cut.
    from: Option<PathBuf>,
    pasted: u32,
}

impl CopiedElements {
    pub(crate) fn new(clip: Clip, from: Option<PathBuf>) -> Self {
        Self {
            clip,
            from,
            pasted: 0,
        }
    }

    /// Pastes the elements into a file: one more step beside the originals if it has them; else at
    /// the same place, as levels always.
    pub(crate) fn paste_into(&mut self, file: &Path, step_m: Point<f64>) -> EditTask {
        self.pasted += u32::from(self.from.as_deref() == Some(file));
        // Levels lie over each other.
        let steps = if self.clip.has_groups() {
            0
        } else {
            self.pasted
        };
        let by = Affine::translation(step_m * f64::from(steps));
        let clip = self.clip.clone();
        EditTask::edit(move |document: &mut Document| paste(document, &clip, by))
    }
}

/// Pastes a clip, and shows the first pasted level alone.
pub(super) fn paste(
    document: &mut Document,
    clip: &Clip,
    by: Affine,
) -> Result<(), OperationError> {
    let pasted = match document.paste(clip, by, document.level()) {
        // The other file has other levels.
        Err(OperationError::UnknownLevel { .. }) => {
            document.paste(clip, by, document.drawing_level(None))
        }
        pasted => pasted,
    };
    if let Some(level) = pasted?.levels.min() {
        document.show_level(Some(level));
    }
    Ok(())
}
