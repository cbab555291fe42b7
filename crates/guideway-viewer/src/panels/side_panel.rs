//! The side panel: one collapsible section per part of the window.

use eframe::egui::{CollapsingHeader, Ui};

use super::findings_panel::FindingsPanel;
use super::properties::PropertiesPanel;
use super::{display_panel, files_panel, find_panel, path_panel, render_panel, selection_panel};
use crate::action::Action;
use crate::backdrop::{FloorPlanLayer, SweptAreasLayer};
use crate::display_settings::DisplaySettings;
use crate::files::OpenFiles;
use crate::render_queue::MethodSelection;
use crate::selection::{ExactEdit, Find};

/// The parts whose fields the side panel edits.
pub(crate) struct SidePanel<'a> {
    pub(crate) files: &'a mut OpenFiles,
    pub(crate) floor_plan: &'a mut FloorPlanLayer,
    pub(crate) exact_edit: &'a mut ExactEdit,
    pub(crate) find: &'a mut Find,
    pub(crate) settings: &'a mut DisplaySettings,
    pub(crate) swept_areas: &'a mut SweptAreasLayer,
    pub(crate) findings: &'a mut FindingsPanel,
    pub(crate) properties: &'a mut PropertiesPanel,
    pub(crate) methods: &'a MethodSelection,
}

impl SidePanel<'_> {
    /// Shows all sections and returns the actions of clicks.
    pub(crate) fn show(&mut self, ui: &mut Ui) -> Vec<Action> {
        let mut actions = Vec::new();
        let section = |title, is_open| CollapsingHeader::new(title).default_open(is_open);
        section("Files", true).show(ui, |ui| {
            files_panel::show(ui, self.files, self.floor_plan, &mut actions);
        });
        section("Properties", true).show(ui, |ui| {
            path_panel::show(ui, self.files);
            self.properties.show(ui, self.files, &mut actions);
        });
        section("Selection", true).show(ui, |ui| {
            selection_panel::show(ui, self.files, self.exact_edit, &mut actions);
        });
        section("Find", true).show(ui, |ui| {
            find_panel::show(ui, self.files, self.find, &mut actions);
        });
        section("Display", false).show(ui, |ui| {
            let (settings, swept_areas) = (&mut *self.settings, &mut *self.swept_areas);
            display_panel::show(ui, self.files, settings, swept_areas, &mut actions);
        });
        section("Findings", false).show(ui, |ui| {
            self.findings.show(ui, self.files, &mut actions);
        });
        section("Rendering", false).show(ui, |ui| {
            render_panel::show(ui, self.files, self.methods, &mut actions);
        });
        actions
    }
}
