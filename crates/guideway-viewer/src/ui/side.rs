use eframe::egui::{
    CollapsingHeader, ComboBox, DragValue, Grid, Label, RichText, Slider, TextEdit, Ui,
};
use guideway_document::Document;
use guideway_document::measure::{Bend, bends};
use guideway_layout::Layout;
use guideway_spline::{Affine, Point};

use super::draft::shape_text;
use crate::app::{App, MOST_HOVERED};

/// Columns that every layout can be colored by.
const BUILT_IN_COLUMNS: [&str; 3] = ["direction", "level", "vehicle_type"];
const MOST_ATTRIBUTES: usize = 40;

impl App {
    pub(super) fn side(&mut self, ui: &mut Ui) {
        let section = |title, is_open| CollapsingHeader::new(title).default_open(is_open);
        section("Files", true).show(ui, |ui| self.files(ui));
        section("Path", true).show(ui, |ui| self.path(ui));
        section("Selection", true).show(ui, |ui| self.selection(ui));
        section("Find", true).show(ui, |ui| self.finder(ui));
        section("Look", false).show(ui, |ui| self.looks(ui));
        section("Findings", false).show(ui, |ui| self.findings(ui));
        section("Drawing", false).show(ui, |ui| self.drawing(ui));
    }

    fn files(&mut self, ui: &mut Ui) {
        let mut close = None;
        let are_several = self.layers.len() > 1;
        for (index, layer) in self.layers.iter_mut().enumerate() {
            ui.horizontal(|ui| {
                let mark = if layer.is_changed() { "*" } else { "" };
                let name = format!("{}{mark}", layer.name());
                let label = ui.selectable_label(self.active == index, name);
                if label
                    .on_hover_text(layer.path.display().to_string())
                    .clicked()
                {
                    self.active = index;
                }
                ui.checkbox(&mut layer.is_visible, "shown");
                if are_several && !layer.is_changed() && ui.small_button("Close").clicked() {
                    close = Some(index);
                }
            });
            if let Some(document) = &layer.document {
                let scene = document.scene();
                ui.small(format!(
                    "{} paths, {} hidden, {} refused",
                    scene.path_count(),
                    scene.hidden_count(),
                    document.layout().refused.len(),
                ));
            }
        }
        self.floor_plan(ui);
        if let Some(index) = close {
            self.close(index);
        }
        let levels: Vec<(u32, String)> = self.document().map_or(Vec::new(), levels);
        if levels.len() > 1 {
            ui.horizontal_wrapped(|ui| {
                ui.label("Level:");
                let all = [(None, "all".to_owned())].into_iter();
                let each = levels.into_iter().map(|(level, name)| (Some(level), name));
                for (level, name) in all.chain(each) {
                    if ui.button(name).clicked() {
                        self.change(move |document| document.show_level(level));
                    }
                }
            });
        }
    }

    fn floor_plan(&mut self, ui: &mut Ui) {
        let floor = &mut self.floor;
        if floor.plan.is_empty() {
            return;
        }
        let what = if floor.is_awaited() {
            "reading the floor plan"
        } else {
            "floor plan"
        };
        ui.checkbox(&mut floor.is_visible, what);
        let plan = Label::new(RichText::new(&floor.plan).small());
        ui.add(plan.truncate()).on_hover_text(&floor.plan);
        if let Some(trouble) = floor.trouble.as_ref().or(floor.drawn.trouble.as_ref()) {
            ui.colored_label(ui.visuals().error_fg_color, trouble);
        }
    }

    /// The path under the pointer, or the one that is selected.
    fn path(&mut self, ui: &mut Ui) {
        let Some(document) = self.document() else {
            return;
        };
        let selected = document.selection();
        let only = selected.min().filter(|_| selected.len() == 1);
        let Some(row) = self.hovered().map(|hit| hit.path).or(only) else {
            ui.label("Point at a path, or select one.");
            return;
        };
        let path = document.layout().paths.get(row as usize);
        ui.strong(path.id());
        if let Some(back) = self.way_back(document) {
            ui.label(format!(
                "and back by {}; click again to take that",
                document.layout().paths.id(back as usize)
            ));
        }
        let bends = bends(path);
        ui.label(shape_text(path, &bends));
        plot(ui, &bends);
        attributes(ui, document, row);
    }

    /// The path that leads back on the one under the pointer.
    fn way_back(&self, document: &Document) -> Option<u32> {
        document.reverse_path_at(self.hovered()?, MOST_HOVERED)
    }

