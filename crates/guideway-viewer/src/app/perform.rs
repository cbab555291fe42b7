use std::f64::consts::FRAC_PI_2;

use eframe::egui::Context;
use guideway_document::{Document, PathSet, SelectMode};
use guideway_spline::{Affine, Point};

use super::command::Command;
use super::{App, Gesture, PromptKind, Tool};

/// How far one press of a key goes.
const PAN_PX: f64 = 80.0;
const ZOOM: f64 = 1.25;

/// What is typed next is meant for the picture, and no longer for a field of text.
pub(crate) fn leave_field(ctx: &Context) {
    if let Some(field) = ctx.memory(|memory| memory.focused()) {
        ctx.memory_mut(|memory| memory.surrender_focus(field));
    }
}

fn select_none(document: &mut Document) {
    document.select(PathSet::new(), SelectMode::Replace);
}

impl App {
    /// Does what a key or a menu asks for.
    pub(crate) fn perform(&mut self, command: Command, ctx: &Context) {
        match command {
            Command::Open => self.ask_for(PromptKind::Open),
            Command::OpenRecent => self.choosing = Some(self.recent.files()),
            Command::Reload => self.reload(self.active, true),
            Command::Save => self.save_in_place(),
            Command::SaveAs => self.ask_for(PromptKind::SaveAs),
            Command::FloorPlan => self.ask_for(PromptKind::FloorPlan),
            Command::ExportPicture => self.ask_for(PromptKind::Picture),
            Command::ExportDrawing => self.ask_for(PromptKind::Drawing),
            Command::CopyPicture => self.copy_picture(),
            Command::Close => self.close_active(),
            Command::Quit => self.quit(ctx),
            Command::NextFile => self.active = (self.active + 1) % self.layers.len().max(1),
            Command::Find => self.find.wants_focus = true,
            Command::Keys => self.shows_keys = !self.shows_keys,
            Command::Stop => self.stop(ctx),
            Command::Finish => self.finish_path(),
            Command::Undo => self.step(Document::undo, "undo"),
            Command::Redo => self.step(Document::redo, "do again"),
            Command::SelectAll
            | Command::SelectNone
            | Command::Delete
            | Command::Duplicate
            | Command::TurnLeft
            | Command::MirrorAcross
            | Command::MirrorUp
            | Command::Refine
            | Command::Hide
            | Command::Isolate
            | Command::ShowAll => self.perform_on_selection(command),
            Command::ToolSelect => self.set_tool(Tool::Select),
            Command::ToolPoints => self.set_tool(Tool::Points),
            Command::ToolDraw => self.set_tool(Tool::Draw),
            Command::ToolMeasure => self.set_tool(Tool::Measure),
            Command::Fit
            | Command::FitSelection
            | Command::ZoomIn
            | Command::ZoomOut
            | Command::PanLeft
            | Command::PanRight
            | Command::PanUp
            | Command::PanDown
            | Command::Back
            | Command::Forward => self.perform_on_view(command),
            Command::Arrows => self.look.has_arrows ^= true,
            Command::Symbols => self.look.has_symbols ^= true,
            Command::Labels => self.look.has_labels ^= true,
            Command::Grid => self.look.has_grid ^= true,
            Command::Density => self.look.is_density ^= true,
            Command::Swept => self.swept.is_shown ^= true,
            Command::ThesisRule => self.look.is_thesis_rule ^= true,
            Command::Dark => {
                self.look.is_dark ^= true;
                self.apply_theme(ctx);
                self.recolor();
            }
        }
    }

