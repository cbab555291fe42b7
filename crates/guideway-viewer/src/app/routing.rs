//! Routes actions, commands and pointer events to the part that owns the state.

use eframe::egui::{Context, Popup};
use eframe::egui_wgpu::RenderState;
use guideway_document::{Document, Element, Elements, SelectMode};
use guideway_spline::{Bounds, Point};

use super::basics::{release_keyboard, tool_context};
use super::state::App;
use crate::action::{Action, GroupRequest};
use crate::canvas::POINT_M;
use crate::command::Command;
use crate::editing::EditTask;
use crate::file_purpose::PromptKind;
use crate::files::{Layer, LayerContext};
use crate::panels::{BottomView, SideTab};
use crate::render_queue::FALLBACK_METHOD;
use crate::tools::{PointerEvent, Tool};

/// Distance of one key press of a pan command, in pixels.
const PAN_STEP_PX: f64 = 80.0;
/// Meters of the floor per meter of the screen, by the command for a fixed scale: that of plans.
const PLAN_SCALE: f64 = 100.0;
/// Scale factor of one zoom command.
const ZOOM_STEP: f64 = 1.25;

impl App {
    /// Routes the actions of a part.
    pub(super) fn apply_all(&mut self, actions: Vec<Action>, ctx: &Context) {
        for action in actions {
            self.apply(action, ctx);
        }
    }

    fn apply(&mut self, action: Action, ctx: &Context) {
        let repaint = &self.context.repaint;
        match action {
            Action::Command(command) => self.perform(command, ctx),
            Action::Edit(task) => self.edit(task),
            Action::RenameVehicleType(edit, rename) => self.rename_vehicle_type(edit, rename),
            Action::VehicleTypeRenamed(rename) => self.follow_rename(&rename),
            Action::ShowGroup(request) => self.show_group(request),
            Action::SelectByQuery(mode) => self.select_by_query(mode),
            Action::Search => self.find.search(self.files.document(), repaint),
            Action::ZoomTo(element) => self.zoom_to(&Elements::of(element)),
            Action::ZoomToGroup(group) => self.zoom_to(&Elements::of_group(&group)),
            Action::FlyTo(file, element) => self.fly_to(file, element),
            Action::Check(options) => {
                if let Some(layer) = self.files.active_mut() {
                    layer.tasks.check(layer.slot.document(), options, repaint);
                }
            }
            Action::Open(path) => self.open_any(path),
            Action::SaveAs(path) => self.save_as(path),
            Action::SaveProject(path) => self.save_project_as(path),
            Action::SaveProjectOver(path) => self.save_project(path),
            Action::SaveOver(path) => self.save(path),
            Action::SaveLossy(path, losses) => self.save_lossy(path, losses),
            Action::Browse(kind) => self.browse(kind),
            Action::Picked(picked) => {
                if let Some(action) = self.take_picked(picked) {
                    self.apply(action, ctx);
                }
            }
            Action::Export(export) => self.export_as(export),
            Action::ExportOver(export) => self.export(export),
            Action::SetFloorPlan(text) => self.set_floor_plan(&text),
            Action::PlaceFloorPlan(placement) => self.place_floor_plan(&placement),
            Action::MakeNetwork => self.make_network(),
            Action::Activate(index) => self.files.activate(index),
            Action::MoveLayer { from, to } => self.files.move_layer(from, to),
            Action::Close(index) => self.request_close(index),
            Action::CloseWithoutSaving(index) => {
                self.dialogs.leave.close();
                self.close(index);
            }
            Action::ReloadWithoutSaving => self.reload(self.files.active_index(), true),
            Action::Recover(index) => {
                self.files.recover(index, self.settings.scene_options());
            }
            Action::DiscardUnsavedWork(index) => {
                if let Some(layer) = self.files.layers_mut().get_mut(index) {
                    layer.discard_journal();
                }
            }
            Action::SetMethod(chosen) => self.set_method(chosen),
            Action::ApplyTheme => self.apply_theme(ctx),
            Action::Recolor => self.recolor(),
            Action::Notify(text) => self.dialogs.notices.add(text),
            Action::QuitWithoutSaving => self.dialogs.leave.quit_without_saving(ctx),
            Action::SaveAndLeave => self.dialogs.leave.save_first(),
        }
    }

