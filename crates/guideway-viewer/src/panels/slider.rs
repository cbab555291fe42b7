//! A slider from 0 to 1, without its number.

use eframe::egui::{Response, Sense, Slider, Ui, remap_clamp};

/// Shows a slider. A click counts too whose press and release come in one slow frame: the slider of
/// egui knows drags only.
pub(super) fn slider(ui: &mut Ui, part: &mut f32) -> Response {
    let response = ui.add(Slider::new(part, 0.0..=1.0).show_value(false));
    let mut response = response.interact(Sense::click());
    let is_new = response.clicked() && ui.input(|input| input.pointer.any_pressed());
    if let (true, Some(at)) = (is_new, response.interact_pointer_pos()) {
        let handle = 0.4 * ui.spacing().interact_size.y;
        let rail = response.rect.x_range().shrink(handle);
        let clicked = remap_clamp(at.x, rail.min..=rail.max, 0.0..=1.0);
        if clicked != *part {
            *part = clicked;
            response.mark_changed();
        }
    }
    response
}
