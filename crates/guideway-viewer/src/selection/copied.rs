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

    /// Pastes the elements into a file: one more step beside the originals if it has them, else at
    /// the same place.
    pub(crate) fn paste_into(&mut self, file: &Path, step_m: Point<f64>) -> EditTask {
        self.pasted += u32::from(self.from.as_deref() == Some(file));
        let by = Affine::translation(step_m * f64::from(self.pasted));
        let clip = self.clip.clone();
        EditTask::edit(move |document: &mut Document| {
            let pasted = match document.paste(&clip, by, document.level()) {
                // The other file has other levels.
                Err(OperationError::UnknownLevel { .. }) => {
                    document.paste(&clip, by, document.drawing_level(None))
                }
                pasted => pasted,
            };
            pasted.map(drop)
        })
    }
}
