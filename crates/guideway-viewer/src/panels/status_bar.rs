//! The status bar: position of the pointer, scale, hint of the tool, selection, and the path under
//! the pointer.

use eframe::egui::{Label, Ui};
use guideway_document::{Document, Element, Hit, Snapped, text_format};
use guideway_scene::View;
use guideway_spline::Point;

use super::digits::Digits;
use super::findings_panel::finding_text;
use super::selection_panel::summary;
use crate::canvas::{Canvas, POINT_M};
use crate::display_settings::DisplaySettings;
use crate::editing::MarkedSeverities;
use crate::files::{OpenFiles, layer_tool_context};
use crate::language::{direction_name, grouped, say, t};
use crate::tools::{HIT_RADIUS_PX, HoverTarget, MAX_HOVER_CANDIDATES, OtherHit, Tool, Tools};

/// The content of the status bar.
pub(crate) struct StatusBar<'a> {
    pub(crate) canvas: &'a Canvas,
    pub(crate) files: &'a OpenFiles,
    pub(crate) tools: &'a Tools,
    pub(crate) settings: &'a DisplaySettings,
    pub(crate) other_hit: Option<&'a OtherHit>,
    pub(crate) marked_findings: MarkedSeverities,
}

impl StatusBar<'_> {
    pub(crate) fn show(&self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            self.show_position(ui);
            if let Some(finding) = self.finding() {
                ui.add(Label::new(finding).truncate().selectable(false));
                return;
            }
            let document = self.files.document();
            let symbol = self.tools.hovered_symbol(document);
            if let (Some(symbol), Some(document)) = (symbol, document) {
                let hovered = hovered_symbol(document, symbol);
                ui.add(Label::new(hovered).truncate().selectable(false));
                return;
            }
            if let (Some(hit), Some(document)) = (self.tools.hovered(document), document) {
                let hovered = hovered(document, hit);
                ui.add(Label::new(hovered).truncate().selectable(false));
                return;
            }
            if let Some(text) = self.other_hit.and_then(|hit| self.hovered_elsewhere(hit)) {
                ui.add(Label::new(text).truncate().selectable(false));
                return;
            }
            let selected = document.map(Document::selected);
            if let Some(selected) = selected.filter(|selected| !selected.is_empty()) {
                ui.label(summary(selected));
                ui.separator();
            }
            let layer = self.files.active();
            let overlay = layer.and_then(|layer| layer.slot.overlay().last());
            if self.settings.has_marks() && overlay.is_some_and(|o| o.marks.left_out) {
                ui.label(t("Zoom in to show all marks"));
                ui.separator();
            }
            ui.add(
                Label::new(tool_hint(self.tools.tool()))
                    .truncate()
                    .selectable(false),
            );
        });
    }

    /// The finding under the pointer.
    fn finding(&self) -> Option<String> {
        let (view, at_px) = (self.canvas.camera.view()?, self.canvas.pointer_px()?);
        let layer = self.files.active()?;
        let reach_m = HIT_RADIUS_PX * self.canvas.px_per_point() / view.px_per_m();
        let findings = layer.tasks.findings()?;
        let at_m = view.world_from_pixel(at_px);
        let finding = findings.near(at_m, reach_m, self.marked_findings)?;
        Some(finding_text(finding))
    }

    /// The element under the pointer in another file.
    fn hovered_elsewhere(&self, other: &OtherHit) -> Option<String> {
        let layer = self.files.layers().get(other.file)?;
        let document = layer.document()?;
        let element = match &other.target {
            HoverTarget::Symbol(symbol) if document.contains(*symbol) => {
                hovered_symbol(document, *symbol)
            }
            HoverTarget::Symbol(_) => return None,
            HoverTarget::Path(hit) => hovered(document, hit),
        };
        Some(say!(
            "{path}, in {name} (a click edits this file)",
            path = element,
            name = layer.name()
        ))
    }

    /// The place to which a click at the pointer snaps.
    fn snapped(&self, ui: &Ui, view: View, at_m: Point<f64>) -> Option<Snapped> {
        let px_per_point = self.canvas.px_per_point();
        let context = layer_tool_context(self.files.active(), view, self.settings, px_per_point);
        let modifiers = ui.input(|input| input.modifiers);
        self.tools.snap_target(&context, at_m, modifiers)
    }

    /// Shows the position of the pointer, or of what it snaps to, and the scale, in fields of
    /// constant width.
    fn show_position(&self, ui: &mut Ui) {
        let Some(view) = self.canvas.camera.view() else {
            return;
        };
        let at_m = self.canvas.pointer_px().map(|at| view.world_from_pixel(at));
        let snapped = at_m.and_then(|at_m| self.snapped(ui, view, at_m));
        let at_m = snapped.map(|snapped| snapped.at_m).or(at_m);
        let position = at_m.map_or_else(
            || "x           y          ".to_owned(),
            |at_m| format!("x {:>9.3} y {:>9.3} m", at_m.x, at_m.y),
        );
        let digits = Digits::new(ui);
        let position = digits.show(ui, &position);
        position.on_hover_text(t("Position of the pointer, or of what it snaps to"));
        ui.separator();
        let scale = scale_text(view.px_per_m() / self.canvas.px_per_point());
        let scale = digits.show(ui, &scale);
        scale.on_hover_text(t("Scale on a screen of 96 points per inch"));
        ui.separator();
    }
}

