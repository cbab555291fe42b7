//! The side panel: tabs with fixed places, one per part of the window.

use eframe::egui::{
    CollapsingHeader, Rect, RichText, ScrollArea, TextStyle, TextWrapMode, Ui, UiBuilder,
    WidgetText,
};
use guideway_document::{Document, Group};

use super::findings_panel::FindingsPanel;
use super::properties::PropertiesPanel;
use super::still_part::StillPart;
use super::{display_panel, find_panel, layers_panel, render_panel, selection_panel};
use crate::action::Action;
use crate::backdrop::{FloorPlanLayer, SweptAreasLayer};
use crate::display_settings::DisplaySettings;
use crate::files::{Layer, OpenFiles};
use crate::language::{Language, language, t};
use crate::render_queue::MethodSelection;
use crate::selection::{ExactEdit, Find};
use crate::units::{Units, units};

/// Windows narrower than this begin without the panel, in points: the drawing needs the space.
const MIN_WINDOW_WIDTH: f32 = 700.0;

/// Size of the names of tabs.
const TAB_POINTS: f32 = 12.0;
/// Space beside the name of a tab, in points.
const TAB_PADDING: f32 = 3.0;

/// A tab of the side panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum SideTab {
    Layers,
    #[default]
    Properties,
    Find,
    Findings,
    View,
}

impl SideTab {
    pub(crate) const ALL: [Self; 5] = [
        Self::Layers,
        Self::Properties,
        Self::Find,
        Self::Findings,
        Self::View,
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Layers => t("Layers"),
            Self::Properties => t("Properties"),
            Self::Find => t("Find"),
            Self::Findings => t("Findings"),
            Self::View => t("View"),
        }
    }
}

/// The tab in front, and whether the user wants the panel.
#[derive(Default)]
pub(crate) struct SideTabs {
    pub(crate) tab: SideTab,
    /// `None` until the user decides: then the width of the window does.
    pub(crate) wanted: Option<bool>,
    properties: StillPart<PropertiesKey>,
}

/// All that the Properties tab shows, while no field of it is edited.
#[derive(PartialEq)]
struct PropertiesKey {
    /// Index of the active file, and the revision of its document unless an edit has it.
    file: Option<(usize, Option<u64>)>,
    is_busy: bool,
    exact_edit: ExactEdit,
    language: Language,
    units: Units,
}

impl SideTabs {
    /// Tabs that the user wants, hides or has not decided about yet.
    pub(crate) fn new(wanted: Option<bool>) -> Self {
        Self {
            wanted,
            ..Self::default()
        }
    }

    /// Returns `true` if the panel is shown in a window of this width in points.
    pub(crate) fn is_open(&self, window_width: f32) -> bool {
        self.wanted.unwrap_or(window_width >= MIN_WINDOW_WIDTH)
    }

    /// Shows the panel if it is hidden, and the other way round.
    pub(crate) fn toggle(&mut self, window_width: f32) {
        self.wanted = Some(!self.is_open(window_width));
    }

    /// Shows a tab.
    pub(crate) fn open(&mut self, tab: SideTab) {
        (self.tab, self.wanted) = (tab, Some(true));
    }
}

/// The parts whose fields the side panel edits.
pub(crate) struct SidePanel<'a> {
    pub(crate) tabs: &'a mut SideTabs,
    pub(crate) files: &'a mut OpenFiles,
    pub(crate) floor_plan: &'a mut FloorPlanLayer,
    pub(crate) exact_edit: &'a mut ExactEdit,
    pub(crate) find: &'a mut Find,
    pub(crate) settings: &'a mut DisplaySettings,
    pub(crate) swept_areas: &'a mut SweptAreasLayer,
    pub(crate) findings: &'a mut FindingsPanel,
    /// The level or vehicle type under the pointer, with the index of its file.
    pub(crate) hovered_group: &'a mut Option<(usize, Group)>,
    pub(crate) properties: &'a mut PropertiesPanel,
    pub(crate) methods: &'a MethodSelection,
}