    /// Runs a command of a menu or shortcut.
    pub(crate) fn perform(&mut self, command: Command, ctx: &Context) {
        if self.postpone(command) {
            return;
        }
        self.perform_now(command, ctx);
    }

    /// Runs a command, although others may wait for the document.
    pub(super) fn perform_now(&mut self, command: Command, ctx: &Context) {
        if command != Command::Cancel {
            let typed = self.properties.commit();
            self.apply_all(typed, ctx);
        }
        let settings = &mut self.settings;
        match command {
            Command::NewLayout => self.new_layout(),
            Command::Open => self.ask_for_file(PromptKind::Open),
            Command::OpenRecent => self.dialogs.recent.open(self.files.recent().files()),
            Command::ExampleSite => self.open_example(),
            Command::Reload => self.request_reload(),
            Command::Save => self.save_in_place(),
            Command::SaveAs => self.ask_for_file(PromptKind::SaveAs),
            Command::FloorPlan => self.ask_for_file(PromptKind::FloorPlan),
            Command::SaveProject => self.save_project_in_place(),
            Command::PlaceFloorPlan => self.plan_editor.is_open ^= true,
            Command::ExportPng => self.ask_for_file(PromptKind::ExportPng),
            Command::ExportSvg => self.ask_for_file(PromptKind::ExportSvg),
            Command::ExportPdf => self.ask_for_file(PromptKind::ExportPdf),
            Command::CopyPicture => self.copy_picture(),
            Command::Close => self.request_close(self.files.active_index()),
            Command::Quit => self.dialogs.leave.quit(ctx, &self.files),
            Command::NextFile => self.files.activate_next(),
            Command::Settings => self.dialogs.settings.is_open ^= true,
            Command::About => self.dialogs.about.is_open ^= true,
            Command::Find => {
                self.side.open(SideTab::Find);
                self.find.wants_focus = true;
            }
            Command::Table => self.bottom.toggle(BottomView::Table),
            Command::Route => self.bottom.toggle(BottomView::Route),
            Command::Compare => self.bottom.toggle(BottomView::Compare),
            Command::Network => self.bottom.toggle(BottomView::Network),
            Command::SidePanel => self.side.toggle(ctx.content_rect().width()),
            Command::Shortcuts => self.dialogs.shortcuts.is_open ^= true,
            Command::Cancel => self.cancel(ctx),
            Command::FinishPath => self.finish_path(),
            Command::Undo if self.tools.remove_last_point() => {}
            Command::Undo
            | Command::Redo
            | Command::SelectAll
            | Command::Deselect
            | Command::Duplicate
            | Command::RotateLeft
            | Command::FlipHorizontal
            | Command::FlipVertical
            | Command::Refine
            | Command::Hide
            | Command::Isolate
            | Command::ShowAll => self.edit_selection(command),
            Command::Delete => self.delete_selection(),
            Command::Cut => self.copy_elements(true, ctx),
            Command::Copy => self.copy_elements(false, ctx),
            Command::Paste => self.paste_elements(),
            Command::NewLevel => self.show_group(GroupRequest::NewLevel),
            Command::NewVehicleType => self.show_group(GroupRequest::NewVehicleType),
            Command::Array
            | Command::Rename
            | Command::MoveToLevel
            | Command::Fillet
            | Command::Split
            | Command::SplitCrossings
            | Command::Join
            | Command::Weld
            | Command::Reverse
            | Command::OneWay
            | Command::TwoWay
            | Command::Straighten
            | Command::AlignX
            | Command::AlignY
            | Command::Distribute => self.arrange(command, ctx),
            Command::ToolSelect => self.tools.select(Tool::Select),
            Command::ToolPoints => self.tools.select(Tool::Points),
            Command::ToolLine => self.tools.select(Tool::Line),
            Command::ToolArc => self.tools.select(Tool::Arc),
            Command::ToolCurve => self.tools.select(Tool::Curve),
            Command::ToolBezier => self.tools.select(Tool::Bezier),
            Command::ToolNode => self.tools.select(Tool::Node),
            Command::ToolStation => self.tools.select(Tool::Station),
            Command::ToolMeasure => self.tools.select(Tool::Measure),
            Command::PanLeft | Command::PanRight | Command::PanUp | Command::PanDown => {
                if !self.nudge(command) {
                    self.move_camera(command);
                }
            }
            Command::ZoomToAll
            | Command::ZoomToSelection
            | Command::ZoomToScale
            | Command::ZoomIn
            | Command::ZoomOut
            | Command::Back
            | Command::Forward => self.move_camera(command),
            Command::Arrows => settings.has_arrows ^= true,
            Command::Symbols => settings.has_symbols ^= true,
            Command::Labels => settings.has_labels ^= true,
            Command::Grid => settings.has_grid ^= true,
            Command::Density => settings.set_density(!settings.shows_density()),
            Command::ThesisRule => settings.is_thesis_rule ^= true,
            Command::SweptAreas => self.swept_areas.is_visible ^= true,
            Command::Dark => {
                settings.set_dark(!settings.is_dark);
                self.apply_theme(ctx);
            }
        }
    }

