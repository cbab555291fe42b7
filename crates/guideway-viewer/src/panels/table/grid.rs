//! The visible cells of the table: header, rows, and the field of the cell that is edited.

use eframe::egui::{
    self, Align, Button, Id, Key, Label, Rect, RichText, ScrollArea, Sense, TextEdit, TextWrapMode,
    Ui, UiBuilder, Vec2, pos2,
};
use guideway_document::{Column, PathSet, SelectMode};
use guideway_layout::Layout;
use guideway_scene::Table;

use super::cell::{CellDraft, cell_text};
use crate::language::t;
use crate::units::shown_unit;

const ROW_HEIGHT: f32 = 20.0;
const NAME_WIDTH: f32 = 170.0;
const COLUMN_WIDTH: f32 = 110.0;
/// Space between the text of a cell and its edges, in points.
const PADDING: f32 = 4.0;

/// An action of the user on the grid.
pub(super) enum GridEvent {
    /// The header of a column was clicked.
    Sort(usize),
    /// A row was clicked; `extends` from the one before.
    Select {
        row: u32,
        column: usize,
        mode: SelectMode,
        extends: bool,
    },
    /// A cell was double-clicked.
    Open { row: u32, column: usize },
    /// The text of the edited cell is complete.
    Confirm,
}

/// The content of the grid.
pub(super) struct CellGrid<'a> {
    pub(super) layout: &'a Layout,
    pub(super) of: Table,
    pub(super) columns: &'a [Column],
    pub(super) rows: &'a [u32],
    pub(super) selected: &'a PathSet,
    pub(super) sort: Option<&'a (Column, bool)>,
    pub(super) cursor: Option<(u32, usize)>,
    /// The row to scroll to.
    pub(super) scroll_to: Option<u32>,
}

