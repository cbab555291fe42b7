//! One frame: takes the results of background threads, shows all parts, and routes their actions.

use std::mem;
use std::time::Duration;

use eframe::egui::{CentralPanel, Context, CursorIcon, Frame, Panel, Ui, ViewportCommand};
use guideway_document::Document;
use guideway_spline::Affine;

use super::basics::tool_context;
use super::state::App;
use super::waiting::Input;
use crate::canvas::{CanvasPainter, CanvasPlace};
use crate::files::{Layer, LayerContext};
use crate::language::{say, set_language};
use crate::panels::{DrawingBar, MenuBar, SidePanel, StatusBar};
use crate::tools::Gesture;
use crate::units::set_units;

/// Least width of the side panel, in points.
const MIN_SIDE_PANEL_WIDTH: f32 = 180.0;
/// Height of the bottom panel until the user drags its edge, in points.
const BOTTOM_HEIGHT: f32 = 240.0;
const MIN_BOTTOM_HEIGHT: f32 = 90.0;
/// Height that the bottom panel leaves to the canvas, in points.
const MIN_CANVAS_HEIGHT: f32 = 120.0;
/// Width that the side panel leaves to the canvas, in points.
const MIN_CANVAS_WIDTH: f32 = 160.0;

impl App {
    /// Shows one frame.
    pub(crate) fn show(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        set_language(self.settings.language.unwrap_or(self.language));
        set_units(self.settings.units());
        self.poll(&ctx);
        self.take_input(&ctx);
        self.take_hover(&ctx);
        self.begin_with_picture(&ctx);
        self.follow_theme(&ctx);
        self.remember(&ctx);
        self.update_title(&ctx);
        let width = ui.available_width();
        let mut bars = mem::take(&mut self.bars);
        Panel::top("menus").show(ui, |ui| {
            let bar = MenuBar {
                commands: self.command_state(width),
                writer: &self.writer,
            };
            let actions = bar.show(ui, &mut bars.menus);
            self.apply_all(actions, &ctx);
        });
        if self.files.active().is_some() {
            Panel::top("drawing").show(ui, |ui| {
                let mut bar = DrawingBar {
                    files: &self.files,
                    canvas: &self.canvas,
                    tools: &mut self.tools,
                    settings: &mut self.settings,
                    new_edges: &mut self.new_edges,
                };
                let actions = bar.show(ui, &mut bars.drawing);
                self.apply_all(actions, &ctx);
            });
        }
        self.bars = bars;
        Panel::bottom("status").show(ui, |ui| {
            let bar = StatusBar {
                canvas: &self.canvas,
                files: &self.files,
                tools: &self.tools,
                settings: &self.settings,
                other_hit: self.other_hit.as_ref(),
                marked_findings: self.findings.marked,
            };
            bar.show(ui);
        });
        self.hovered_group = None;
        if self.side.is_open(width) {
            let most = (width - MIN_CANVAS_WIDTH).max(MIN_SIDE_PANEL_WIDTH);
            let side = Panel::right("side").default_size(self.panel_width);
            let side = side.size_range(MIN_SIDE_PANEL_WIDTH..=most);
            let shown = side.show(ui, |ui| self.show_side_panel(ui, &ctx));
            self.panel_width = shown.response.rect.width();
        }
        let typed = self.properties.leave_if_hidden();
        self.apply_all(typed, &ctx);
        if self.bottom.view.is_some() {
            let most = (ui.available_height() - MIN_CANVAS_HEIGHT).max(MIN_BOTTOM_HEIGHT);
            let bottom = Panel::bottom("tables").resizable(true);
            let bottom = bottom.default_size(BOTTOM_HEIGHT);
            let driven = self.bottom.route.driven;
            bottom.size_range(MIN_BOTTOM_HEIGHT..=most).show(ui, |ui| {
                let actions = self.bottom.show(ui, &self.files, &self.context.repaint);
                self.apply_all(actions, &ctx);
            });
            if self.bottom.route.driven != driven {
                self.follow_vehicle();
            }
        }
        CentralPanel::default().frame(Frame::NONE).show(ui, |ui| {
            self.show_canvas(ui);
            let canvas = self.canvas.screen().rect;
            let chosen = self.show_context_menu(ui);
            self.apply_all(chosen.into_iter().collect(), &ctx);
            let actions = self.welcome.show(ui, canvas, &self.files, &self.floor_plan);
            self.apply_all(actions, &ctx);
        });
        let actions = self.show_floor_plan_window(&ctx);
        self.apply_all(actions, &ctx);
        let canvas = self.canvas.screen().rect;
        let dialogs = &mut self.dialogs;
        let mut actions = dialogs.show(&ctx, &self.files, &self.context, canvas);
        actions.extend(dialogs.settings.show(&ctx, &mut self.settings));
        dialogs.about.show(&ctx, &self.adapter, self.methods.name());
        self.apply_all(actions, &ctx);
        self.had_field = ctx.text_edit_focused();
    }

