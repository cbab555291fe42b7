//! Length, bends and curvature of the selected path.

use eframe::egui::{Pos2, Sense, Shape, Stroke, Ui, Vec2};
use guideway_document::measure::{Bend, bends};

use crate::canvas::shape_text;
use crate::files::OpenFiles;

const PLOT_HEIGHT: f32 = 48.0;

/// Shows the shape of the selected path, if there is exactly one. The path under the pointer is in
/// the status bar, so that the panel keeps still.
pub(super) fn show(ui: &mut Ui, files: &OpenFiles) {
    let Some(document) = files.document() else {
        return;
    };
    let selected = document.selection();
    let Some(row) = selected.min().filter(|_| selected.len() == 1) else {
        return;
    };
    let path = document.layout().paths.get(row as usize);
    let bends = bends(path);
    ui.label(shape_text(path, &bends));
    plot_curvature(ui, &bends);
}

/// Plots curvature over arc length.
fn plot_curvature(ui: &mut Ui, bends: &[Bend]) {
    let (Some(first), Some(last)) = (bends.first(), bends.last()) else {
        return;
    };
    let curvatures = bends.iter().map(|bend| bend.curvature.abs());
    let max_curvature = curvatures.fold(1e-6, f64::max);
    let size = Vec2::new(ui.available_width(), PLOT_HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let color = ui.visuals().text_color();
    let length_m = (last.along_m - first.along_m).max(1e-9);
    let point = |bend: &Bend| {
        let x = ((bend.along_m - first.along_m) / length_m) as f32;
        let y = (0.5 - 0.5 * bend.curvature / max_curvature) as f32;
        Pos2::new(
            rect.left() + x * rect.width(),
            rect.top() + y * rect.height(),
        )
    };
    let painter = ui.painter_at(rect);
    let axis = Stroke::new(1.0, color.gamma_multiply(0.3));
    painter.hline(rect.x_range(), rect.center().y, axis);
    let curve = bends.iter().map(point).collect();
    painter.add(Shape::line(curve, Stroke::new(1.5, color)));
    response.on_hover_text("Curvature along the path; up is a left turn");
}