impl SidePanel<'_> {
    /// Shows the tab in front and returns the actions of clicks.
    pub(crate) fn show(&mut self, ui: &mut Ui) -> Vec<Action> {
        // Long content must not push the edge of the panel.
        let rect = ui.available_rect_before_wrap();
        let mut inner = ui.new_child(UiBuilder::new().max_rect(rect));
        inner.shrink_clip_rect(rect);
        let actions = self.show_inside(&mut inner, rect);
        ui.advance_cursor_after_rect(rect);
        actions
    }

    fn show_inside(&mut self, ui: &mut Ui, rect: Rect) -> Vec<Action> {
        ui.set_max_width(rect.width());
        self.show_tabs(ui);
        ui.separator();
        let mut actions = Vec::new();
        let tab = self.tabs.tab;
        let scroll = ScrollArea::vertical().id_salt(tab.name());
        scroll.auto_shrink(false).show(ui, |ui| {
            ui.style_mut().wrap_mode = Some(TextWrapMode::Wrap);
            self.show_tab(tab, ui, &mut actions);
        });
        actions
    }

    fn show_tabs(&mut self, ui: &mut Ui) {
        ui.horizontal_wrapped(|ui| {
            // The names of all languages fit into one row of the panel's first width.
            ui.spacing_mut().item_spacing.x = 0.0;
            ui.spacing_mut().button_padding.x = TAB_PADDING;
            let is_in_front = self.tabs.tab == SideTab::Findings;
            let title = |tab: SideTab, is_short| match tab {
                SideTab::Findings => {
                    FindingsPanel::title(self.files, TAB_POINTS, is_short, is_in_front)
                }
                _ => RichText::new(tab.name()).size(TAB_POINTS).into(),
            };
            // More findings must not push the tabs into a second row.
            let widths = SideTab::ALL.map(|tab| {
                let title: WidgetText = title(tab, false);
                let wrap = Some(TextWrapMode::Extend);
                let title = title.into_galley(ui, wrap, f32::INFINITY, TextStyle::Button);
                title.size().x + 2.0 * TAB_PADDING
            });
            let is_short = widths.iter().sum::<f32>() > ui.available_width();
            for tab in SideTab::ALL {
                let title = title(tab, is_short);
                ui.selectable_value(&mut self.tabs.tab, tab, title);
            }
        });
    }

    fn show_tab(&mut self, tab: SideTab, ui: &mut Ui, actions: &mut Vec<Action>) {
        match tab {
            SideTab::Layers => {
                let (files, plan) = (&mut *self.files, &mut *self.floor_plan);
                let hovered = layers_panel::show(ui, files, plan, self.settings, actions);
                *self.hovered_group = hovered;
            }
            SideTab::Properties => {
                let key = PropertiesKey {
                    file: self.files.active().map(|layer| {
                        let revision = layer.document().map(Document::revision);
                        (self.files.active_index(), revision)
                    }),
                    is_busy: self.files.active().is_some_and(Layer::is_busy),
                    exact_edit: *self.exact_edit,
                    language: language(),
                    units: units(),
                };
                self.properties.stay();
                self.tabs.properties.show(ui, key, |ui| {
                    selection_panel::show(ui, self.files, self.exact_edit, actions);
                    ui.separator();
                    self.properties.show(ui, self.files, actions);
                });
            }
            SideTab::Find => find_panel::show(ui, self.files, self.find, actions),
            SideTab::Findings => self.findings.show(ui, self.files, actions),
            SideTab::View => {
                let (settings, swept_areas) = (&mut *self.settings, &mut *self.swept_areas);
                display_panel::show(ui, self.files, settings, swept_areas, actions);
                CollapsingHeader::new(t("Rendering")).show(ui, |ui| {
                    render_panel::show(ui, self.files, self.methods, actions);
                });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn narrow_window_hides_the_panel_until_the_user_wants_it() {
        let mut tabs = SideTabs::default();
        assert!(tabs.is_open(1200.0) && !tabs.is_open(340.0));
        tabs.toggle(340.0);
        assert!(tabs.is_open(1200.0) && tabs.is_open(340.0));
        tabs.toggle(1200.0);
        assert!(!tabs.is_open(1200.0));
        tabs.open(SideTab::Find);
        assert!(tabs.is_open(340.0) && tabs.tab == SideTab::Find);
    }
}
