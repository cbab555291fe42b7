//! New layouts, networks of drawings, the clipboard, and edits of the selection by keys.

use std::sync::Arc;

use eframe::egui::Context;
use guideway_document::Document;
use guideway_layout::{Layout, Level, UserError};
use guideway_spline::{Affine, Point};

use super::state::App;
use crate::action::{GroupRequest, TypeRename};
use crate::command::Command;
use crate::editing::EditTask;
use crate::files::{Layer, NewLayout};
use crate::language::t;
use crate::panels::SideTab;
use crate::selection::{
    CopiedElements, DUPLICATE_OFFSET_PX, PointerPlace, arrange_command, counts, question,
    selection_command,
};
use crate::services::AppServices;
use crate::tools::HIT_RADIUS_PX;

/// Opacity of a drawing below the network that was made of it.
const DRAWING_OPACITY: f32 = 0.3;
/// Name of the only level of a new layout.
const FIRST_LEVEL: &str = "level 1";

impl App {
    /// Begins a new layout, beside the open files.
    pub(super) fn new_layout(&mut self) {
        let (method, options) = (self.methods.name(), self.settings.scene_options());
        let (files, new) = (&mut self.files, NewLayout::By(empty_layout));
        files.open_untitled("untitled", new, method, options);
        self.tools.clear_hover();
    }

    /// Opens the network of the open panel as a new layout; the drawing is faded below it.
    pub(super) fn make_network(&mut self) {
        let Some(Ok(drafted)) = self.bottom.network.network(&self.files) else {
            return;
        };
        let new = NewLayout::Ready(Arc::clone(&drafted.layout));
        let (method, options) = (self.methods.name(), self.settings.scene_options());
        let name = self.files.active().map(Layer::name).unwrap_or_default();
        let stem = name.split('.').next().unwrap_or_default();
        let stem = format!("{stem}-network");
        if let Some(drawing) = self.files.active_mut() {
            drawing.look.opacity = drawing.look.opacity.min(DRAWING_OPACITY);
            // Those of the network lie at the same places.
            drawing.look.has_names = false;
        }
        let files = &mut self.files;
        files.open_untitled(&stem, new, method, options);
        self.bottom.view = None;
        self.side.open(SideTab::Findings);
        self.tools.clear_hover();
    }

    /// Returns `true` if something is selected.
    pub(super) fn has_selection(&self) -> bool {
        let document = self.files.document();
        document.is_some_and(|document| !document.selected().is_empty())
    }

    /// Copies the selected elements; the text on the clipboard of the system counts them.
    pub(super) fn copy_elements(&mut self, cuts: bool, ctx: &Context) {
        let Some(layer) = self.files.active() else {
            return;
        };
        let Some(document) = layer.document().filter(|_| self.has_selection()) else {
            return;
        };
        let selected = document.selected();
        let text = counts(selected).join(", ");
        let from = (!cuts).then(|| layer.path().to_owned());
        match document.clip(selected) {
            Ok(clip) => self.copied = Some(CopiedElements::new(clip, from)),
            Err(error) => return self.dialogs.notices.add(error.to_string()),
        }
        ctx.copy_text(format!("Guideway: {text}"));
        if cuts {
            self.delete_selection();
        }
    }

    /// Deletes what is selected. Asks what becomes of the elements of levels and vehicle types.
    pub(super) fn delete_selection(&mut self) {
        let groups = self.files.document().filter(|d| d.selected().has_groups());
        let edit = match groups {
            Some(document) => {
                let all = document.selected().clone();
                self.dialogs.deletion.ask(document, all)
            }
            None => Some(EditTask::edit(Document::delete_selection)),
        };
        if let Some(edit) = edit {
            self.tools.abort_drag();
            self.edit(edit);
        }
    }

    /// Pastes copied elements: into their own file beside the originals, into others at the same
    /// place.
    pub(super) fn paste_elements(&mut self) {
        let Some(layer) = self.files.active() else {
            return;
        };
        let Some(copied) = &mut self.copied else {
            let notice = t("Nothing is copied; select elements and press Ctrl+C first");
            return self.dialogs.notices.add(notice);
        };
        let px_per_m = self.canvas.camera.view().map(|view| view.px_per_m());
        let offset_m = px_per_m.map_or(1.0, |px_per_m| DUPLICATE_OFFSET_PX / px_per_m);
        let paste = copied.paste_into(layer.path(), Point::new(offset_m, -offset_m));
        self.edit(paste);
    }