    fn move_camera(&mut self, command: Command) {
        let camera = &mut self.canvas.camera;
        match command {
            Command::ZoomToAll => {
                let plan = self.floor_plan.visible();
                let plan = plan.and_then(|plan| plan.bounds());
                let all = self.files.visible_bounds().into_iter().chain(plan);
                if let Some(all) = all.reduce(Bounds::union) {
                    camera.fit(all);
                }
            }
            Command::ZoomToSelection => {
                let document = self.files.document();
                if let Some(bounds) = document.and_then(Document::selection_bounds) {
                    camera.zoom_to(bounds);
                }
            }
            Command::ZoomToScale => {
                let px_per_m = self.canvas.px_per_point() / (PLAN_SCALE * POINT_M);
                self.canvas.camera.scale_center(px_per_m);
            }
            Command::ZoomIn => camera.zoom_center(ZOOM_STEP),
            Command::ZoomOut => camera.zoom_center(1.0 / ZOOM_STEP),
            Command::PanLeft => camera.pan(Point::new(PAN_STEP_PX, 0.0)),
            Command::PanRight => camera.pan(Point::new(-PAN_STEP_PX, 0.0)),
            Command::PanUp => camera.pan(Point::new(0.0, PAN_STEP_PX)),
            Command::PanDown => camera.pan(Point::new(0.0, -PAN_STEP_PX)),
            Command::Back => camera.back(),
            Command::Forward => camera.forward(),
            _ => {}
        }
    }

    /// Ends the first of these that there is: a menu, a dialog, the focus of a field, a gesture,
    /// exports and loads, a tool, the selection, notices.
    fn cancel(&mut self, ctx: &Context) {
        if Popup::is_any_open(ctx) {
            return Popup::close_all(ctx);
        }
        // A field has lost the focus to the key already.
        let is_typing = ctx.text_edit_focused() || self.properties.has_draft();
        let taken_back = self.properties.discard();
        self.apply_all(taken_back.into_iter().collect(), ctx);
        self.bottom.table.discard();
        release_keyboard(ctx);
        if self.dialogs.close() || is_typing {
            return;
        }
        if self.plan_editor.cancel(&mut self.floor_plan) {
            self.canvas.release_pointer();
            return;
        }
        if self.bottom.picks_places() {
            self.bottom.route.stop_picking();
            return;
        }
        if self.tools.has_gesture() {
            let effect = self.tools.cancel_gesture();
            self.canvas.release_pointer();
            return self.apply_effect(effect);
        }
        if self.cancel_jobs() {
            return;
        }
        let document = self.files.document();
        if self.tools.tool() != Tool::Select {
            self.tools.select(Tool::Select);
        } else if document.is_some_and(|document| !document.selected().is_empty()) {
            self.edit_selection(Command::Deselect);
        } else {
            self.dialogs.notices.clear();
        }
    }

