//! Input that waits while an edit has the document.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};

use crate::canvas::CanvasPlace;
use crate::command::Command;
use crate::tools::PointerEvent;

/// A command, or a click or drag in the drawing.
#[derive(Clone, Copy)]
pub(super) enum Input {
    Command(Command),
    Pointer(PointerEvent),
}

/// The input that waits, with the view and the pointer of its time, and the file that it is for.
#[derive(Default)]
pub(super) struct WaitingInput {
    file: PathBuf,
    inputs: VecDeque<(Input, CanvasPlace)>,
}

impl WaitingInput {
    pub(super) fn is_empty(&self) -> bool {
        self.inputs.is_empty()
    }

    pub(super) fn clear(&mut self) {
        self.inputs.clear();
    }

    /// Adds an input for a file. Those for another file are forgotten.
    pub(super) fn push(&mut self, file: &Path, input: Input, place: CanvasPlace) {
        if !self.is_for(file) {
            self.inputs.clear();
            file.clone_into(&mut self.file);
        }
        self.inputs.push_back((input, place));
    }

    /// Returns `true` if the input is for this file.
    pub(super) fn is_for(&self, file: &Path) -> bool {
        self.file == file
    }

    /// Takes the input that came first.
    pub(super) fn next(&mut self) -> Option<(Input, CanvasPlace)> {
        self.inputs.pop_front()
    }
}
