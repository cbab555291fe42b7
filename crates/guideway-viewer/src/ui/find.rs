use eframe::egui::{Key, TextEdit, Ui};
use guideway_document::{Combine, Found, search};

use crate::app::App;

const MOST_FOUND: usize = 30;

impl App {
    /// Looks for names, and selects by queries.
    pub(super) fn finder(&mut self, ui: &mut Ui) {
        let name = ui.label("Name");
        let field = TextEdit::singleline(&mut self.find.text).hint_text("path, node or station");
        let field = ui.add(field).labelled_by(name.id);
        if std::mem::take(&mut self.find.wants_focus) {
            field.request_focus();
        }
        if field.changed() {
            let found = self
                .document()
                .map(|document| search(document.layout(), &self.find.text, MOST_FOUND));
            self.find.found = found.unwrap_or_default();
        }
        let is_done = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let mut fly_to = self.find.found.first().copied().filter(|_| is_done);
        if let Some(document) = self.document() {
            let layout = document.layout();
            for &what in &self.find.found {
                let kind = match what {
                    Found::Path(_) => "path",
                    Found::Node(_) => "node",
                    Found::Station(_) => "station",
                };
                // A row that came with a file that was read again may be no more.
                if is_there(what, layout)
                    && ui.link(format!("{kind} {}", what.id(layout))).clicked()
                {
                    fly_to = Some(what);
                }
            }
        }
        if let Some(what) = fly_to {
            self.fly_to(what);
        }
        let name = ui.label("Query");
        let field =
            TextEdit::singleline(&mut self.find.query).hint_text("maxSpeed > 1 and id ~ dock");
        let field = ui.add(field).labelled_by(name.id);
        if field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
            self.select_where(Combine::Replace);
        }
        ui.horizontal(|ui| {
            for (label, how) in [
                ("Select these", Combine::Replace),
                ("Add these", Combine::Add),
                ("Take these away", Combine::Remove),
            ] {
                if ui.button(label).clicked() {
                    self.select_where(how);
                }
            }
        });
        if let Some(trouble) = &self.find.query_trouble {
            ui.colored_label(ui.visuals().error_fg_color, trouble);
        }
    }
}

fn is_there(what: Found, layout: &guideway_layout::Layout) -> bool {
    match what {
        Found::Path(row) => (row as usize) < layout.paths.len(),
        Found::Node(row) => (row as usize) < layout.nodes.len(),
        Found::Station(row) => (row as usize) < layout.stations.len(),
    }
}
