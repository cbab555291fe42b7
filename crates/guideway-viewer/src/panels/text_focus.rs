//! Gives the keyboard focus to a text field with its text selected: what is typed replaces it.

use eframe::egui::text::{CCursor, CCursorRange};
use eframe::egui::text_edit::TextEditState;
use eframe::egui::{Context, Response};

/// Focuses a field that shows this text, and selects all of it.
pub(super) fn focus_all(ctx: &Context, field: &Response, text: &str) {
    // egui keeps the place of the cursor in the last text of a field.
    let mut state = TextEditState::load(ctx, field.id).unwrap_or_default();
    let [start, end] = [0, text.chars().count()].map(CCursor::new);
    state
        .cursor
        .set_char_range(Some(CCursorRange::two(start, end)));
    state.store(ctx, field.id);
    field.request_focus();
}
