//! The render method: the user's choice, or else the best that runs on this computer.

use std::sync::Arc;
use std::time::Duration;

use eframe::egui::Context;

use crate::background::{BackgroundTask, RepaintHandle};
use crate::services::{AppServices, MethodChoice};

/// The method that runs on every computer.
pub(crate) const FALLBACK_METHOD: &str = "cpu";

/// Time for which the probe leaves the processor to the first picture: on a software renderer it
/// takes that long from the frame that has it to the screen.
const PROBE_WAIT: Duration = Duration::from_millis(400);

/// The available methods and the selected one.
pub(crate) struct MethodSelection {
    /// All methods, the best first; empty until the probe is complete.
    choices: Vec<MethodChoice>,
    /// The user's choice; `None` selects the best.
    chosen: Option<String>,
    probe: Probe,
}

/// Finds out which methods run here. To start one may take a driver a second and all cores, so the
/// probe waits for the first picture.
enum Probe {
    /// Until this time, in seconds, once there are pictures.
    Waiting(Option<f64>),
    Running(BackgroundTask<Vec<MethodChoice>>),
    Done,
}

impl MethodSelection {
    pub(crate) fn new(chosen: Option<String>) -> Self {
        Self {
            choices: Vec::new(),
            chosen,
            probe: Probe::Waiting(None),
        }
    }

    /// All methods, the best first; empty until the probe is complete.
    pub(crate) fn choices(&self) -> &[MethodChoice] {
        &self.choices
    }

    /// The user's choice; `None` selects the best.
    pub(crate) fn chosen(&self) -> Option<&str> {
        self.chosen.as_deref()
    }

    /// Selects a method; `None` selects the best.
    pub(crate) fn choose(&mut self, chosen: Option<String>) {
        self.chosen = chosen;
    }

    /// Name of the method to render with.
    pub(crate) fn name(&self) -> &str {
        self.chosen.as_deref().unwrap_or(self.best())
    }

    /// Name of the best method that runs here; the fallback until the probe is complete.
    pub(crate) fn best(&self) -> &str {
        let mut available = self
            .choices
            .iter()
            .filter(|choice| choice.unavailable.is_none());
        available.next().map_or(FALLBACK_METHOD, |c| &c.name)
    }

    /// Starts the probe once every file has a picture on the screen, and takes its result. Returns
    /// whether the method to render with has changed.
    pub(crate) fn poll(
        &mut self,
        has_pictures: bool,
        ctx: &Context,
        services: &Arc<dyn AppServices>,
        repaint: &RepaintHandle,
    ) -> bool {
        match &self.probe {
            Probe::Waiting(None) if has_pictures => {
                let begins_s = ctx.input(|input| input.time) + PROBE_WAIT.as_secs_f64();
                self.probe = Probe::Waiting(Some(begins_s));
                ctx.request_repaint_after(PROBE_WAIT);
                false
            }
            Probe::Waiting(Some(begins_s)) if ctx.input(|input| input.time) >= *begins_s => {
                let services = Arc::clone(services);
                let task = BackgroundTask::start(repaint, move || services.methods());
                self.probe = Probe::Running(task);
                false
            }
            Probe::Running(task) => {
                let Some(choices) = task.result() else {
                    return false;
                };
                self.probe = Probe::Done;
                self.choices = choices.unwrap_or_default();
                self.chosen.is_none() && self.best() != FALLBACK_METHOD
            }
            Probe::Waiting(_) | Probe::Done => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selects_the_best_available_method_unless_one_is_chosen() {
        let choice = |name: &str, unavailable: Option<&str>| MethodChoice {
            name: name.into(),
            summary: String::new(),
            unavailable: unavailable.map(str::to_owned),
        };
        let mut methods = MethodSelection::new(None);
        assert_eq!(methods.name(), FALLBACK_METHOD);
        methods.choices = vec![choice("gpu", Some("no adapter")), choice("fast", None)];
        assert_eq!(methods.name(), "fast");
        methods.choose(Some("cpu".into()));
        assert_eq!((methods.name(), methods.best()), ("cpu", "fast"));
    }
}
