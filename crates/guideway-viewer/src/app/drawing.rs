use std::sync::Arc;

use super::{App, Layer};
use crate::services::MethodChoice;
use crate::work::renderer::FALLBACK;
use crate::work::task::Task;

/// How pictures are drawn.
pub(crate) struct Drawing {
    /// The ways of drawing, the best first, once it is known which of them run here.
    pub(crate) choices: Vec<MethodChoice>,
    /// The one that the person has asked for; none for the best.
    pub(crate) chosen: Option<String>,
    finder: Finder,
}

/// Looks which ways of drawing run here. Starting each may take a driver a second and all cores, so it waits for the
/// first picture.
enum Finder {
    Waits,
    Looks(Task<Vec<MethodChoice>>),
    Done,
}

impl Drawing {
    pub(super) fn new(chosen: Option<String>) -> Self {
        Self {
            choices: Vec::new(),
            chosen,
            finder: Finder::Waits,
        }
    }

    /// Name of the way of drawing. As long as the best is not known, one that runs everywhere shows something.
    pub(crate) fn method(&self) -> &str {
        self.chosen.as_deref().unwrap_or(self.best())
    }

    /// The best that runs here.
    pub(crate) fn best(&self) -> &str {
        let mut runs = self
            .choices
            .iter()
            .filter(|choice| choice.unavailable.is_none());
        runs.next().map_or(FALLBACK, |choice| &choice.name)
    }
}

impl App {
    /// Draws another way from now on; none for the best.
    pub(crate) fn set_method(&mut self, chosen: Option<String>) {
        self.drawing.chosen = chosen;
        let name = self.drawing.method();
        for layer in &mut self.layers {
            layer.set_method(name);
        }
    }

    /// Goes on by what runs everywhere, for a way of drawing was let down by its device.
    pub(super) fn fall_back(&mut self, why: String) {
        // Each file may say so, of the one device that all of them had.
        if self.drawing.method() != FALLBACK {
            self.notify(why);
            self.set_method(Some(FALLBACK.to_owned()));
        }
    }

    pub(super) fn poll_methods(&mut self) {
        match &self.drawing.finder {
            Finder::Waits if self.layers.iter().all(Layer::has_settled) => {
                let services = Arc::clone(&self.services);
                let task = Task::start(&self.wake, move || services.methods());
                self.drawing.finder = Finder::Looks(task);
            }
            Finder::Looks(task) => {
                let Some(found) = task.outcome() else {
                    return;
                };
                self.drawing.finder = Finder::Done;
                self.drawing.choices = found.unwrap_or_default();
                if self.drawing.chosen.is_none() && self.drawing.best() != FALLBACK {
                    self.set_method(None);
                }
            }
            Finder::Waits | Finder::Done => {}
        }
    }
}
