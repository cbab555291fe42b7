//! The bottom panel: table, route, comparison and network, one at a time.

use eframe::egui::{Align, Layout, Rect, TextWrapMode, Ui, UiBuilder};

use super::table::TablePanel;
use super::{compare_panel, network_panel, route_panel};
use crate::action::Action;
use crate::background::RepaintHandle;
use crate::compare::Comparison;
use crate::files::OpenFiles;
use crate::language::t;
use crate::network_draft::NetworkDraft;
use crate::route::RouteSearch;

/// A view of the bottom panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BottomView {
    Table,
    Route,
    Compare,
    Network,
}

impl BottomView {
    const ALL: [Self; 4] = [Self::Table, Self::Route, Self::Compare, Self::Network];

    fn name(self) -> &'static str {
        match self {
            Self::Table => t("Table"),
            Self::Route => t("Route"),
            Self::Compare => t("Compare"),
            Self::Network => t("Network"),
        }
    }
}

/// The view that is open, and the state of all views.
#[derive(Default)]
pub(crate) struct BottomPanel {
    /// `None` while the panel is hidden.
    pub(crate) view: Option<BottomView>,
    pub(crate) table: TablePanel,
    pub(crate) route: RouteSearch,
    pub(crate) comparison: Comparison,
    pub(crate) network: NetworkDraft,
}

impl BottomPanel {
    /// Shows a view, or hides it if it is shown.
    pub(crate) fn toggle(&mut self, view: BottomView) {
        self.view = (self.view != Some(view)).then_some(view);
        if self.view == Some(BottomView::Route) {
            self.route.pick_again();
        }
    }

    /// Returns `true` if clicks on the drawing choose the places of a route.
    pub(crate) fn picks_places(&self) -> bool {
        self.view == Some(BottomView::Route) && self.route.is_picking()
    }

    /// Shows the open view and returns the actions of clicks.
    pub(crate) fn show(
        &mut self,
        ui: &mut Ui,
        files: &OpenFiles,
        repaint: &RepaintHandle,
    ) -> Vec<Action> {
        // Long content must not push the edge of the panel.
        let rect = ui.available_rect_before_wrap();
        let mut inner = ui.new_child(UiBuilder::new().max_rect(rect));
        inner.shrink_clip_rect(rect);
        let mut actions = Vec::new();
        self.show_inside(&mut inner, rect, files, repaint, &mut actions);
        ui.advance_cursor_after_rect(rect);
        actions
    }

    fn show_inside(
        &mut self,
        ui: &mut Ui,
        rect: Rect,
        files: &OpenFiles,
        repaint: &RepaintHandle,
        actions: &mut Vec<Action>,
    ) {
        ui.set_max_width(rect.width());
        ui.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
        ui.horizontal(|ui| {
            for view in BottomView::ALL {
                let is_open = self.view == Some(view);
                if ui.selectable_label(is_open, view.name()).clicked() && !is_open {
                    self.toggle(view);
                }
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if ui
                    .small_button("×")
                    .on_hover_text(t("Hide the panel"))
                    .clicked()
                {
                    self.view = None;
                }
            });
        });
        match self.view {
            Some(BottomView::Table) => self.table.show(ui, files, repaint, actions),
            Some(BottomView::Route) => route_panel::show(ui, files, &mut self.route, actions),
            Some(BottomView::Compare) => {
                compare_panel::show(ui, files, &mut self.comparison, actions);
            }
            Some(BottomView::Network) => network_panel::show(ui, files, &mut self.network, actions),
            None => {}
        }
    }
}