impl CellGrid<'_> {
    /// Shows header and visible cells.
    pub(super) fn show(
        &self,
        ui: &mut Ui,
        offset_x: &mut f32,
        editing: &mut Option<CellDraft>,
    ) -> Vec<GridEvent> {
        let mut events = Vec::new();
        self.show_header(ui, *offset_x, &mut events);
        let place = self.scroll_to.and_then(|row| {
            let place = self.rows.iter().position(|&shown| shown == row)?;
            Some(place as f32 * ROW_HEIGHT)
        });
        let mut scroll = ScrollArea::both().id_salt(self.of).auto_shrink(false);
        if let Some(top) = place {
            let height = ui.available_height();
            scroll = scroll.vertical_scroll_offset((top - height / 2.0).max(0.0));
        }
        let output = scroll.show_viewport(ui, |ui, viewport| {
            let height = self.rows.len() as f32 * ROW_HEIGHT;
            ui.set_min_size(Vec2::new(self.left_of(self.columns.len()), height));
            self.show_rows(ui, viewport, editing, &mut events);
        });
        *offset_x = output.state.clamped_offset().x;
        events
    }

    fn width_of(&self, column: usize) -> f32 {
        match self.columns.get(column) {
            Some(Column::Id) => NAME_WIDTH,
            _ => COLUMN_WIDTH,
        }
    }

    /// Left edge of a column in the grid, in points.
    fn left_of(&self, column: usize) -> f32 {
        (0..column).map(|column| self.width_of(column)).sum()
    }

    fn show_header(&self, ui: &mut Ui, offset_x: f32, events: &mut Vec<GridEvent>) {
        let size = Vec2::new(ui.available_width(), ROW_HEIGHT);
        let (_, rect) = ui.allocate_space(size);
        let mut header = ui.new_child(UiBuilder::new().max_rect(rect));
        header.shrink_clip_rect(rect);
        header.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
        for (index, column) in self.columns.iter().enumerate() {
            let left = rect.left() + self.left_of(index) - offset_x;
            let size = Vec2::new(self.width_of(index), ROW_HEIGHT);
            let cell = Rect::from_min_size(pos2(left, rect.top()), size);
            if !cell.intersects(rect) {
                continue;
            }
            let arrow = match self.sort {
                Some((by, false)) if by == column => "▲",
                Some((by, true)) if by == column => "▼",
                _ => "",
            };
            let title = title_of(column, self.layout, self.of);
            // The other font has no arrows.
            let arrow = RichText::new(arrow).monospace();
            let button = Button::new((title.clone(), arrow)).frame(false);
            if header.put(cell, button).on_hover_text(title).clicked() {
                events.push(GridEvent::Sort(index));
            }
        }
    }

    fn show_rows(
        &self,
        ui: &mut Ui,
        viewport: Rect,
        editing: &mut Option<CellDraft>,
        events: &mut Vec<GridEvent>,
    ) {
        let clip = ui.clip_rect();
        let first = (viewport.top() / ROW_HEIGHT).max(0.0) as usize;
        let end = ((viewport.bottom() / ROW_HEIGHT).ceil() as usize).min(self.rows.len());
        // Places of a million rows exceed the precision of the screen's coordinates.
        let top_of = |place: usize| {
            let below = place as f64 * f64::from(ROW_HEIGHT) - f64::from(viewport.top());
            clip.top() + below as f32
        };
        for place in first..end {
            let left = clip.left() - viewport.left();
            let width = self.left_of(self.columns.len()).max(clip.width());
            let size = Vec2::new(width, ROW_HEIGHT);
            let rect = Rect::from_min_size(pos2(left, top_of(place)), size);
            self.show_row(ui, place, rect, editing, events);
        }
    }

    fn show_row(
        &self,
        ui: &mut Ui,
        place: usize,
        rect: Rect,
        editing: &mut Option<CellDraft>,
        events: &mut Vec<GridEvent>,
    ) {
        let row = self.rows[place];
        let is_selected = self.selected.contains(row);
        let visuals = ui.visuals();
        if is_selected {
            ui.painter()
                .rect_filled(rect, 0.0, visuals.selection.bg_fill);
        } else if place % 2 == 1 {
            ui.painter().rect_filled(rect, 0.0, visuals.faint_bg_color);
        }
        let response = ui.interact(rect, ui.scope_id().with(("row", row)), Sense::click());
        let column_at = |x: f32| {
            let mut columns = 0..self.columns.len();
            columns.find(|&column| x < rect.left() + self.left_of(column + 1))
        };
        let column = response
            .interact_pointer_pos()
            .and_then(|at| column_at(at.x));
        if let Some(column) = column {
            if response.double_clicked() {
                events.push(GridEvent::Open { row, column });
            } else if response.clicked() {
                let modifiers = ui.input(|input| input.modifiers);
                events.push(GridEvent::Select {
                    row,
                    column,
                    mode: mode_of(modifiers.command, is_selected),
                    extends: modifiers.shift,
                });
            }
        }
        let clip = ui.clip_rect();
        for (index, column) in self.columns.iter().enumerate() {
            let left = rect.left() + self.left_of(index);
            let size = Vec2::new(self.width_of(index), ROW_HEIGHT);
            let cell = Rect::from_min_size(pos2(left, rect.top()), size);
            if !cell.intersects(clip) {
                continue;
            }
            let is_edited = editing
                .as_ref()
                .is_some_and(|draft| (draft.cell.row, &draft.cell.column) == (row, column));
            if let Some(draft) = editing.as_mut().filter(|_| is_edited) {
                events.extend(show_field(ui, cell, draft));
                continue;
            }
            if self.cursor == Some((row, index)) {
                let stroke = ui.visuals().selection.stroke;
                let inside = egui::StrokeKind::Inside;
                ui.painter().rect_stroke(cell, 0.0, stroke, inside);
            }
            let text = cell_text(self.layout, self.of, column, row);
            if !text.is_empty() {
                let label = Label::new(text).truncate().selectable(false);
                let inside = UiBuilder::new().max_rect(cell.shrink2(Vec2::new(PADDING, 0.0)));
                let align = egui::Layout::left_to_right(Align::Center);
                ui.new_child(inside.layout(align)).add(label);
            }
        }
    }
}

/// The field of the cell that is edited.
fn show_field(ui: &mut Ui, cell: Rect, draft: &mut CellDraft) -> Option<GridEvent> {
    let id = Id::unique("edited cell");
    let field = TextEdit::singleline(&mut draft.cell.text).id(id);
    let response = ui.put(cell, field.margin(Vec2::new(PADDING, 0.0)));
    if std::mem::take(&mut draft.is_new) {
        response.request_focus();
        return None;
    }
    let is_left = response.lost_focus() || !response.has_focus();
    let is_cancelled = ui.input(|input| input.key_pressed(Key::Escape));
    (is_left && !is_cancelled).then_some(GridEvent::Confirm)
}

/// The name of a column with its unit: `maxSpeed (m/s)`.
fn title_of(column: &Column, layout: &Layout, of: Table) -> String {
    let name = match column {
        Column::Id => t("identifier"),
        Column::Start => t("from node"),
        Column::End => t("to node"),
        Column::Length => t("drawn length"),
        Column::VehicleType => t("vehicle types"),
        Column::Direction => t("direction"),
        Column::Level => t("level"),
        Column::Nodes => t("nodes"),
        column => column.name(),
    };
    match column.unit(layout, of) {
        Some(unit) => format!("{name} ({})", shown_unit(unit)),
        None => name.to_owned(),
    }
}

/// The mode of a click on a row.
fn mode_of(is_command: bool, is_selected: bool) -> SelectMode {
    match (is_command, is_selected) {
        (false, _) => SelectMode::Replace,
        (true, false) => SelectMode::Add,
        (true, true) => SelectMode::Remove,
    }
}
