//! The status bar: pointer position, scale, tool hint, render time, path under the pointer.

use eframe::egui::{Label, Ui};

use crate::canvas::Canvas;
use crate::display_settings::DisplaySettings;
use crate::files::OpenFiles;
use crate::tools::{MAX_HOVER_CANDIDATES, Tool, Tools};

/// The content of the status bar.
pub(crate) struct StatusBar<'a> {
    pub(crate) canvas: &'a Canvas,
    pub(crate) files: &'a OpenFiles,
    pub(crate) tools: &'a Tools,
    pub(crate) settings: &'a DisplaySettings,
}

impl StatusBar<'_> {
    pub(crate) fn show(&self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            if let (Some(view), Some(at_px)) = (self.canvas.camera.view(), self.canvas.pointer_px())
            {
                let at_m = view.world_from_pixel(at_px);
                ui.monospace(format!("{:.3} m, {:.3} m", at_m.x, at_m.y));
                ui.separator();
                ui.monospace(format!("{:.4} px/m", view.px_per_m()));
                ui.separator();
            }
            ui.label(tool_hint(self.tools.tool()));
            ui.separator();
            let layer = self.files.active();
            if let Some(shown) = layer.and_then(|layer| layer.picture.shown()) {
                let (method, ms) = (shown.report.method, shown.report.frame_ms());
                ui.monospace(format!("{method} {ms:.1} ms"));
                ui.separator();
            }
            let overlay = layer.and_then(|layer| layer.slot.overlay().last());
            if self.settings.has_marks() && overlay.is_some_and(|o| o.marks.left_out) {
                ui.label("Zoom in to show all marks");
                ui.separator();
            }
            let document = self.files.document();
            if let (Some(hit), Some(document)) = (self.tools.hovered(document), document) {
                let id = |path: u32| document.layout().paths.id(path as usize);
                let text = match document.reverse_path_at(hit, MAX_HOVER_CANDIDATES) {
                    Some(reverse) => format!(
                        "{} (a second click selects the reverse path {})",
                        id(hit.path),
                        id(reverse)
                    ),
                    None => id(hit.path).to_owned(),
                };
                ui.add(Label::new(text).truncate());
            }
        });
    }
}

fn tool_hint(tool: Tool) -> &'static str {
    match tool {
        Tool::Select => "Click or drag a box to select; drag the selection to move it",
        Tool::Points => "Drag nodes and control points; Insert adds one, Backspace removes it",
        Tool::Line => "Click or type points; Enter, a double or a right click finishes",
        Tool::Arc => "Click start, end and a point between, or type a radius: r2",
        Tool::Curve => "Click or type points; Enter, a double or a right click finishes",
        Tool::Node => "Click to create a node, on a path to split it",
        Tool::Station => "Click a node to put a station there, or a free place",
        Tool::Measure => "Click to add points; a double click starts over",
    }
}
