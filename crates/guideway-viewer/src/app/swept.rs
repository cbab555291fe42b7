//! The areas that a vehicle sweeps along the selected paths, drawn beside the window.

use std::sync::Arc;

use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions};
use guideway_document::Document;
use guideway_render::View;

use super::App;
use crate::host::Trouble;
use crate::work::renderer::color_image;
use crate::work::task::Task;

/// Most paths whose areas are shown where none is selected.
const MOST_UNSELECTED: usize = 20_000;

/// What is shown of areas, and how.
pub(crate) struct Swept {
    pub(crate) is_shown: bool,
    /// The vehicle, as a person writes it.
    pub(crate) vehicle: String,
    /// Why there are none.
    pub(crate) trouble: Option<String>,
    /// The last picture of them, and what it shows.
    pub(crate) picture: Option<(TextureHandle, View)>,
    task: Option<Task<Result<ColorImage, Trouble>>>,
    /// What the task, or else the picture, is of.
    asked: Option<Asked>,
}

#[derive(Clone, PartialEq)]
struct Asked {
    vehicle: String,
    view: View,
    layer: usize,
    revision: u64,
}

impl Default for Swept {
    fn default() -> Self {
        Self {
            is_shown: false,
            vehicle: "2x1.2".to_owned(),
            trouble: None,
            picture: None,
            task: None,
            asked: None,
        }
    }
}

impl App {
    /// Has the areas in a view drawn, unless they are there or others still are being drawn.
    pub(crate) fn ask_for_swept(&mut self, view: &View) {
        if !self.swept.is_shown {
            (self.swept.picture, self.swept.asked) = (None, None);
            self.swept.trouble = None;
            return;
        }
        let Some(document) = self
            .layers
            .get(self.active)
            .and_then(|l| l.document.as_ref())
        else {
            return;
        };
        let asked = Asked {
            vehicle: self.swept.vehicle.clone(),
            view: *view,
            layer: self.active,
            revision: document.revision(),
        };
        if self.swept.task.is_some() || self.swept.asked.as_ref() == Some(&asked) {
            return;
        }
        self.swept.asked = Some(asked.clone());
        let Some(rows) = rows(document) else {
            self.swept.picture = None;
            let text =
                format!("select at least one of these paths: they are more than {MOST_UNSELECTED}");
            self.swept.trouble = Some(text);
            return;
        };
        let (host, layout) = (Arc::clone(&self.host), document.scene().shared_layout());
        self.swept.task = Some(Task::start(&self.wake, move || {
            let Asked { vehicle, view, .. } = asked;
            Ok(color_image(&host.swept(&layout, &rows, &vehicle, &view)?))
        }));
    }

    /// Takes the areas that were drawn.
    pub(super) fn poll_swept(&mut self, ctx: &Context) {
        let Some(drawn) = self.swept.task.as_ref().and_then(Task::outcome) else {
            return;
        };
        self.swept.task = None;
        match (drawn.flatten(), &self.swept.asked) {
            (Ok(image), Some(asked)) => {
                let texture = ctx.load_texture("swept areas", image, TextureOptions::LINEAR);
                self.swept.picture = Some((texture, asked.view));
                self.swept.trouble = None;
            }
            (Ok(_), None) => {}
            (Err(trouble), _) => {
                self.swept.picture = None;
                self.swept.trouble = Some(trouble.to_string());
            }
        }
    }
}

/// The paths that are meant: those that are selected, or all if they are not too many.
fn rows(document: &Document) -> Option<Vec<u32>> {
    if !document.selection().is_empty() {
        return Some(document.selection().iter().collect());
    }
    let all = document.scene().draw_order();
    (all.len() <= MOST_UNSELECTED).then(|| all.to_vec())
}
