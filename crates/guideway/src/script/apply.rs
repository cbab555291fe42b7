//! Applies a script to a layout: all of its steps, or none.

use std::sync::Arc;

use guideway_document::Document;
use guideway_formats::ReadOptions;
use guideway_layout::clock::Instant;
use guideway_layout::{Layout, UserError};
use guideway_scene::{SceneOptions, elapsed_ms};

use super::members::Folder;
use super::read::Script;
use super::step::Touched;

/// A layout after a script, with one entry per step.
#[derive(Debug)]
pub struct Applied {
    /// The edited layout.
    pub layout: Layout,
    /// The steps in their order.
    pub steps: Vec<AppliedStep>,
}

/// A step that was applied.
#[derive(Debug)]
pub struct AppliedStep {
    /// Value of `do`, such as `rename`.
    pub name: String,
    /// The elements that it touched or made.
    pub touched: Touched,
    /// Time it took, in milliseconds.
    pub ms: f64,
}

impl Script {
    /// Applies all steps to a layout. Steps that read files do so with `options`.
    ///
    /// ```
    /// use guideway::formats::ReadOptions;
    /// use guideway::script::Script;
    ///
    /// let steps = br#"{"steps": [{"do": "rename", "station": "dock-1", "to": "gate"}]}"#;
    /// let script = Script::from_json(steps, "")?;
    /// let layout = guideway::open("examples/site.lif.json")?;
    /// let applied = script.apply(layout, &ReadOptions::default())?;
    /// assert_eq!(applied.steps[0].touched.names, ["gate"]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// When a step cannot be performed; the message has its number, starting from 1, and its name.
    pub fn apply(
        &self,
        layout: impl Into<Arc<Layout>>,
        options: &ReadOptions<'_>,
    ) -> Result<Applied, UserError> {
        let mut document = Document::new(layout.into(), &SceneOptions::default())?;
        let folder = Folder {
            path: &self.folder,
            options,
        };
        let mut steps = Vec::with_capacity(self.steps.len());
        for (number, step) in (1..).zip(&self.steps) {
            let started = Instant::now();
            let performed = step.perform(&mut document, &folder);
            let touched = performed.map_err(|error| {
                let message = format!("step {number} {}", error.describe(&step.name));
                let remedy = format!("{}. No step was kept", error.remedy);
                UserError::new("edit-script", message, remedy)
            })?;
            steps.push(AppliedStep {
                name: step.name.clone(),
                touched,
                ms: elapsed_ms(started),
            });
        }
        Ok(Applied {
            layout: document.to_layout(),
            steps,
        })
    }
}