    /// Opens the dialog of a new level or vehicle type.
    pub(super) fn show_group(&mut self, request: GroupRequest) {
        self.tools.abort_drag();
        match self.files.document() {
            Some(document) => self.dialogs.group.ask(request, document),
            None => self
                .dialogs
                .notices
                .add(t("The file is busy; try again in a moment")),
        }
    }

    /// Renames a vehicle type in the document, and then for new paths and routes.
    pub(super) fn rename_vehicle_type(&mut self, edit: EditTask, rename: TypeRename) {
        let (edit, outcome) = edit.with_outcome();
        self.renames.push((outcome, rename));
        self.edit(edit);
    }

    /// Ends the renames of vehicle types that are complete.
    pub(super) fn poll_renames(&mut self) {
        for (outcome, rename) in std::mem::take(&mut self.renames) {
            match outcome.poll() {
                None => self.renames.push((outcome, rename)),
                Some(Ok(())) => self.follow_rename(&rename),
                Some(Err(notice)) => self.dialogs.notices.add(notice),
            }
        }
    }

    /// Gives new paths and routes the new name of their vehicle type.
    pub(super) fn follow_rename(&mut self, TypeRename { old, new }: &TypeRename) {
        let template = &mut self.tools.template;
        self.new_edges.rename_type(template, old, new);
        let of_route = self.bottom.route.vehicle_type.as_mut();
        if let Some(name) = of_route.filter(|name| *name == old) {
            name.clone_from(new);
        }
    }

    /// Runs a command that arranges the selection, or asks for the number or name that it needs.
    pub(super) fn arrange(&mut self, command: Command, ctx: &Context) {
        self.tools.abort_drag();
        let document = self.files.document();
        match document.and_then(|document| question(command, document)) {
            Some(Ok(question)) => return self.dialogs.text.ask(question),
            Some(Err(error)) => return self.dialogs.notices.add(error.to_string()),
            None => {}
        }
        let view = self.canvas.camera.view();
        let pointer = self
            .canvas
            .event_px(ctx)
            .zip(view)
            .map(|(at_px, view)| PointerPlace {
                at_m: view.world_from_pixel(at_px),
                reach_m: HIT_RADIUS_PX / view.px_per_m(),
            });
        if let Some(task) = arrange_command(command, pointer) {
            self.edit(task);
        }
    }

    /// Moves the selection by one step of the grid in the direction of an arrow key. Returns
    /// `false` if no element is selected.
    pub(super) fn nudge(&mut self, command: Command) -> bool {
        let Some(view) = self.canvas.camera.view() else {
            return false;
        };
        let document = self.files.document();
        let has_elements = document.is_some_and(|document| document.selected().has_elements());
        if self.tools.tool().adds_points() || !has_elements {
            return false;
        }
        let step_m = self.settings.grid_step_m(&view, self.canvas.px_per_point());
        let (x, y) = match command {
            Command::PanLeft => (-1.0, 0.0),
            Command::PanRight => (1.0, 0.0),
            Command::PanUp => (0.0, 1.0),
            _ => (0.0, -1.0),
        };
        let by = Affine::translation(Point::new(x, y) * step_m);
        self.edit(EditTask::edit(move |document: &mut Document| {
            document.transform_selection("move", by)
        }));
        true
    }

    /// Edits the selection, or takes a step of the history. What a drag has done so far stays.
    pub(super) fn edit_selection(&mut self, command: Command) {
        self.tools.abort_drag();
        let view = self.canvas.camera.view();
        if let Some(task) = selection_command(command, view.as_ref()) {
            self.edit(task);
        }
    }
}

/// A layout of one level.
#[expect(clippy::unnecessary_wraps, reason = "the form of `NewLayout::By`")]
fn empty_layout(_: &dyn AppServices) -> Result<Layout, UserError> {
    let level = Level {
        id: FIRST_LEVEL.to_owned(),
        ..Level::default()
    };
    Ok(Layout {
        levels: vec![level],
        ..Layout::default()
    })
}