/// `1:250`, to two digits.
fn scale_text(points_per_m: f64) -> String {
    let exact = 1.0 / (points_per_m * POINT_M);
    if exact < 1.0 {
        return format!("{:.0}:1", 1.0 / exact);
    }
    let unit = 10f64.powf(exact.log10().floor() - 1.0).max(1.0);
    format!("1:{}", grouped(((exact / unit).round() * unit) as u64))
}

/// The station or node under the pointer.
fn hovered_symbol(document: &Document, symbol: Element) -> String {
    let name = symbol.id(document.layout());
    match symbol {
        Element::Station(_) => say!("station {name}", name),
        _ => say!("node {name}", name),
    }
}

/// The path under the pointer, and its reverse path.
fn hovered(document: &Document, hit: &Hit) -> String {
    let paths = &document.layout().paths;
    let path = paths.get(hit.path as usize);
    let id = |path: u32| paths.id(path as usize);
    let (name, length) = (id(hit.path), text_format::length(path.length_m()));
    let text = match document.layout().is_drawing() {
        // Nobody drives on its lines.
        true => say!("path {name}: {length}", name, length),
        false => {
            let way = direction_name(path.direction());
            say!("path {name}: {length}, {way}", name, length, way)
        }
    };
    match document.reverse_path_at(hit, MAX_HOVER_CANDIDATES) {
        Some(reverse) => {
            let reverse = id(reverse);
            say!(
                "{text} (a second click selects the reverse path {reverse})",
                text,
                reverse
            )
        }
        None => text,
    }
}

fn tool_hint(tool: Tool) -> &'static str {
    match tool {
        Tool::Select => t(
            "Click or drag a box to select; drag the selection to move it, with Ctrl off its nodes",
        ),
        Tool::Points => t("Drag nodes and control points; Insert adds one, Backspace removes it"),
        Tool::Line => t("Click or type points; Enter, a double or a right click finishes"),
        Tool::Arc => t("Click start, end and a point between, or type a radius: r2"),
        Tool::Bezier => t("Click the end, two control points, the next end; Enter finishes"),
        Tool::Curve => t("Click or type points; Enter, a double or a right click finishes"),
        Tool::Node => t("Click to create a node, on a path to split it"),
        Tool::Station => t("Click a node to put a station there, or a free place"),
        Tool::Measure => t("Click to add points; a double click starts over"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scale_has_two_digits() {
        let texts = [1.0 / POINT_M, 15.1, 3.7795, 0.01].map(scale_text);
        assert_eq!(texts, ["1:1", "1:250", "1:1,000", "1:380,000"]);
        assert_eq!(scale_text(37_800.0), "10:1");
    }
}
