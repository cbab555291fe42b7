//! A part of a panel that is painted from the shapes of its last layout while neither the user nor
//! its content touches it: to lay out a dozen fields anew takes a third of a frame.

use std::sync::Arc;

use eframe::egui::epaint::ClippedShape;
use eframe::egui::text_selection::LabelSelectionState;
use eframe::egui::{Color32, FontId, Galley, Popup, Pos2, Rect, Style, Ui, WidgetRect};

use crate::background::lay_out_again;

/// The last layout of a part whose content is told by a key.
pub(crate) struct StillPart<K> {
    last: Option<Layout<K>>,
}

impl<K> Default for StillPart<K> {
    fn default() -> Self {
        Self { last: None }
    }
}

struct Layout<K> {
    key: K,
    place: Place,
    shapes: Vec<ClippedShape>,
    /// The widgets that take clicks and keys.
    widgets: Vec<WidgetRect>,
    used: Rect,
    /// True if the layout before was the same: egui takes a frame or two to find its sizes.
    is_settled: bool,
}

/// All that a layout depends on beside its content.
struct Place {
    space: Rect,
    clip: Rect,
    px_per_point: f32,
    style: Arc<Style>,
    /// A letter: another one means that egui has emptied its texture of letters.
    letter: Arc<Galley>,
}

impl Place {
    fn of(ui: &Ui) -> Self {
        let (font, color) = (FontId::default(), Color32::PLACEHOLDER);
        Self {
            space: ui.max_rect(),
            clip: ui.clip_rect(),
            px_per_point: ui.pixels_per_point(),
            style: ui.ctx().global_style(),
            letter: ui.painter().layout_no_wrap("0".to_owned(), font, color),
        }
    }

    fn is_same(&self, other: &Self) -> bool {
        let sizes = |place: &Self| (place.space, place.clip, place.px_per_point);
        sizes(self) == sizes(other)
            && Arc::ptr_eq(&self.style, &other.style)
            && Arc::ptr_eq(&self.letter, &other.letter)
    }
}

impl<K: PartialEq> StillPart<K> {
    /// Shows the part by `lay_out`, or the shapes of its last layout with this key.
    pub(super) fn show(&mut self, ui: &mut Ui, key: K, lay_out: impl FnOnce(&mut Ui)) {
        let (place, is_untouched) = (Place::of(ui), is_untouched(ui));
        let is_same = |last: &Layout<K>| last.key == key && last.place.is_same(&place);
        let last = self.last.take().filter(is_same);
        self.last = Some(match last {
            Some(last) if last.is_settled && is_untouched => {
                last.paint(ui);
                last
            }
            last => {
                if last.as_ref().is_some_and(|last| last.is_settled) {
                    // egui knows only after this frame which label is under the pointer.
                    lay_out_again(ui.ctx(), "a part of the window is touched");
                }
                let last = last.filter(|_| is_untouched);
                Layout::new(ui, (key, place), last, lay_out)
            }
        });
    }
}

impl<K> Layout<K> {
    /// Lays the part out; `last` is its layout in the frame before if that has the same content.
    fn new(
        ui: &mut Ui,
        (key, place): (K, Place),
        last: Option<Self>,
        lay_out: impl FnOnce(&mut Ui),
    ) -> Self {
        let (ctx, layer) = (ui.ctx().clone(), ui.layer_id());
        let shapes_before = ctx.graphics_mut(|graphics| graphics.entry(layer).next_idx().0);
        let widgets_before = ctx.viewport(|viewport| {
            let widgets = viewport.this_pass.widgets.get_layer(layer);
            widgets.count()
        });
        let used = ui.scope(lay_out).response.rect;
        let shapes = ctx.graphics_mut(|graphics| {
            let all = graphics.entry(layer).all_entries();
            all.skip(shapes_before).cloned().collect::<Vec<_>>()
        });
        let widgets = ctx.viewport(|viewport| {
            let widgets = viewport.this_pass.widgets.get_layer(layer);
            let takes_input = |widget: &&WidgetRect| widget.enabled && widget.sense.interactive();
            let widgets = widgets.skip(widgets_before).filter(takes_input);
            widgets.copied().collect()
        });
        Self {
            is_settled: last.is_some_and(|last| last.shapes == shapes),
            key,
            place,
            shapes,
            widgets,
            used,
        }
    }

