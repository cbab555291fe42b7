//! The levels and the vehicle types of a file in the Layers tab, with buttons that add and change
//! them.

use eframe::egui::{Button, CollapsingHeader, Label, Role, Ui, WidgetInfo};
use guideway_document::Document;

use crate::action::{Action, GroupRequest};
use crate::editing::EditTask;
use crate::language::{say, t};

/// Most rows of a list: a file may have as many vehicle types as paths.
const MAX_ROWS: usize = 200;

/// Shows the levels and the vehicle types of the file of this index.
pub(super) fn show(ui: &mut Ui, index: usize, document: &Document, actions: &mut Vec<Action>) {
    let mut list = GroupList { index, actions };
    list.show_levels(ui, document);
    list.show_vehicle_types(ui, document);
}

struct GroupList<'a> {
    index: usize,
    actions: &'a mut Vec<Action>,
}

impl GroupList<'_> {
    /// Shows the levels, each with a switch; the one that is drawn on is marked.
    fn show_levels(&mut self, ui: &mut Ui, document: &Document) {
        let levels = levels(document);
        ui.horizontal(|ui| {
            if levels.len() > 1 {
                let shows_all = levels.iter().all(|(l, _)| document.shows_level(Some(*l)));
                let all = Button::selectable(shows_all, t("All levels")).truncate();
                if ui.add(all).clicked() && !shows_all {
                    self.change(EditTask::view_change(|d: &mut Document| d.show_level(None)));
                }
            }
            if ui.small_button(t("Add level")).clicked() {
                self.request(GroupRequest::NewLevel);
            }
        });
        let is_only = levels.len() == 1;
        for (level, name) in levels {
            ui.horizontal(|ui| {
                if is_only {
                    ui.add(Label::new(&name).truncate());
                } else {
                    self.show_switches(ui, document, level, &name);
                }
                if more_button(ui, &say!("Change or delete the level {name}", name)) {
                    self.request(GroupRequest::Level(level));
                }
            });
        }
    }

    fn show_switches(&mut self, ui: &mut Ui, document: &Document, level: u32, name: &str) {
        let mut is_shown = document.shows_level(Some(level));
        let hint = say!("Shows {name} beside other levels", name);
        let switch = ui.checkbox(&mut is_shown, "").on_hover_text(&hint);
        switch.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, is_shown, &hint));
        if switch.changed() {
            self.change(EditTask::view_change(move |document: &mut Document| {
                document.set_level_shown(level, is_shown);
            }));
        }
        let is_drawn_on = document.level() == Some(level);
        let button = Button::selectable(is_drawn_on, name).truncate();
        let button = ui
            .add(button)
            .on_hover_text(t("Shows it alone, and draws on it"));
        if button.clicked() {
            self.change(EditTask::view_change(move |document: &mut Document| {
                document.show_level(Some(level));
            }));
        }
    }

    fn show_vehicle_types(&mut self, ui: &mut Ui, document: &Document) {
        let header = CollapsingHeader::new(t("Vehicle types"));
        header
            .id_salt(("vehicle types", self.index))
            .show(ui, |ui| {
                let names = document.layout().vehicle_type_names();
                for name in names.iter().take(MAX_ROWS) {
                    ui.horizontal(|ui| {
                        ui.add(Label::new(*name).truncate());
                        if more_button(ui, &say!("Change or delete the vehicle type {name}", name))
                        {
                            self.request(GroupRequest::VehicleType((*name).to_owned()));
                        }
                    });
                }
                if let Some(more @ 1..) = names.len().checked_sub(MAX_ROWS) {
                    ui.small(say!("{more} more", more));
                }
                if ui.small_button(t("Add vehicle type")).clicked() {
                    self.request(GroupRequest::NewVehicleType);
                }
            });
    }

    fn change(&mut self, edit: EditTask) {
        self.actions.push(Action::Activate(self.index));
        self.actions.push(Action::Edit(edit));
    }

    fn request(&mut self, request: GroupRequest) {
        self.actions.push(Action::Activate(self.index));
        self.actions.push(Action::ShowGroup(request));
    }
}

/// A small button with points, which opens the dialog that its hint names.
fn more_button(ui: &mut Ui, hint: &str) -> bool {
    let button = ui.small_button("…").on_hover_text(hint);
    button.widget_info(|| WidgetInfo::labeled(Role::Button, true, hint));
    button.clicked()
}

/// Row and name of every level.
fn levels(document: &Document) -> Vec<(u32, String)> {
    let levels = document.layout().levels.iter().zip(0..);
    let levels = levels.map(|(level, row)| (row, level.name_or_id().to_owned()));
    levels.collect()
}