    fn perform_on_selection(&mut self, command: Command) {
        let transform = |name, about: fn(Point<f64>) -> Affine| {
            move |document: &mut Document| match document.selection_bounds() {
                Some(bounds) => document.transform_selection(name, about(bounds.center())),
                None => Ok(()),
            }
        };
        match command {
            Command::SelectAll => self.change(Document::select_all),
            Command::SelectNone => self.change(select_none),
            Command::Hide => self.change(Document::hide_selection),
            Command::Isolate => self.change(Document::isolate_selection),
            Command::ShowAll => self.change(Document::show_all),
            Command::Delete => self.edit(Document::delete_selection),
            Command::Refine => self.edit(Document::refine_selection),
            Command::Duplicate => self.duplicate(),
            Command::TurnLeft => {
                self.edit(transform("turn", |center| {
                    Affine::rotation(FRAC_PI_2, center)
                }));
            }
            Command::MirrorAcross => {
                self.edit(transform("mirror", |center| {
                    Affine::mirror(center, Point::new(0.0, 1.0))
                }));
            }
            Command::MirrorUp => {
                self.edit(transform("mirror", |center| {
                    Affine::mirror(center, Point::new(1.0, 0.0))
                }));
            }
            _ => {}
        }
    }

    /// Copies the selection a little aside, so that the copy can be seen.
    fn duplicate(&mut self) {
        let aside_m = self
            .camera
            .view()
            .map_or(1.0, |view| 24.0 / view.px_per_m());
        self.edit(move |document| document.copy_selection(1, Point::new(aside_m, -aside_m)));
    }

    fn perform_on_view(&mut self, command: Command) {
        let zero = 0.0;
        match command {
            Command::Fit => {
                let shown = self.layers.iter().filter(|layer| layer.is_visible);
                let bounds = shown.filter_map(|layer| layer.document.as_ref()?.bounds());
                let floor = self.floor.read.as_ref().filter(|_| self.floor.is_visible);
                let bounds = bounds.chain(floor.and_then(|plan| plan.bounds()));
                if let Some(all) = bounds.reduce(guideway_spline::Bounds::union) {
                    self.camera.fit(all);
                }
            }
            Command::FitSelection => {
                if let Some(bounds) = self.document().and_then(Document::selection_bounds) {
                    self.camera.fly_to(bounds);
                }
            }
            Command::ZoomIn => self.camera.zoom_center(ZOOM),
            Command::ZoomOut => self.camera.zoom_center(1.0 / ZOOM),
            Command::PanLeft => self.camera.pan(Point::new(PAN_PX, zero)),
            Command::PanRight => self.camera.pan(Point::new(-PAN_PX, zero)),
            Command::PanUp => self.camera.pan(Point::new(zero, PAN_PX)),
            Command::PanDown => self.camera.pan(Point::new(zero, -PAN_PX)),
            Command::Back => self.camera.back(),
            Command::Forward => self.camera.forward(),
            _ => {}
        }
    }

    fn step(&mut self, step: fn(&mut Document) -> Option<&'static str>, what: &'static str) {
        self.gesture = Gesture::None;
        self.edit(move |document| match step(document) {
            Some(_) => Ok(()),
            None => Err(format!("there is nothing to {what}")),
        });
    }

    fn close_active(&mut self) {
        if self.active >= self.layers.len() {
            return;
        }
        if self.layers[self.active].is_changed() {
            self.notify("this file has changes: save them, or undo them, before you close it");
        } else {
            self.close(self.active);
        }
    }

    pub(crate) fn set_tool(&mut self, tool: Tool) {
        self.gesture = Gesture::None;
        self.tool = tool;
    }

    /// The way out of everything.
    fn stop(&mut self, ctx: &Context) {
        leave_field(ctx);
        self.prompt = None;
        self.choosing = None;
        self.shows_keys = false;
        self.asks_to_quit = false;
        self.notices.clear();
        if !matches!(self.gesture, Gesture::None) {
            self.gesture = Gesture::None;
        } else if self.tool != Tool::Select {
            self.set_tool(Tool::Select);
        } else {
            self.change(select_none);
        }
        if let Some(job) = self.writing() {
            job.cancel();
        }
        for layer in &mut self.layers {
            if layer.load().is_some() {
                layer.cancel_load();
            }
        }
    }
}
