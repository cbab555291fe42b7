//! The table view: all paths, nodes or stations as rows, their properties as columns. Cells are
//! sorted, filtered, edited and pasted; only visible ones are built.
//!
//! | file | input | output |
//! |---|---|---|
//! | `rows` | filter, sorted column | rows, in the background |
//! | `cell` | column, row | text; the edit of a typed one |
//! | `paste` | text of a spreadsheet | typed cells |
//! | `grid` | rows, columns | visible cells on screen |

mod cell;
mod grid;
mod paste;
mod rows;

use eframe::egui::{Event, TextEdit, Ui};
use guideway_document::{Column, Document, Elements, PathSet};
use guideway_scene::Table;

use self::cell::{CellDraft, TypedCell};
use self::grid::{CellGrid, GridEvent};
use self::rows::{RowsKey, TableRows};
use crate::action::Action;
use crate::background::RepaintHandle;
use crate::editing::EditTask;
use crate::files::OpenFiles;
use crate::language::{counted, t, translated};

/// The table view.
pub(crate) struct TablePanel {
    pub(crate) of: Table,
    /// A query; empty for all rows.
    pub(crate) filter: String,
    pub(crate) sort: Option<(Column, bool)>,
    rows: TableRows,
    /// Row and index of the column of the cell that was clicked last.
    cursor: Option<(u32, usize)>,
    editing: Option<CellDraft>,
    /// Horizontal offset of the cells, in points.
    offset_x: f32,
    /// First selected row of the last frame: another one scrolls into view.
    seen: Option<u32>,
    /// True if the last press of the pointer was in the table, which then takes pasted text.
    has_input: bool,
}

impl Default for TablePanel {
    fn default() -> Self {
        Self {
            of: Table::Paths,
            filter: String::new(),
            sort: None,
            rows: TableRows::default(),
            cursor: None,
            editing: None,
            offset_x: 0.0,
            seen: None,
            has_input: false,
        }
    }
}

impl TablePanel {
    /// Takes back a text that was typed but not confirmed.
    pub(crate) fn discard(&mut self) {
        self.editing = None;
    }

    /// Returns `true` if pasted text goes into cells.
    pub(crate) fn takes_paste(&self) -> bool {
        self.has_input && self.cursor.is_some() && self.editing.is_none()
    }

