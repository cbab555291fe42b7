//! The layouts before and after the open one, for undo.

use std::sync::Arc;

use guideway::layout::Layout;

/// Most layouts that are kept for undo, and most paths of them together: the memory of an engine
/// never shrinks.
const MAX_LAYOUTS: usize = 100;
const MAX_PATHS: usize = 2_000_000;

/// The layouts before and after the open one.
#[derive(Default)]
pub(crate) struct History {
    before: Vec<Arc<Layout>>,
    after: Vec<Arc<Layout>>,
}

impl History {
    /// Keeps the layout before an edit. The oldest ones go where there are too many.
    pub(crate) fn push(&mut self, layout: Arc<Layout>) {
        self.after.clear();
        self.before.push(layout);
        let mut paths = 0;
        let newest = self.before.iter().rev().take(MAX_LAYOUTS);
        let kept = newest.take_while(|layout| {
            paths += layout.paths.len();
            paths <= MAX_PATHS
        });
        let dropped = self.before.len() - kept.count();
        self.before.drain(..dropped);
    }

    /// Takes back the edit that led to the open layout; `None` if there is none.
    pub(crate) fn undone(&mut self, open: Arc<Layout>) -> Option<Arc<Layout>> {
        let layout = self.before.pop()?;
        self.after.push(open);
        Some(layout)
    }

    /// Performs the last edit that was taken back; `None` if there is none.
    pub(crate) fn redone(&mut self, open: Arc<Layout>) -> Option<Arc<Layout>> {
        let layout = self.after.pop()?;
        self.before.push(open);
        Some(layout)
    }
}
