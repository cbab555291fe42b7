use eframe::egui::{Key, TextEdit, Ui};
use guideway_document::{Element, SelectMode, search};

use crate::app::{App, Layer};
use crate::work::task::Task;

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
            self.search();
        }
        if field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
            self.find.goes_there = true;
        }
        let mut fly_to = None;
        if let Some(document) = self.document() {
            let layout = document.layout();
            for &what in &self.find.found {
                let kind = match what {
                    Element::Path(_) => "path",
                    Element::Node(_) => "node",
                    Element::Station(_) => "station",
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
            self.select_where(SelectMode::Replace);
        }
        ui.horizontal(|ui| {
            for (label, how) in [
                ("Select these", SelectMode::Replace),
                ("Add these", SelectMode::Add),
                ("Take these away", SelectMode::Remove),
            ] {
                if ui.button(label).clicked() {
                    self.select_where(how);
                }
            }
            if self.layers.get(self.active).is_some_and(Layer::is_busy) {
                ui.spinner();
            }
        });
        if let Some(trouble) = &self.find.query_trouble {
            ui.colored_label(ui.visuals().error_fg_color, trouble);
        }
    }
}

impl App {
    /// Looks for names beside the window: there may be a million.
    fn search(&mut self) {
        let layout = self
            .document()
            .map(|document| document.scene().shared_layout());
        self.find.search = layout.map(|layout| {
            let text = self.find.text.clone();
            Task::start(&self.wake, move || search(&layout, &text, MOST_FOUND))
        });
    }

    /// Takes what was found, and goes there if that was asked for.
    pub(crate) fn poll_search(&mut self) {
        let outcome = self.find.search.as_ref().and_then(Task::outcome);
        if let Some(outcome) = outcome {
            self.find.search = None;
            self.find.found = outcome.unwrap_or_default();
        }
        if self.find.search.is_none() && std::mem::take(&mut self.find.goes_there) {
            let first = self.find.found.first().copied();
            let is_there = |what: &Element| {
                self.document()
                    .is_some_and(|document| is_there(*what, document.layout()))
            };
            if let Some(first) = first.filter(is_there) {
                self.fly_to(first);
            }
        }
    }

    fn select_where(&mut self, how: SelectMode) {
        let layer = self.layers.get_mut(self.active);
        let outcome = layer.map(|layer| layer.select_where(&self.find.query, how, &self.wake));
        self.find.query_trouble = outcome.and_then(Result::err).map(|error| error.to_string());
    }
}

fn is_there(what: Element, layout: &guideway_layout::Layout) -> bool {
    match what {
        Element::Path(row) => (row as usize) < layout.paths.len(),
        Element::Node(row) => (row as usize) < layout.nodes.len(),
        Element::Station(row) => (row as usize) < layout.stations.len(),
    }
}
