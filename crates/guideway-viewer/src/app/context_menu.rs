//! The context menu of the canvas: a right click selects what is under it and offers its commands.

use eframe::egui::{Context, Popup, Ui};
use guideway_document::{Element, Elements, SelectMode};
use guideway_spline::Point;

use super::basics::{release_keyboard, tool_context};
use super::state::App;
use crate::action::Action;
use crate::command::ContextPlace;
use crate::editing::EditTask;
use crate::panels::{CommandState, command_list};

impl App {
    /// Shows the context menu if it is open. Returns the action of a click.
    pub(super) fn show_context_menu(&mut self, ui: &Ui) -> Option<Action> {
        let response = self.canvas.response()?;
        if response.secondary_clicked()
            && let Some(at) = response.interact_pointer_pos()
        {
            let at_px = self.canvas.screen().pixel(at);
            self.context_place = self.open_context(at_px, ui.ctx());
        }
        let groups = self.context_place.groups();
        let state = self.command_state(ui.ctx().content_rect().width());
        let menu = Popup::context_menu(&response);
        menu.show(|ui| command_list(ui, groups, &state))?.inner
    }

    /// Selects the element of a right click, unless it is selected, and tells its kind.
    fn open_context(&mut self, at_px: Point<f64>, ctx: &Context) -> ContextPlace {
        if self.tools.has_gesture() {
            return ContextPlace::Draft;
        }
        release_keyboard(ctx);
        let context = tool_context(&self.files, &self.canvas, &self.settings);
        let Some((element, document)) = context.and_then(|context| {
            let element = context.element_at(at_px)?;
            Some((element, context.document?))
        }) else {
            return ContextPlace::Empty;
        };
        let selected = document.selected();
        let place = match element {
            Element::Path(_) => ContextPlace::Path,
            Element::Node(_) => ContextPlace::Node,
            Element::Station(_) => ContextPlace::Station,
        };
        if !selected.contains(element) {
            self.edit(EditTask::view_change(move |document| {
                document.select_elements(&Elements::of(element), SelectMode::Replace);
            }));
        }
        place
    }

    /// The state of the commands in menus and the toolbar of a window of this width in points.
    pub(crate) fn command_state(&self, window_width: f32) -> CommandState<'_> {
        CommandState {
            files: &self.files,
            settings: &self.settings,
            has_floor_plan: !self.floor_plan.is_empty(),
            has_swept_areas: self.swept_areas.is_visible,
            has_side_panel: self.side.is_open(window_width),
            bottom: self.bottom.view,
            tool: self.tools.tool(),
        }
    }
}
