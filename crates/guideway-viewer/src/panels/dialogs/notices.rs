//! Notices to the user, shown in a corner of the window until they are dismissed.

use eframe::egui::{Align2, Context, Vec2, Window};

/// Longest list of notices; older ones are dropped.
const MAX_NOTICES: usize = 5;

/// The notices that are not dismissed.
#[derive(Default)]
pub(crate) struct Notices {
    texts: Vec<String>,
}

impl Notices {
    /// Adds a notice, unless it repeats the last one.
    pub(crate) fn add(&mut self, text: impl Into<String>) {
        let text = text.into();
        if self.texts.last() == Some(&text) {
            return;
        }
        if self.texts.len() == MAX_NOTICES {
            self.texts.remove(0);
        }
        self.texts.push(text);
    }

    #[cfg(test)]
    pub(crate) fn texts(&self) -> &[String] {
        &self.texts
    }

    pub(crate) fn clear(&mut self) {
        self.texts.clear();
    }

    pub(super) fn show(&mut self, ctx: &Context) {
        if self.texts.is_empty() {
            return;
        }
        let mut is_dismissed = false;
        Window::new("Notices")
            .title_bar(false)
            .resizable(false)
            .anchor(Align2::LEFT_BOTTOM, Vec2::new(12.0, -64.0))
            .show(ctx, |ui| {
                ui.set_max_width(520.0);
                for text in &self.texts {
                    ui.label(text);
                }
                is_dismissed = ui.button("Dismiss").clicked();
            });
        if is_dismissed {
            self.clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_the_last_five_without_repetition() {
        let mut notices = Notices::default();
        for text in ["a", "b", "b", "c", "d", "e", "f"] {
            notices.add(text);
        }
        assert_eq!(notices.texts(), ["b", "c", "d", "e", "f"]);
    }
}
