//! Edits of the open layout by the steps of scripts, with undo.

use std::sync::Arc;

use guideway::formats::ReadOptions;
use guideway::layout::UserError;
use guideway::script::{Applied, Script};
use serde_json::json;

use crate::session::Session;

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
        Ok(json!({ "steps": guideway::json::edit_steps(&steps) }).to_string())
    }

    /// Takes the last edit back. Returns `false` if there is none.
    pub fn undo(&mut self) -> bool {
        let Some(layout) = self.history.undone(Arc::clone(&self.layout)) else {
            return false;
        };
        self.replace(layout);
        true
    }

    /// Performs an edit again that was taken back. Returns `false` if there is none.
    pub fn redo(&mut self) -> bool {
        let Some(layout) = self.history.redone(Arc::clone(&self.layout)) else {
            return false;
        };
        self.replace(layout);
        true
    }
}
