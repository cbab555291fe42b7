//! Edits of the open layout by the steps of scripts, with undo.

use std::sync::Arc;

use guideway::formats::ReadOptions;
use guideway::layout::{Layout, UserError};
use guideway::script::{Applied, Script};
use serde_json::{Value, json};

use crate::session::Session;

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
    fn push(&mut self, layout: Arc<Layout>) {
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
}

impl Session {
    /// Edits the layout by a script, such as `{"steps": [{"do": "rename", "node": "N7", "to":
    /// "gate"}]}`: by all of its steps, or by none. Returns what each step has touched, as JSON.
    ///
    /// # Errors
    /// When the script cannot be read, or a step cannot be performed.
    pub fn edit(&mut self, script: &str) -> Result<String, UserError> {
        let script = Script::from_json(script.as_bytes(), "")?;
        let applied = script.apply(Arc::clone(&self.layout), &ReadOptions::default())?;
        let Applied { layout, steps } = applied;
        let before = self.replace(Arc::new(layout));
        self.history.push(before);
        let steps = steps.iter().zip(1..);
        let steps: Value = steps
            .map(|(step, number)| guideway::json::edit_step(step, number))
            .collect();
        Ok(json!({ "steps": steps }).to_string())
    }

    /// Takes the last edit back. Returns `false` if there is none.
    pub fn undo(&mut self) -> bool {
        let Some(layout) = self.history.before.pop() else {
            return false;
        };
        let after = self.replace(layout);
        self.history.after.push(after);
        true
    }

    /// Performs an edit again that was taken back. Returns `false` if there is none.
    pub fn redo(&mut self) -> bool {
        let Some(layout) = self.history.after.pop() else {
            return false;
        };
        let before = self.replace(layout);
        self.history.before.push(before);
        true
    }
}
