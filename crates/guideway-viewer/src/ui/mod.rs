//! The window's parts.

mod bar;
mod canvas;
mod dialogs;
mod draft;
mod draw_list;
mod find;
mod findings;
mod paint;
mod side;

use eframe::egui::{CentralPanel, Frame, Panel, ScrollArea, TextWrapMode, Ui};

use crate::app::App;

impl App {
    /// Shows the viewer in a window, or in whatever else stands for one.
    pub(crate) fn show(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        self.poll(&ctx);
        self.keys(ui);
        Panel::top("menus").show(ui, |ui| self.menus(ui));
        Panel::bottom("status").show(ui, |ui| self.status(ui));
        // Of one width whatever it says: the picture must not jump as the pointer goes over it.
        Panel::right("side").exact_size(320.0).show(ui, |ui| {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                ui.style_mut().wrap_mode = Some(TextWrapMode::Wrap);
                self.side(ui);
            });
        });
        CentralPanel::default()
            .frame(Frame::NONE)
            .show(ui, |ui| self.canvas(ui));
        self.dialogs(&ctx);
    }
}
