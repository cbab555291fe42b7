//! Pictures of the files: requests, results, and the first frames, which wait for the first one.

use std::thread;
use std::time::Duration;

use eframe::egui::Context;

use super::state::{App, FIRST_FRAME_WAIT, FIRST_PICTURE_WAIT};
use crate::backdrop::ActiveDocument;
use crate::files::{Layer, LayerContext, LayerEvent};
use crate::language::t;
use crate::render_queue::{FALLBACK_METHOD, RenderRequest};
use crate::services::LoadStage;

impl App {
    /// Lays the first frame out twice, if there is a file: the first pass finds the size of the
    /// canvas, the second one may have the picture, so the window need not be drawn without it.
    pub(super) fn begin_with_picture(&self, ctx: &Context) {
        if self.awaits_first_picture() && self.canvas.camera.view().is_none() {
            ctx.request_discard("the size of the first picture is not known yet");
        }
    }

    fn awaits_first_picture(&self) -> bool {
        let layers = self.files.layers();
        !layers.is_empty()
            && !layers.iter().any(Layer::has_picture_or_error)
            && !self.first_picture_wait.is_zero()
    }

    /// Delays frames until a file has a picture: see
    /// [`FIRST_PICTURE_WAIT`](super::FIRST_PICTURE_WAIT).
    pub(super) fn wait_for_first_picture(&mut self, ctx: &Context) {
        const STEP: Duration = Duration::from_millis(2);
        // Until the end of the first frame there is no window on the screen.
        let least = match ctx.cumulative_frame_nr() {
            0 => FIRST_PICTURE_WAIT.saturating_sub(FIRST_FRAME_WAIT),
            _ => Duration::ZERO,
        };
        while self.canvas.camera.view().is_some()
            && self.awaits_first_picture()
            && self.first_picture_wait > least
        {
            self.request_pictures();
            thread::sleep(STEP);
            self.first_picture_wait = self.first_picture_wait.saturating_sub(STEP);
            self.poll_layers(ctx);
        }
    }

    /// Requests the pictures of the present view.
    pub(super) fn request_pictures(&mut self) {
        let Some(view) = self.canvas.picture_view() else {
            return;
        };
        let px_per_point = self.canvas.px_per_point();
        let layers = self.files.layers_mut().iter_mut();
        for layer in layers.filter(|layer| layer.is_visible) {
            let line_rule = self.settings.line_rule(layer.widths, px_per_point);
            let style = self.settings.style(line_rule);
            layer.picture.request(RenderRequest { view, style });
        }
        let LayerContext {
            services, repaint, ..
        } = &self.context;
        let file_index = self.files.active_index();
        let document = self.files.document();
        let active = document.map(|document| ActiveDocument {
            file_index,
            document,
        });
        self.swept_areas.request(active, &view, services, repaint);
        self.floor_plan
            .request(&view, self.settings.is_dark, repaint);
    }

    /// Takes what the files report.
    pub(super) fn poll_layers(&mut self, ctx: &Context) {
        for index in 0..self.files.layers().len() {
            for event in self.files.poll_layer(ctx, index) {
                self.take_event(event, index);
            }
        }
    }

    fn take_event(&mut self, event: LayerEvent, index: usize) {
        match event {
            LayerEvent::Appeared(bounds) => {
                if index == 0
                    && let Some((center_m, px_per_m)) = self.project.view.take()
                {
                    self.canvas.camera.look_at(center_m, px_per_m);
                } else if let Some(bounds) = bounds {
                    self.canvas.camera.fit_file(bounds, index == 0);
                }
            }
            LayerEvent::Reached(stage) => {
                let path = self.files.layers()[index].path();
                self.context.services.on_stage(stage, path);
                if stage == LoadStage::Editable {
                    let options = self.settings.scene_options();
                    self.files.recolor_one(index, &options);
                    self.restore_level(index);
                    // They may show the replaced document.
                    self.swept_areas.clear();
                }
                if stage == LoadStage::Read {
                    let notice = self.files.remember(index);
                    self.notify_all(notice);
                }
            }
            LayerEvent::FellBack(why) => {
                // All files share the device, so each reports the failure.
                if self.methods.name() != FALLBACK_METHOD {
                    self.dialogs.notices.add(why);
                    self.set_method(Some(FALLBACK_METHOD.to_owned()));
                }
            }
            LayerEvent::Crowded if self.shows_crowds && self.settings.color_by.is_none() => {
                self.settings.is_crowded = true;
                // The pictures of this frame are requested already.
                (self.context.repaint)();
                self.dialogs.notices.inform(t(
                    "Many paths cover the picture, so it shows their density; Y shows their colors",
                ));
            }
            LayerEvent::Crowded => {}
            LayerEvent::Notice(text) => self.dialogs.notices.add(text),
        }
    }
}
