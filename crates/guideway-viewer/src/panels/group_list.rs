//! The levels and the vehicle types of a file in the Layers tab: clicks select them as they select
//! elements, menus have their commands, and buttons add more.

use eframe::egui::{Button, CollapsingHeader, RadioButton, Response, Role, Ui, WidgetInfo};
use guideway_document::{Document, Elements, Group, SelectMode, levels_by_height};

use super::menu_bar::command_entries;
use crate::action::{Action, GroupRequest};
use crate::command::ContextPlace;
use crate::editing::EditTask;
use crate::language::{say, t};

/// Most rows of a list: a file may have as many vehicle types as paths.
const MAX_ROWS: usize = 200;

/// Shows the levels and the vehicle types of the file of this index, which may be the active one.
/// Returns the one under the pointer.
pub(super) fn show(
    ui: &mut Ui,
    (index, is_active): (usize, bool),
    document: &Document,
    actions: &mut Vec<Action>,
) -> Option<Group> {
    let mut list = GroupList {
        index,
        is_active,
        document,
        actions,
        hovered: None,
    };
    list.show_levels(ui);
    list.show_vehicle_types(ui);
    list.hovered
}

struct GroupList<'a> {
    index: usize,
    is_active: bool,
    document: &'a Document,
    actions: &'a mut Vec<Action>,
    hovered: Option<Group>,
}

impl GroupList<'_> {
    /// Shows the levels, each with a switch; the one that is drawn on is marked.
    fn show_levels(&mut self, ui: &mut Ui) {
        let levels = levels(self.document);
        ui.horizontal(|ui| {
            if levels.len() > 1 {
                let shows_level = |level| self.document.shows_level(Some(level));
                let shows_all = levels.iter().all(|(level, _)| shows_level(*level));
                let all = Button::selectable(shows_all, t("All levels")).truncate();
                if ui.add(all).clicked() && !shows_all {
                    self.change(|document| document.show_level(None));
                }
            }
            if ui.small_button(t("Add level")).clicked() {
                self.request(GroupRequest::NewLevel);
            }
        });
        let is_only = levels.len() == 1;
        for (level, name) in levels {
            ui.horizontal(|ui| {
                if !is_only {
                    self.show_switches(ui, level, &name);
                }
                self.show_name(ui, &Group::Level(level), &name);
            });
        }
    }

    fn show_switches(&mut self, ui: &mut Ui, level: u32, name: &str) {
        let mut is_shown = self.document.shows_level(Some(level));
        let hint = say!("Shows {name} beside other levels", name);
        let switch = ui.checkbox(&mut is_shown, "").on_hover_text(&hint);
        switch.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, is_shown, &hint));
        if switch.changed() {
            self.change(move |document| document.set_level_shown(level, is_shown));
        }
        let is_drawn_on = self.document.level() == Some(level);
        let hint = say!("Shows {name} alone, and draws on it", name);
        let choice = ui.add(RadioButton::new(is_drawn_on, ""));
        let choice = choice.on_hover_text(&hint);
        choice.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, is_drawn_on, &hint));
        if choice.clicked() {
            self.change(move |document| document.show_level(Some(level)));
        }
    }

    fn show_vehicle_types(&mut self, ui: &mut Ui) {
        let header = CollapsingHeader::new(t("Vehicle types"));
        header
            .id_salt(("vehicle types", self.index))
            .show(ui, |ui| {
                let names = self.document.layout().vehicle_type_names();
                for name in names.iter().take(MAX_ROWS) {
                    ui.horizontal(|ui| {
                        let group = Group::VehicleType((*name).to_owned());
                        self.show_name(ui, &group, name);
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

    /// Shows the name, which a click selects, and a button with the commands of what is selected.
    fn show_name(&mut self, ui: &mut Ui, group: &Group, name: &str) {
        let is_selected = self.is_active && self.document.selected().contains_group(group);
        let more_width = 2.0 * ui.spacing().interact_size.y;
        let width = (ui.available_width() - more_width).max(more_width);
        let button = ui.scope(|ui| {
            ui.set_max_width(width);
            ui.add(Button::selectable(is_selected, name).truncate())
        });
        let button = button.inner;
        let modifiers = ui.input(|input| input.modifiers);
        if button.hovered() {
            self.hovered = Some(group.clone());
        }
        if button.clicked() {
            let mode = match modifiers.command || modifiers.shift {
                true if is_selected => SelectMode::Remove,
                true => SelectMode::Add,
                false => SelectMode::Replace,
            };
            self.select(group, mode);
        }
        if button.secondary_clicked() && !is_selected {
            self.select(group, SelectMode::Replace);
        }
        let mut chosen = None;
        button.context_menu(|ui| chosen = commands(ui));
        let more = ui.menu_button("…", commands);
        chosen = more.inner.flatten().or(chosen);
        let more = named(more.response, &say!("Commands for {name}", name));
        if more.clicked() && !is_selected {
            self.select(group, SelectMode::Replace);
        }
        if let Some(command) = chosen {
            self.actions.push(command);
        }
    }

    fn select(&mut self, group: &Group, mode: SelectMode) {
        let groups = Elements::of_group(group);
        self.change(move |document| document.select_elements(&groups, mode));
    }

    fn change(&mut self, change: impl FnOnce(&mut Document) + Send + 'static) {
        self.actions.push(Action::Activate(self.index));
        self.actions
            .push(Action::Edit(EditTask::view_change(change)));
    }

    fn request(&mut self, request: GroupRequest) {
        self.actions.push(Action::Activate(self.index));
        self.actions.push(Action::ShowGroup(request));
    }
}

/// The commands of a selected level or vehicle type. Returns the chosen one.
fn commands(ui: &mut Ui) -> Option<Action> {
    command_entries(ui, ContextPlace::Group.groups(), |command| {
        (command.label().to_owned(), false, true)
    })
}

/// A button with points whose name tells what it opens.
fn named(button: Response, hint: &str) -> Response {
    let button = button.on_hover_text(hint);
    button.widget_info(|| WidgetInfo::labeled(Role::Button, true, hint));
    button
}

/// Row and name of every level, the highest first.
fn levels(document: &Document) -> Vec<(u32, String)> {
    let layout = document.layout();
    let (levels, rows) = (&layout.levels, levels_by_height(layout).into_iter());
    let levels = rows.map(|row| (row, levels[row as usize].name_or_id().to_owned()));
    levels.collect()
}
