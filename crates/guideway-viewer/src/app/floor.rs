//! What lies below all layouts: a drawing or an image of the hall.

use std::sync::Arc;

use eframe::egui::Context;
use guideway_scene::View;

use super::App;
use crate::services::FloorPlan;
use crate::work::beside::Beside;
use crate::work::task::Task;
use guideway_layout::UserError;

/// The floor plan, if there is one.
#[derive(Default)]
pub(crate) struct Floor {
    /// What the person wrote of it; nothing if there is none.
    pub(crate) plan: String,
    /// Why there is none.
    pub(crate) trouble: Option<String>,
    pub(crate) is_visible: bool,
    reading: Option<Task<Result<Arc<dyn FloorPlan>, UserError>>>,
    pub(super) read: Option<Arc<dyn FloorPlan>>,
    pub(crate) drawn: Beside<()>,
}

impl Floor {
    /// Whether it is still being read.
    pub(crate) fn is_awaited(&self) -> bool {
        self.reading.is_some()
    }
}

impl App {
    /// Takes another floor plan, or none if nothing is written.
    pub(crate) fn lay_floor_plan(&mut self, plan: &str) {
        self.floor = Floor::default();
        if plan.trim().is_empty() {
            return;
        }
        let (services, text) = (Arc::clone(&self.services), plan.trim().to_owned());
        self.floor.plan.clone_from(&text);
        self.floor.is_visible = true;
        let read = move || services.read_floor_plan(&text);
        self.floor.reading = Some(Task::start(&self.wake, read));
    }

    pub(super) fn poll_floor(&mut self, ctx: &Context) {
        self.floor.drawn.poll(ctx, "floor plan");
        let Some(read) = self.floor.reading.as_ref().and_then(Task::outcome) else {
            return;
        };
        self.floor.reading = None;
        match read.flatten() {
            Ok(plan) => {
                // Where there is nothing else, it says where to look.
                if let (true, Some(bounds)) = (self.layers.is_empty(), plan.bounds()) {
                    self.camera.fit(bounds);
                }
                self.floor.read = Some(plan);
            }
            Err(trouble) => self.floor.trouble = Some(trouble.to_string()),
        }
    }

    /// Has the floor plan in a view drawn, unless that is there or on its way.
    pub(crate) fn ask_for_floor(&mut self, view: &View) {
        let Some(plan) = self.floor.read.as_ref().filter(|_| self.floor.is_visible) else {
            self.floor.drawn.clear();
            return;
        };
        if self.floor.drawn.needs(&(), view) {
            let (plan, view) = (Arc::clone(plan), *view);
            let draw = move || plan.draw(&view);
            self.floor.drawn.ask((), view, &self.wake, draw);
        }
    }
}