    /// Paints the layout again, and leaves its widgets where clicks and keys find them.
    fn paint(&self, ui: &mut Ui) {
        let layer = ui.layer_id();
        ui.ctx().graphics_mut(|graphics| {
            let list = graphics.entry(layer);
            for shape in &self.shapes {
                list.add(shape.clip_rect, shape.shape.clone());
            }
        });
        for widget in &self.widgets {
            ui.interact(widget.rect, widget.id, widget.sense);
        }
        ui.advance_cursor_after_rect(self.used);
    }
}

/// Returns `true` if pointer, keys, menus and screen readers are elsewhere.
fn is_untouched(ui: &Ui) -> bool {
    let (ctx, rect) = (ui.ctx(), ui.clip_rect());
    let is_inside = |at: Option<Pos2>| at.is_some_and(|at| rect.contains(at));
    let is_pointed = ctx.input(|input| {
        is_inside(input.pointer.latest_pos()) || is_inside(input.pointer.press_origin())
    });
    let has_reader = || ctx.viewport(|viewport| viewport.this_pass.accesskit_state.is_some());
    let labels = || ctx.plugin::<LabelSelectionState>().lock().has_selection();
    let has_focus = || ctx.memory(|memory| memory.focused().is_some());
    !is_pointed && !has_focus() && !Popup::is_any_open(ctx) && !has_reader() && !labels()
}

#[cfg(test)]
mod tests {
    use eframe::egui::{Context, Event, Modifiers, PointerButton, RawInput, vec2};

    use super::*;

    /// A window with a still part of one button, and what was done to it.
    #[derive(Default)]
    struct Window {
        ctx: Context,
        part: StillPart<u32>,
        laid_out: u32,
        clicks: u32,
    }

    impl Window {
        /// Shows a frame with this key. Returns its shapes.
        fn frame(&mut self, key: u32, events: Vec<Event>) -> Vec<ClippedShape> {
            let input = RawInput {
                screen_rect: Some(Rect::from_min_size(Pos2::ZERO, vec2(200.0, 200.0))),
                events,
                ..RawInput::default()
            };
            let Self {
                ctx,
                part,
                laid_out,
                clicks,
            } = self;
            let mut output = ctx.run_ui(input, |ui| {
                ui.set_clip_rect(Rect::from_min_size(Pos2::ZERO, vec2(200.0, 100.0)));
                part.show(ui, key, |ui| {
                    *laid_out += 1;
                    *clicks += u32::from(ui.button(format!("button {key}")).clicked());
                });
                ui.label("below");
            });
            output.textures_delta.clear();
            output.shapes
        }

        /// The number of layouts in five frames.
        fn layouts(&mut self, key: u32) -> u32 {
            let before = self.laid_out;
            for _ in 0..5 {
                self.frame(key, Vec::new());
            }
            self.laid_out - before
        }
    }

    fn button(pos: Pos2, pressed: bool) -> Event {
        Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        }
    }

    #[test]
    fn part_is_laid_out_until_two_layouts_agree_and_again_with_another_key() {
        let mut window = Window::default();
        assert!((2..5).contains(&window.layouts(1)));
        assert_eq!(window.layouts(1), 0);
        let painted = window.frame(1, Vec::new());
        window.part = StillPart::default();
        assert_eq!(window.frame(1, Vec::new()), painted, "as a new layout");
        let other = window.frame(2, Vec::new());
        assert_ne!(other, painted);
        assert!(window.layouts(2) > 0);
        assert_eq!(window.frame(2, Vec::new()), other);
        window.ctx.set_zoom_factor(1.5);
        assert!(window.layouts(2) > 0, "letters have other sizes");
    }

    #[test]
    fn click_in_the_frame_in_which_the_pointer_comes_finds_the_button() {
        let mut window = Window::default();
        window.layouts(1);
        window.frame(1, vec![Event::PointerMoved(Pos2::new(150.0, 150.0))]);
        assert_eq!(window.layouts(1), 0, "the pointer is elsewhere");
        let at = Pos2::new(20.0, 15.0);
        window.frame(
            1,
            vec![Event::PointerMoved(at), button(at, true), button(at, false)],
        );
        assert_eq!(window.clicks, 1);
        assert_eq!(window.layouts(1), 5, "the pointer is over it");
    }
}
