//! Progress of work in named parts: one bar after the other, until this is dropped.

use std::cell::RefCell;

use super::output::Output;
use super::progress_bar::ProgressBar;

/// The bar of the current part.
pub(crate) struct PartProgress {
    out: Output,
    shown: RefCell<Option<ProgressBar>>,
}

impl PartProgress {
    /// No part has begun.
    pub(crate) fn new(out: &Output) -> Self {
        Self {
            out: *out,
            shown: RefCell::default(),
        }
    }

    /// Begins a part, which ends the one before.
    pub(crate) fn begin(&self, part: &str) {
        let mut shown = self.shown.borrow_mut();
        // The previous bar ends before the next one starts.
        *shown = None;
        *shown = Some(self.out.progress(part));
    }
}