    /// Shows the table of the active file.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        files: &OpenFiles,
        repaint: &RepaintHandle,
        actions: &mut Vec<Action>,
    ) {
        let rect = ui.max_rect();
        let pressed_at = ui.input(|input| {
            let pressed = input.pointer.any_pressed();
            input.pointer.interact_pos().filter(|_| pressed)
        });
        if let Some(at) = pressed_at {
            self.has_input = rect.contains(at);
        }
        let Some(document) = files.document() else {
            self.show_head(ui, None);
            ui.label("…");
            return;
        };
        let before = self.rows_key(files.active_index(), document);
        self.rows.update(document, &before, repaint);
        self.show_head(ui, Some(self.rows.of(&before).len()));
        let key = self.rows_key(files.active_index(), document);
        let columns = columns(document, self.of);
        self.take_paste(ui, document, &columns, &key, actions);
        self.show_grid(ui, document, &columns, &key, actions);
    }

    fn rows_key(&self, file: usize, document: &Document) -> RowsKey {
        RowsKey {
            file,
            state: document.state(),
            of: self.of,
            filter: self.filter.clone(),
            sort: self.sort.clone(),
        }
    }

    /// Shows the choice of the table and the filter.
    fn show_head(&mut self, ui: &mut Ui, count: Option<usize>) {
        ui.horizontal(|ui| {
            let before = self.of;
            for (of, name) in [
                (Table::Paths, t("Edges")),
                (Table::Nodes, t("Nodes")),
                (Table::Stations, t("Stations")),
            ] {
                ui.selectable_value(&mut self.of, of, name);
            }
            if self.of != before {
                (self.sort, self.cursor, self.editing) = (None, None, None);
                self.filter.clear();
            }
            ui.separator();
            let label = ui.label(t("Filter"));
            let field = TextEdit::singleline(&mut self.filter);
            let field = field
                .hint_text("maxSpeed > 1 and id ~ dock")
                .desired_width(240.0);
            ui.add(field).labelled_by(label.id);
            if self.rows.is_busy() {
                ui.spinner();
            }
            match (self.rows.error(), count) {
                (Some(error), _) => {
                    ui.colored_label(ui.visuals().error_fg_color, translated(error));
                }
                (None, Some(count)) => {
                    ui.weak(counted(count as u64, "row"));
                }
                (None, None) => {}
            }
        });
    }

    fn show_grid(
        &mut self,
        ui: &mut Ui,
        document: &Document,
        columns: &[Column],
        key: &RowsKey,
        actions: &mut Vec<Action>,
    ) {
        let selected = document.selected().rows(self.of);
        let first = selected.min();
        let follows = first != self.seen && first.is_some();
        self.seen = first;
        let grid = CellGrid {
            layout: document.layout(),
            of: self.of,
            columns,
            rows: self.rows.of(key),
            selected,
            sort: self.sort.as_ref(),
            cursor: self.cursor,
            scroll_to: first.filter(|_| follows),
        };
        let events = grid.show(ui, &mut self.offset_x, &mut self.editing);
        for event in events {
            self.take_event(event, document, columns, key, actions);
        }
    }

    fn take_event(
        &mut self,
        event: GridEvent,
        document: &Document,
        columns: &[Column],
        key: &RowsKey,
        actions: &mut Vec<Action>,
    ) {
        match event {
            GridEvent::Sort(column) => {
                self.sort = match self.sort.take() {
                    Some((by, false)) if by == columns[column] => Some((by, true)),
                    Some((by, true)) if by == columns[column] => None,
                    _ => Some((columns[column].clone(), false)),
                };
            }
            GridEvent::Select {
                row,
                column,
                mode,
                extends,
            } => {
                let rows = match (extends, self.cursor) {
                    (true, Some((from, _))) => self.between(key, from, row),
                    _ => PathSet::from_iter([row]),
                };
                if !extends {
                    self.cursor = Some((row, column));
                }
                let mut elements = Elements::default();
                *elements.rows_mut(self.of) = rows;
                // The table is where the user looks: it must not scroll.
                self.seen = elements.rows(self.of).min();
                let select = move |document: &mut Document| {
                    document.select_elements(&elements, mode);
                };
                actions.push(Action::Edit(EditTask::view_change(select)));
            }
            GridEvent::Open { row, column } => {
                let column = columns[column].clone();
                if cell::is_editable(self.of, &column) {
                    let text = cell::cell_text(document.layout(), self.of, &column, row);
                    self.editing = Some(CellDraft {
                        before: text.clone(),
                        cell: TypedCell { column, row, text },
                        is_new: true,
                    });
                }
            }
            GridEvent::Confirm => {
                if let Some(draft) = self.editing.take()
                    && draft.cell.text != draft.before
                {
                    actions.push(action(cell::edit_of(document, self.of, draft.cell)));
                }
            }
        }
    }

    /// The shown rows from one to another.
    fn between(&self, key: &RowsKey, from: u32, to: u32) -> PathSet {
        let rows = self.rows.of(key);
        let place = |row: u32| rows.iter().position(|&shown| shown == row);
        match (place(from), place(to)) {
            (Some(a), Some(b)) => rows[a.min(b)..=a.max(b)].iter().copied().collect(),
            _ => PathSet::from_iter([to]),
        }
    }

    fn take_paste(
        &mut self,
        ui: &Ui,
        document: &Document,
        columns: &[Column],
        key: &RowsKey,
        actions: &mut Vec<Action>,
    ) {
        let Some(cursor) = self.cursor.filter(|_| self.takes_paste()) else {
            return;
        };
        if ui.ctx().text_edit_focused() {
            return;
        }
        let pasted = ui.input(|input| {
            let mut events = input.events.iter();
            events.find_map(|event| match event {
                Event::Paste(text) => Some(text.clone()),
                _ => None,
            })
        });
        let Some(text) = pasted else {
            return;
        };
        let target = paste::Target {
            of: self.of,
            columns,
            rows: self.rows.of(key),
            selected: document.selected().rows(self.of),
            cursor,
        };
        let edit = target.cells(&text);
        let edit = edit.and_then(|cells| cell::edit_of_all(document, self.of, &cells));
        actions.push(action(edit));
    }
}

fn action(edit: Result<EditTask, String>) -> Action {
    match edit {
        Ok(edit) => Action::Edit(edit),
        Err(error) => Action::Notify(error),
    }
}

/// The columns of a table in reading order: names and ends first.
fn columns(document: &Document, of: Table) -> Vec<Column> {
    let mut columns = Column::all(document.layout(), of);
    if document.layout().levels.is_empty() {
        columns.retain(|column| *column != Column::Level);
    }
    columns.sort_by_key(|column| match column {
        Column::Id => 0,
        Column::Start | Column::X => 1,
        Column::End | Column::Y => 2,
        Column::Nodes => 3,
        Column::Length => 4,
        Column::Direction => 5,
        Column::Level => 6,
        Column::VehicleType => 7,
        Column::Attribute(_) => 8,
    });
    columns
}