    fn selection(&mut self, ui: &mut Ui) {
        let count = self.document().map(|document| document.selection().len());
        ui.label(match count {
            Some(1) => "1 path selected".to_owned(),
            Some(count) => format!("{count} paths selected"),
            None => "nothing is ready to be selected yet".to_owned(),
        });
        ui.checkbox(
            &mut self.snaps_to_grid,
            "Moves and new points snap to the grid",
        );
        let numbers = &mut self.numbers;
        let (mut moves, mut turns, mut copies) = (false, false, false);
        ui.horizontal(|ui| {
            ui.label("By");
            ui.add(DragValue::new(&mut numbers.by_x_m).speed(0.1).suffix(" m"));
            ui.add(DragValue::new(&mut numbers.by_y_m).speed(0.1).suffix(" m"));
            moves = ui.button("Move").clicked();
        });
        ui.horizontal(|ui| {
            let times = match numbers.copies {
                1 => " time",
                _ => " times",
            };
            let copies_of_it = DragValue::new(&mut numbers.copies).range(1..=1000);
            ui.add(copies_of_it.suffix(times));
            copies = ui.button("Copy, each farther by that").clicked();
        });
        ui.horizontal(|ui| {
            ui.add(DragValue::new(&mut numbers.angle_deg).suffix("°"));
            turns = ui.button("Turn about its middle").clicked();
        });
        let by_m = Point::new(self.numbers.by_x_m, self.numbers.by_y_m);
        if moves {
            let by = Affine::translation(by_m);
            self.edit(move |document| document.transform_selection("move", by));
        }
        if copies {
            let count = self.numbers.copies;
            self.edit(move |document| document.copy_selection(count, by_m));
        }
        if turns {
            let angle = self.numbers.angle_deg.to_radians();
            self.edit(move |document| match document.selection_bounds() {
                Some(bounds) => {
                    let by = Affine::rotation(angle, bounds.center());
                    document.transform_selection("turn", by)
                }
                None => Ok(()),
            });
        }
    }

    fn looks(&mut self, ui: &mut Ui) {
        let before = self.look.clone();
        let columns = self.document().map_or(Vec::new(), |d| columns(d.layout()));
        ComboBox::from_label("Color")
            .selected_text(self.look.color_by.as_deref().unwrap_or("of the file"))
            .show_ui(ui, |ui| {
                ui.selectable_value(&mut self.look.color_by, None, "of the file");
                for column in columns {
                    ui.selectable_value(&mut self.look.color_by, Some(column.clone()), column);
                }
            });
        ui.checkbox(&mut self.look.is_thesis_rule, "Line widths of the thesis");
        ui.add_enabled_ui(!self.look.is_thesis_rule, |ui| {
            let width = Slider::new(&mut self.look.width_m, 0.0..=2.0).suffix(" m");
            ui.add(width.text("Width"));
            let least = Slider::new(&mut self.look.min_px, 0.5..=8.0).suffix(" px");
            ui.add(least.text("At least"));
        });
        ui.checkbox(&mut self.look.is_density, "Density");
        ui.checkbox(&mut self.look.has_arrows, "Arrows");
        ui.checkbox(&mut self.look.has_symbols, "Nodes and stations");
        ui.checkbox(&mut self.look.has_labels, "Names");
        ui.checkbox(&mut self.look.has_grid, "Grid");
        ui.checkbox(&mut self.look.is_dark, "Dark");
        ui.checkbox(&mut self.swept.is_shown, "Areas that a vehicle sweeps");
        let title = ui.label("Vehicle: length x width, rear, in meters, or `file`");
        ui.add(TextEdit::singleline(&mut self.swept.vehicle))
            .labelled_by(title.id);
        if let Some(trouble) = &self.swept.drawn.trouble {
            ui.colored_label(ui.visuals().error_fg_color, trouble);
        }
        if before.is_dark != self.look.is_dark {
            self.apply_theme(ui.ctx());
        }
        if before.scene_options_differ(&self.look) {
            self.recolor();
        }
    }

    /// How it is drawn, and how long that takes.
    fn drawing(&mut self, ui: &mut Ui) {
        self.method(ui);
        let Some(shown) = self.layers.get(self.active).and_then(|l| l.shown.as_ref()) else {
            return;
        };
        let report = &shown.report;
        ui.label(report.to_string());
        Grid::new("stages").num_columns(2).show(ui, |ui| {
            for stage in &report.stages {
                ui.label(stage.name);
                ui.monospace(format!("{:.2} ms", stage.elapsed_ms));
                ui.end_row();
            }
            ui.label("from the question to the picture");
            ui.monospace(format!("{:.2} ms", shown.wall_ms));
            ui.end_row();
        });
        for note in &report.notes {
            ui.small(note);
        }
    }