    /// Shows the name of the active file in the title of the window, and whether it is saved.
    fn update_title(&mut self, ctx: &Context) {
        let title = match self.files.active() {
            // An edit in progress may be a mere selection.
            Some(layer) if layer.is_busy() => return,
            Some(layer) => {
                let is_changed = layer.document().is_some_and(Document::is_changed);
                let mark = if is_changed { " *" } else { "" };
                let name = match layer.is_untitled() {
                    true => say!("{name} (not saved yet)", name = layer.name()),
                    false => layer.name(),
                };
                format!("{name}{mark} - Guideway")
            }
            None => "Guideway".to_owned(),
        };
        if title != self.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }

    fn show_side_panel(&mut self, ui: &mut Ui, ctx: &Context) {
        let mut panel = SidePanel {
            tabs: &mut self.side,
            files: &mut self.files,
            floor_plan: &mut self.floor_plan,
            exact_edit: &mut self.exact_edit,
            find: &mut self.find,
            settings: &mut self.settings,
            swept_areas: &mut self.swept_areas,
            findings: &mut self.findings,
            hovered_group: &mut self.hovered_group,
            properties: &mut self.properties,
            methods: &self.methods,
        };
        let actions = panel.show(ui);
        self.apply_all(actions, ctx);
    }

    fn show_canvas(&mut self, ui: &mut Ui) {
        if let Some(event) = self.canvas.show(ui) {
            self.point(event);
        }
        if let Some(cursor) = self.canvas.cursor() {
            ui.ctx().set_cursor_icon(cursor);
        } else if self.bottom.picks_places() && self.canvas.pointer_px().is_some() {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        } else if let Some(at_px) = self.canvas.pointer_px()
            && let Some(context) = tool_context(&self.files, &self.canvas, &self.settings)
        {
            ui.ctx().set_cursor_icon(self.tools.cursor(&context, at_px));
        }
        let Some(view) = self.canvas.camera.view() else {
            return;
        };
        self.show_drag();
        self.request_pictures();
        let px_per_point = self.canvas.px_per_point();
        let (wait, repaint) = (self.edit_wait, &self.context.repaint);
        let active = self.files.active_index();
        for (index, layer) in self.files.layers_mut().iter_mut().enumerate() {
            if layer.is_visible {
                let line_rule = self.settings.line_rule(layer.widths, px_per_point);
                let options = self.settings.mark_options(line_rule, px_per_point);
                let options = layer.look.mark_options(options, layer.document());
                let wait = if index == active {
                    wait
                } else {
                    Duration::ZERO
                };
                let hovered = self.hovered_group.as_ref();
                let hovered = hovered.filter(|(file, _)| *file == index);
                let highlighted = hovered.map(|(_, group)| group);
                layer
                    .slot
                    .request_overlay(&view, &options, highlighted, wait, repaint);
            }
        }
        let screen = self.canvas.screen();
        let painter = CanvasPainter {
            screen,
            view,
            pointer_px: self.canvas.pointer_px(),
            modifiers: ui.input(|input| input.modifiers),
            settings: &self.settings,
            files: &self.files,
            floor_plan: &self.floor_plan,
            plan_editor: &self.plan_editor,
            swept_areas: &self.swept_areas,
            tools: &self.tools,
            other_hit: self.other_hit.as_ref(),
            marked_findings: self.findings.marked,
            route: self.shown_route(),
            changes: self.shown_changes(),
            network: self.shown_network(),
        };
        painter.paint(&ui.painter_at(screen.rect));
    }

