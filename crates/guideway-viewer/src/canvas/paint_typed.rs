//! Paints the strip of typed input at the bottom of the canvas.

use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Vec2, vec2};

use super::paint_draw_list::color32;
use super::paint_gesture::SELECTION_COLOR;
use super::screen::Screen;
use crate::display_settings::DisplaySettings;
use crate::language::t;
use crate::tools::{FORMS, TypedText};

const TEXT_POINTS: f32 = 15.0;
const HINT_POINTS: f32 = 12.0;
const SIZE: Vec2 = vec2(420.0, 28.0);
/// Distance from the bottom of the canvas, above the scale bar.
const BOTTOM: f32 = 56.0;
const ERROR_COLOR: Color32 = Color32::from_rgb(200, 40, 40);

/// Paints the text, and the forms that it may have or what is wrong with it.
pub(super) fn paint_typed(
    painter: &Painter,
    screen: Screen,
    settings: &DisplaySettings,
    typed: &TypedText,
) {
    let center = screen.rect.center_bottom() - vec2(0.0, BOTTOM);
    let rect = Rect::from_center_size(center, SIZE);
    let background = color32(settings.background());
    let ink = color32(settings.decoration_style(1.0).ink);
    painter.rect_filled(rect.expand(2.0), 4.0, SELECTION_COLOR);
    painter.rect_filled(rect, 3.0, background);
    let left: Pos2 = rect.left_center() + vec2(8.0, 0.0);
    let text = format!("{}|", typed.text);
    let font = FontId::monospace(TEXT_POINTS);
    painter.text(left, Align2::LEFT_CENTER, text, font, ink);
    let (note, color) = match &typed.error {
        Some(error) => (error.as_str(), ERROR_COLOR),
        None => (t(FORMS), ink.gamma_multiply(0.7)),
    };
    let font = FontId::proportional(HINT_POINTS);
    let galley = painter.layout(note.to_owned(), font, color, SIZE.x);
    let corner = rect.left_bottom() + vec2(0.0, 6.0);
    let back = Rect::from_min_size(corner, galley.size()).expand(3.0);
    painter.rect_filled(back, 2.0, background);
    painter.galley(corner, galley, color);
}