    fn method(&mut self, ui: &mut Ui) {
        let drawing = &self.drawing;
        let best = format!("best here: {}", drawing.best());
        let mut chosen = None;
        ComboBox::from_label("Way of drawing")
            .selected_text(drawing.chosen.as_ref().unwrap_or(&best))
            .show_ui(ui, |ui| {
                let is_best = drawing.chosen.is_none();
                if ui.selectable_label(is_best, &best).clicked() {
                    chosen = Some(None);
                }
                for choice in &drawing.choices {
                    let can = choice.unavailable.is_none();
                    let is_this = drawing.chosen.as_ref() == Some(&choice.name);
                    let label =
                        ui.add_enabled_ui(can, |ui| ui.selectable_label(is_this, &choice.name));
                    let hover = choice.unavailable.as_ref().unwrap_or(&choice.summary);
                    if label.inner.on_hover_text(hover).clicked() {
                        chosen = Some(Some(choice.name.clone()));
                    }
                }
            });
        if let Some(chosen) = chosen {
            self.set_method(chosen);
        }
    }
}

fn levels(document: &Document) -> Vec<(u32, String)> {
    let levels = document.layout().levels.iter().zip(0..);
    levels
        .map(|(level, row)| (row, level.name.clone().unwrap_or_else(|| level.id.clone())))
        .collect()
}

fn columns(layout: &Layout) -> Vec<String> {
    let own = layout
        .paths
        .attributes
        .iter()
        .map(|column| column.name.clone());
    let built_in = BUILT_IN_COLUMNS.map(str::to_owned);
    own.chain(built_in).collect()
}

fn attributes(ui: &mut Ui, document: &Document, row: u32) {
    let layout = document.layout();
    let path = layout.paths.get(row as usize);
    let node = |node: Option<u32>| node.map_or("none", |node| layout.nodes.id(node)).to_owned();
    let types: Vec<&str> = layout.paths.vehicle_types().of(row as usize).collect();
    let built_in = [
        ("from node", node(path.start_node())),
        ("to node", node(path.end_node())),
        ("vehicle types", types.join(", ")),
    ];
    let own = layout.paths.attributes.iter().filter_map(|column| {
        let value = column.values.get(row as usize)?;
        Some((column.name.as_str(), value.to_string()))
    });
    Grid::new("attributes")
        .num_columns(2)
        .min_col_width(120.0)
        .max_col_width(150.0)
        .show(ui, |ui| {
            let all = built_in.into_iter().chain(own);
            let mut all = all.filter(|(_, value)| !value.is_empty());
            for (name, value) in all.by_ref().take(MOST_ATTRIBUTES) {
                ui.add(Label::new(name).truncate());
                ui.add(Label::new(value).truncate());
                ui.end_row();
            }
            let more = all.count();
            if more > 0 {
                ui.small(format!("and {more} more"));
            }
        });
}

/// The curvature along a path.
fn plot(ui: &mut Ui, bends: &[Bend]) {
    use eframe::egui::{Pos2, Sense, Shape, Stroke, Vec2};
    let (Some(first), Some(last)) = (bends.first(), bends.last()) else {
        return;
    };
    let most = bends
        .iter()
        .map(|bend| bend.curvature.abs())
        .fold(1e-6, f64::max);
    let size = Vec2::new(ui.available_width(), 48.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let color = ui.visuals().text_color();
    let along_m = (last.along_m - first.along_m).max(1e-9);
    let point = |bend: &Bend| {
        let x = ((bend.along_m - first.along_m) / along_m) as f32;
        let y = (0.5 - 0.5 * bend.curvature / most) as f32;
        Pos2::new(
            rect.left() + x * rect.width(),
            rect.top() + y * rect.height(),
        )
    };
    let painter = ui.painter_at(rect);
    painter.hline(
        rect.x_range(),
        rect.center().y,
        Stroke::new(1.0, color.gamma_multiply(0.3)),
    );
    painter.add(Shape::line(
        bends.iter().map(point).collect(),
        Stroke::new(1.5, color),
    ));
    response.on_hover_text("How much the path is bent along its way: up is to the left");
}