    /// Cancels exports and loads. Returns `false` if there are none.
    fn cancel_jobs(&mut self) -> bool {
        let export = self.writer.job();
        if let Some(job) = export {
            job.cancel();
        }
        let mut is_cancelled = export.is_some();
        let layers = self.files.layers_mut().iter_mut();
        for layer in layers.filter(|layer| layer.load_job().is_some()) {
            layer.cancel_load();
            is_cancelled = true;
        }
        is_cancelled
    }

    /// Routes a pointer event to the tools.
    pub(super) fn point(&mut self, event: PointerEvent) {
        if !self.postpone_pointer(event) {
            self.point_now(event);
        }
    }

    /// Routes a pointer event to the tools, although others may wait for the document.
    pub(super) fn point_now(&mut self, event: PointerEvent) {
        if let PointerEvent::Clicked(at_px, _) = event
            && self.bottom.picks_places()
        {
            return self.pick_place(at_px);
        }
        self.pick_in_others(&event);
        self.hover_symbol(&event);
        let Some(context) = tool_context(&self.files, &self.canvas, &self.settings) else {
            if matches!(event, PointerEvent::DragEnded(_)) {
                self.tools.abort_drag();
            }
            return;
        };
        let effect = self.tools.handle(event, &context);
        self.apply_effect(effect);
    }

    fn finish_path(&mut self) {
        if let Some(context) = tool_context(&self.files, &self.canvas, &self.settings) {
            let effect = self.tools.finish_path(&context);
            self.apply_effect(effect);
        }
    }

    /// Zooms to elements and selects them.
    pub(super) fn zoom_to(&mut self, all: &Elements) {
        let bounds = self.files.document().and_then(|d| d.bounds_of_all(all));
        if let Some(bounds) = bounds {
            self.canvas.camera.zoom_to(bounds);
        }
        let all = all.clone();
        self.edit(EditTask::view_change(move |document| {
            document.select_elements(&all, SelectMode::Replace);
        }));
    }

    /// Zooms to an element of a file.
    fn fly_to(&mut self, file: usize, element: Element) {
        let document = self.files.layers().get(file).and_then(Layer::document);
        if let Some(bounds) = document.and_then(|d| d.bounds_of(element)) {
            self.canvas.camera.zoom_to(bounds);
        }
    }

    fn select_by_query(&mut self, mode: SelectMode) {
        let Some(layer) = self.files.active_mut() else {
            return;
        };
        let (query, repaint) = (&self.find.query, &self.context.repaint);
        let document = layer.slot.document();
        let result = layer.tasks.select_where(document, query, mode, repaint);
        self.find.query_error = result.err().map(|error| error.to_string());
    }

    /// Lets render methods draw on the device of the window. One that started before starts again.
    pub(crate) fn share_device(&mut self, state: &RenderState) {
        let LayerContext {
            services, device, ..
        } = &self.context;
        services.share_device(&state.adapter, &state.device, &state.queue);
        device.set(state.clone());
        if self.methods.name() != FALLBACK_METHOD {
            self.files.set_method(self.methods.name());
        }
    }

    /// Renders with another method; `None` selects the best.
    pub(crate) fn set_method(&mut self, chosen: Option<String>) {
        self.methods.choose(chosen);
        self.files.set_method(self.methods.name());
    }
}
