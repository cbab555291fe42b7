//! Labels for numbers that change from frame to frame: each sign is laid out once and cached, while
//! a text that differs in one digit would be shaped anew as a whole, which takes a quarter of a
//! frame.

use std::sync::Arc;

use eframe::egui::{
    Color32, FontId, Galley, Response, Role, Sense, TextStyle, Ui, WidgetInfo, vec2,
};

/// The signs of numbers. egui forgets a layout that no frame asks for, so each frame asks for all.
const SIGNS: &str = "0123456789.,-:xym";

/// The layouts of all signs, for one frame.
pub(super) struct Digits {
    font: FontId,
    color: Color32,
    known: Vec<(char, Arc<Galley>)>,
}

impl Digits {
    pub(super) fn new(ui: &Ui) -> Self {
        let font = TextStyle::Monospace.resolve(ui.style());
        let color = ui.visuals().text_color();
        let layout = |sign: char| (sign, layout_of(ui, sign, &font, color));
        let known = SIGNS.chars().map(layout).collect();
        Self { font, color, known }
    }

    /// Shows a line of monospaced signs, without those that join or combine.
    pub(super) fn show(&self, ui: &mut Ui, text: &str) -> Response {
        let zero = self.known[0].1.size();
        // Whole pixels keep the signs at equal distances.
        let scale = ui.pixels_per_point();
        let advance = (zero.x * scale).round() / scale;
        let width = advance * text.chars().count() as f32;
        let (rect, response) = ui.allocate_exact_size(vec2(width, zero.y), Sense::hover());
        for (number, sign) in text.chars().enumerate().filter(|(_, sign)| *sign != ' ') {
            let at = rect.min + vec2(advance * number as f32, 0.0);
            let known = self.known.iter().find(|(known, _)| *known == sign);
            let galley = match known {
                Some((_, galley)) => Arc::clone(galley),
                None => layout_of(ui, sign, &self.font, self.color),
            };
            ui.painter().galley(at, galley, self.color);
        }
        response.widget_info(|| WidgetInfo::labeled(Role::Label, ui.is_enabled(), text));
        response
    }
}

fn layout_of(ui: &Ui, sign: char, font: &FontId, color: Color32) -> Arc<Galley> {
    let painter = ui.painter();
    painter.layout_no_wrap(sign.to_string(), font.clone(), color)
}
