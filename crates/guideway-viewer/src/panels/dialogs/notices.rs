//! Notices to the user in a corner of the canvas: news leaves after some seconds, problems stay
//! until they are dismissed.

use std::time::Duration;

use crate::language::{t, translated};
use eframe::egui::{Align2, Area, Button, Context, Frame, Id, Order, Rect, Sense, Vec2};

/// Longest list of notices; older ones are dropped.
const MAX_NOTICES: usize = 5;
/// Time for which news is shown.
const NEWS_TIME: Duration = Duration::from_secs(6);
/// Greatest width of a notice, in points.
const MAX_WIDTH: f32 = 420.0;
/// Distance from the edge of the canvas, in points.
const MARGIN: f32 = 12.0;

/// The notices that are not dismissed.
#[derive(Default)]
pub(crate) struct Notices {
    /// The shown texts, the newest last.
    texts: Vec<String>,
    /// Beside each text the time at which it leaves.
    leaves: Vec<Leaves>,
}

/// The end of a notice.
#[derive(Clone, Copy)]
enum Leaves {
    /// When the user dismisses it.
    Dismissed,
    /// [`NEWS_TIME`] after the next frame.
    AfterShown,
    /// At this time of the window, in seconds.
    At(f64),
}

impl Notices {
    /// Adds a problem, unless it repeats the last notice. It stays until it is dismissed.
    pub(crate) fn add(&mut self, text: impl Into<String>) {
        let text = text.into();
        self.push(translated(&text).into_owned(), Leaves::Dismissed);
    }

    /// Adds news, which leaves by itself.
    pub(crate) fn inform(&mut self, text: impl Into<String>) {
        self.push(text.into(), Leaves::AfterShown);
    }

    fn push(&mut self, text: String, leaves: Leaves) {
        if self.texts.last() == Some(&text) {
            self.remove(self.texts.len() - 1);
        }
        if self.texts.len() == MAX_NOTICES {
            self.remove(0);
        }
        self.texts.push(text);
        self.leaves.push(leaves);
    }

    #[cfg(test)]
    pub(crate) fn texts(&self) -> &[String] {
        &self.texts
    }

    pub(crate) fn clear(&mut self) {
        self.texts.clear();
        self.leaves.clear();
    }

    fn remove(&mut self, index: usize) {
        self.texts.remove(index);
        self.leaves.remove(index);
    }

    /// Shows the notices at the upper right of the canvas: the scale bar is below, the legend on
    /// the left.
    pub(super) fn show(&mut self, ctx: &Context, canvas: Rect) {
        self.expire(ctx);
        if self.texts.is_empty() {
            return;
        }
        let mut dismissed = None;
        let corner = canvas.right_top() + Vec2::new(-MARGIN, MARGIN);
        let width = MAX_WIDTH.min(canvas.width() - 2.0 * MARGIN).max(100.0);
        let area = Area::new(Id::unique("notices")).order(Order::Foreground);
        area.pivot(Align2::RIGHT_TOP)
            .fixed_pos(corner)
            .show(ctx, |ui| {
                for (index, text) in self.texts.iter().enumerate() {
                    let notice = Frame::popup(ui.style()).show(ui, |ui| {
                        ui.set_max_width(width);
                        ui.horizontal(|ui| {
                            let button = ui.add(Button::new("×").frame(false));
                            if button.on_hover_text(t("Dismiss")).clicked() {
                                dismissed = Some(index);
                            }
                            ui.add(eframe::egui::Label::new(text).wrap());
                        });
                    });
                    if notice.response.interact(Sense::click()).clicked() {
                        dismissed = Some(index);
                    }
                }
            });
        if let Some(index) = dismissed {
            self.remove(index);
        }
    }

    /// Drops what is older than its time, and plans the frame in which the next notice leaves.
    fn expire(&mut self, ctx: &Context) {
        let now = ctx.input(|input| input.time);
        for leaves in &mut self.leaves {
            if matches!(leaves, Leaves::AfterShown) {
                *leaves = Leaves::At(now + NEWS_TIME.as_secs_f64());
            }
        }
        let is_over = |leaves: &Leaves| matches!(leaves, Leaves::At(end) if *end <= now);
        while let Some(index) = self.leaves.iter().position(is_over) {
            self.remove(index);
        }
        let rest = self.leaves.iter().filter_map(|leaves| match leaves {
            Leaves::At(end) => Some(end - now),
            _ => None,
        });
        if let Some(rest) = rest.reduce(f64::min) {
            ctx.request_repaint_after(Duration::from_secs_f64(rest.max(0.0)));
        }
    }
}

#[cfg(test)]
mod tests {
    use eframe::egui::{RawInput, Vec2};

    use super::*;

    #[test]
    fn keeps_the_last_five_without_repetition() {
        let mut notices = Notices::default();
        for text in ["a", "b", "b", "c", "d", "e", "f"] {
            notices.add(text);
        }
        assert_eq!(notices.texts(), ["b", "c", "d", "e", "f"]);
    }

    #[test]
    fn news_leaves_and_problems_stay() {
        let mut notices = Notices::default();
        notices.add("the disk is full");
        notices.inform("Saved");
        let ctx = Context::default();
        let canvas = Rect::from_min_size(Default::default(), Vec2::new(600.0, 400.0));
        let mut at = |time: f64| {
            let input = RawInput {
                time: Some(time),
                ..RawInput::default()
            };
            let mut output = ctx.run_ui(input, |ui| notices.show(ui.ctx(), canvas));
            output.textures_delta.clear();
            notices.texts().len()
        };
        assert_eq!([at(100.0), at(105.9), at(106.1), at(1e6)], [2, 2, 1, 1]);
        assert_eq!(notices.texts(), ["the disk is full"]);
    }
}
