//! The Path section: shape, curvature and attributes of the selected path.

use eframe::egui::{Grid, Label, Pos2, Sense, Shape, Stroke, Ui, Vec2};
use guideway_document::Document;
use guideway_document::measure::{Bend, bends};
use guideway_layout::Paths;

use crate::canvas::shape_text;
use crate::files::OpenFiles;

/// Longest list of attributes.
const MAX_ATTRIBUTES: usize = 40;
const PLOT_HEIGHT: f32 = 48.0;

/// Shows the selected path, if there is exactly one: what the pointer hovers over is in the status
/// bar, so that the panel keeps still.
pub(super) fn show(ui: &mut Ui, files: &OpenFiles) {
    let Some(document) = files.document() else {
        return;
    };
    let selected = document.selection();
    let Some(row) = selected.min().filter(|_| selected.len() == 1) else {
        ui.label("Select one path to see its properties");
        return;
    };
    let path = document.layout().paths.get(row as usize);
    ui.strong(path.id());
    let bends = bends(path);
    ui.label(shape_text(path, &bends));
    plot_curvature(ui, &bends);
    show_attributes(ui, document, row);
}

fn show_attributes(ui: &mut Ui, document: &Document, row: u32) {
    let layout = document.layout();
    let path = layout.paths.get(row as usize);
    let node = |node: Option<u32>| node.map_or("none", |node| layout.nodes.id(node)).to_owned();
    let types: Vec<&str> = layout.paths.vehicle_types().of(row as usize).collect();
    let built_in = [
        ("from node", node(path.start_node())),
        ("to node", node(path.end_node())),
        ("vehicle types", types.join(", ")),
    ];
    let built_in = built_in.map(|(name, value)| (name.to_owned(), value));
    let columns = attributes(&layout.paths, row as usize);
    let grid = Grid::new("attributes").num_columns(2);
    grid.min_col_width(120.0)
        .max_col_width(150.0)
        .show(ui, |ui| {
            let all = built_in.into_iter().chain(columns);
            let mut all = all.filter(|(_, value)| !value.is_empty());
            for (name, value) in all.by_ref().take(MAX_ATTRIBUTES) {
                ui.add(Label::new(&name).truncate()).on_hover_text(name);
                ui.add(Label::new(&value).truncate()).on_hover_text(value);
                ui.end_row();
            }
            let more = all.count();
            if more > 0 {
                ui.small(format!("and {more} more"));
            }
        });
}

/// The attributes of a path with their units; those per vehicle type name their types.
fn attributes(paths: &Paths, row: usize) -> Vec<(String, String)> {
    let types = paths.vehicle_types();
    let common = paths.attributes.iter().filter_map(|column| {
        let value = column.values.get(row)?;
        Some((column.label(), value.to_string()))
    });
    let per_type = types.attributes.iter().filter_map(|column| {
        let of_type = |entry: usize| {
            let value = column.values.get(entry)?;
            Some(format!("{}: {value}", types.type_of(entry)))
        };
        let values: Vec<String> = types.entries(row).filter_map(of_type).collect();
        (!values.is_empty()).then(|| (column.label(), values.join(", ")))
    });
    common.chain(per_type).collect()
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

#[cfg(test)]
mod tests {
    use guideway_layout::{NewPath, Quantity};

    use super::*;

    #[test]
    fn attributes_show_units_and_values_per_vehicle_type() {
        let mut paths = Paths::default();
        paths.push(&NewPath {
            vehicle_types: &["tug", "fork"],
            ..NewPath::default()
        });
        let height = Quantity::Length;
        paths.attributes.set_quantity(0, "maxHeight", 2.5, height);
        let per_type = &mut paths.vehicle_types_mut().attributes;
        per_type.set_quantity(0, "maxSpeed", 1.5, Quantity::Speed);
        per_type.set_quantity(1, "maxSpeed", 2.0, Quantity::Speed);
        let expected = [
            ("maxHeight (m)", "2.5"),
            ("maxSpeed (m/s)", "tug: 1.5, fork: 2"),
        ];
        let expected = expected.map(|(name, value)| (name.to_owned(), value.to_owned()));
        assert_eq!(attributes(&paths, 0), expected);
    }
}