    /// Shows the selected paths where a drag has moved them. After its end they stay there until
    /// the edit has moved them.
    fn show_drag(&mut self) {
        let by_m = match self.tools.gesture() {
            Gesture::Move { by_m, .. } => Some(*by_m),
            _ => None,
        };
        let active = self.files.active_index();
        for (index, layer) in self.files.layers_mut().iter_mut().enumerate() {
            match (by_m.filter(|_| index == active), layer.slot.document()) {
                (Some(by_m), Some(document)) => {
                    let paths = || document.selection().iter().collect();
                    let by = Affine::translation(by_m);
                    layer.picture.show_gesture(by, paths);
                }
                (None, Some(_)) => layer.picture.end_gesture(),
                (_, None) => {}
            }
        }
    }

    /// Takes the results of all background threads.
    fn poll(&mut self, ctx: &Context) {
        self.poll_layers(ctx);
        self.poll_renames();
        let answers = self.dialogs.poll();
        self.apply_all(answers, ctx);
        self.run_waiting(ctx);
        self.wait_for_first_picture(ctx);
        let LayerContext {
            services, repaint, ..
        } = &self.context;
        let has_pictures = self.files.layers().iter().all(Layer::has_picture_or_error);
        if self.methods.poll(has_pictures, ctx, services, repaint) {
            self.files.set_method(self.methods.name());
        }
        if let Some(found) = self.find.poll(self.files.document()) {
            self.zoom_to(&found);
        }
        self.refresh_findings(ctx);
        self.update_tools();
        self.swept_areas.poll(ctx);
        match self.floor_plan.poll(ctx) {
            Some(Ok(bounds)) => self.begin_floor_plan(bounds),
            Some(Err(error)) => self.dialogs.notices.add(error),
            None => {}
        }
        self.poll_files(ctx);
    }

    /// Runs the input that waits for the document, up to one that edits or asks something.
    fn run_waiting(&mut self, ctx: &Context) {
        while !self.waiting.is_empty() {
            let layer = self.files.active();
            let layer = layer.filter(|layer| self.waiting.is_for(layer.path()));
            if layer.is_some_and(|layer| layer.slot.is_editing()) {
                return;
            }
            if layer.is_none() || self.dialogs.is_modal(&self.files) {
                return self.waiting.clear();
            }
            if let Some((input, place)) = self.waiting.next() {
                self.run_postponed(input, place, ctx);
            }
        }
    }

    /// Runs an input that waited, in the view and with the pointer of its time.
    fn run_postponed(&mut self, input: Input, place: CanvasPlace, ctx: &Context) {
        if let Input::Command(command) = input
            && command.moves_camera()
        {
            return self.perform_now(command, ctx);
        }
        let present = self.canvas.exchange_place(place);
        match input {
            Input::Command(command) => self.perform_now(command, ctx),
            Input::Pointer(event) => self.point_now(event),
        }
        self.canvas.exchange_place(present);
    }

    /// Checks the active file again after a change.
    fn refresh_findings(&mut self, ctx: &Context) {
        let (now_s, options) = (ctx.input(|input| input.time), self.findings.check_options());
        let repaint = &self.context.repaint;
        let wait = self.files.active_mut().and_then(|layer| {
            let document = layer.slot.document();
            layer
                .tasks
                .refresh_findings(document, options, now_s, repaint)
        });
        if let Some(wait) = wait {
            ctx.request_repaint_after(wait);
        }
    }

    /// Takes dropped files, changes on disk, and finished writes.
    fn poll_files(&mut self, ctx: &Context) {
        for file in ctx.input(|input| input.raw.dropped_files.clone()) {
            self.open_dropped(file.path());
        }
        self.poll_project();
        self.files.poll_new_layouts();
        if let Some(written) = self.writer.poll() {
            self.end_write(written);
        }
        self.save_before_leaving();
        let notices = self.files.poll_watcher(&self.settings.scene_options());
        self.notify_all(notices);
        match self.clipboard.poll(ctx) {
            Some(Ok(news)) => self.dialogs.notices.inform(news),
            Some(Err(error)) => self.dialogs.notices.add(error.to_string()),
            None => {}
        }
    }
}
