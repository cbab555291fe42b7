//! Cells of the table: their texts, and the edits that typed texts become.

use guideway_document::{Column, Document, NewCells, PathSet};
use guideway_layout::{Direction, Layout, Value};
use guideway_scene::Table;
use guideway_spline::Point;

use super::super::properties::{FieldKind, TypedValue, kind_of};
use crate::editing::EditTask;
use crate::language::{direction_name, say, t};
use crate::selection::level_names;
use crate::units::shown_value;

/// The text of a cell; empty without a value. Values that differ per vehicle type are listed.
pub(super) fn cell_text(layout: &Layout, of: Table, column: &Column, row: u32) -> String {
    let value = |value: Value<'_>| match (column, value) {
        (Column::Length | Column::X | Column::Y, Value::Float(m)) => {
            // `Display` prints no trailing zeros.
            ((m * 1e3).round() / 1e3).to_string()
        }
        (Column::Direction, Value::Text(word)) => t(word).to_owned(),
        (_, value) => shown_value(value, column.unit(layout, of)),
    };
    if let Column::Attribute(name) = column
        && of.attributes(layout).value(row as usize, name).is_none()
    {
        return per_type_text(layout, of, name, row);
    }
    let text = column.with_value(layout, of, row, value);
    text.unwrap_or_default()
}

/// `fork: 1; tug: 1.5`, or one value if all types have the same.
fn per_type_text(layout: &Layout, of: Table, name: &str, row: u32) -> String {
    let Some(entries) = of.entries(layout) else {
        return String::new();
    };
    let all = entries.entries(row as usize);
    let column = entries.attributes.get(name);
    let unit = column.and_then(|column| Some(column.quantity?.unit()));
    let values: Vec<(&str, String)> = all
        .filter_map(|entry| {
            let value = entries.attributes.value(entry, name)?;
            Some((entries.type_of(entry), shown_value(value, unit)))
        })
        .collect();
    let is_same = values.windows(2).all(|pair| pair[0].1 == pair[1].1);
    match values.first() {
        Some((_, value)) if is_same && values.len() == entries.of(row as usize).count() => {
            value.clone()
        }
        _ => {
            let texts = values
                .iter()
                .map(|(name, value)| format!("{name}: {value}"));
            texts.collect::<Vec<_>>().join("; ")
        }
    }
}

/// Returns `true` if cells of a column can be edited.
pub(super) fn is_editable(of: Table, column: &Column) -> bool {
    match column {
        Column::Id | Column::Level | Column::Attribute(_) => true,
        Column::Direction => of == Table::Paths,
        Column::VehicleType => of != Table::Stations,
        Column::X | Column::Y => of == Table::Nodes,
        Column::Length | Column::Start | Column::End | Column::Nodes => false,
    }
}

/// A typed text of one cell.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TypedCell {
    pub(super) column: Column,
    pub(super) row: u32,
    pub(super) text: String,
}

/// A text that is being typed into a cell.
pub(super) struct CellDraft {
    pub(super) cell: TypedCell,
    pub(super) before: String,
    /// True in the first frame of the field.
    pub(super) is_new: bool,
}

/// The edit of one cell.
///
/// # Errors
/// Why the cell does not take the text.
pub(super) fn edit_of(document: &Document, of: Table, cell: TypedCell) -> Result<EditTask, String> {
    let (layout, row) = (document.layout(), cell.row);
    let text = cell.text.trim().to_owned();
    let rows = PathSet::from_iter([row]);
    match cell.column {
        Column::Id | Column::Attribute(_) => edit_of_all(document, of, &[cell]),
        Column::Direction => {
            let direction = direction_named(&text)?;
            Ok(EditTask::edit(move |document: &mut Document| {
                document.set_direction(&rows, direction)
            }))
        }
        Column::VehicleType => Ok(EditTask::edit(move |document: &mut Document| {
            let types = text
                .split(',')
                .map(str::trim)
                .filter(|name| !name.is_empty());
            let types: Vec<&str> = types.collect();
            document.set_vehicle_types(of, &rows, &types)
        })),
        Column::Level => {
            let level = level_named(layout, &text)?;
            let mut elements = guideway_document::Elements::default();
            elements.rows_mut(of).insert(row);
            Ok(EditTask::edit(move |document: &mut Document| {
                document.set_level(&elements, level)
            }))
        }
        Column::X | Column::Y if of == Table::Nodes => {
            let number = TypedValue::parse(&text, FieldKind::Number, Some("m"))?;
            let Some(TypedValue::Number(to_m)) = number else {
                return Err(t("a node needs a position in m").to_owned());
            };
            let at = layout.nodes.position_m(row);
            let to = match cell.column {
                Column::X => Point::new(to_m, at.y),
                _ => Point::new(at.x, to_m),
            };
            Ok(EditTask::edit(move |document: &mut Document| {
                document.move_node(row, to)
            }))
        }
        column => Err(say!(
            "{name} follows from the drawing",
            name = column.name()
        )),
    }
}

/// The edit of several cells with names or properties, as one step.
///
/// # Errors
/// The first text that its cell does not take.
pub(super) fn edit_of_all(
    document: &Document,
    of: Table,
    cells: &[TypedCell],
) -> Result<EditTask, String> {
    let layout = document.layout();
    let mut ids: Vec<(u32, String)> = Vec::new();
    let mut values: Vec<(String, u32, Option<TypedValue>)> = Vec::new();
    for cell in cells {
        let place = || {
            say!(
                "{column} of {id}",
                column = cell.column.name(),
                id = of.id(layout, cell.row)
            )
        };
        match &cell.column {
            Column::Id => ids.push((cell.row, cell.text.trim().to_owned())),
            Column::Attribute(name) => {
                let kind = attribute_kind(layout, of, name);
                let unit = cell.column.unit(layout, of);
                let value = TypedValue::parse(&cell.text, kind, unit);
                let value = value.map_err(|error| format!("{}: {error}", place()))?;
                values.push((name.clone(), cell.row, value));
            }
            column => {
                let name = column.name();
                return Err(say!(
                    "{name} takes no pasted cells; paste names or properties",
                    name
                ));
            }
        }
    }
    // Cells of one column with one value become one change.
    values.sort_by(|a, b| a.0.cmp(&b.0));
    Ok(EditTask::edit(move |document: &mut Document| {
        let ids: Vec<(u32, &str)> = ids.iter().map(|(row, id)| (*row, &**id)).collect();
        let values: Vec<(&str, u32, Option<Value<'_>>)> = values
            .iter()
            .map(|(name, row, value)| (&**name, *row, value.as_ref().map(TypedValue::as_value)))
            .collect();
        document.set_cells(&NewCells {
            of,
            ids: &ids,
            values: &values,
        })
    }))
}

fn attribute_kind(layout: &Layout, of: Table, name: &str) -> FieldKind {
    let own = of.attributes(layout).get(name);
    let column = own.or_else(|| of.entries(layout)?.attributes.get(name));
    column.map_or(FieldKind::Text, |column| kind_of(name, &column.values))
}

fn direction_named(text: &str) -> Result<Direction, String> {
    match text {
        "one-way" => Ok(Direction::Forward),
        "two-way" => Ok(Direction::Both),
        _ if text == direction_name(Direction::Forward) => Ok(Direction::Forward),
        _ if text == direction_name(Direction::Both) => Ok(Direction::Both),
        _ => Err(t("choose one of one-way, two-way").to_owned()),
    }
}

fn level_named(layout: &Layout, text: &str) -> Result<Option<u32>, String> {
    if text.is_empty() {
        return Ok(None);
    }
    let level = layout.level_named(text).map(Some);
    level.ok_or_else(|| {
        let names = level_names(layout).join(", ");
        say!(
            "no level is called {text}; choose one of {names}",
            text,
            names
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Language, set_language};
    use crate::tests::services::lanes;

    #[test]
    fn values_per_vehicle_type_are_listed() {
        let mut layout = lanes(2);
        let types = layout.paths.vehicle_types_mut();
        types.set(0, &["fork", "tug"]);
        let entry = types.entry_for(0, "tug").unwrap();
        types.attributes.set(entry, "cost", Value::Int(3));
        let cost = Column::Attribute("cost".into());
        assert_eq!(cell_text(&layout, Table::Paths, &cost, 0), "tug: 3");
        let types = layout.paths.vehicle_types_mut();
        let entry = types.entry_for(0, "fork").unwrap();
        types.attributes.set(entry, "cost", Value::Int(3));
        assert_eq!(cell_text(&layout, Table::Paths, &cost, 0), "3");
        assert_eq!(cell_text(&layout, Table::Paths, &cost, 1), "");
        assert_eq!(cell_text(&layout, Table::Paths, &Column::Length, 1), "10");
        assert_eq!(cell_text(&layout, Table::Nodes, &Column::Y, 3), "2");
    }

    #[test]
    fn texts_that_fit_no_cell_are_refused_with_the_place() {
        let document = Document::new(lanes(2).into(), &Default::default()).unwrap();
        let edit = |column: Column, text: &str| {
            let cell = TypedCell {
                column,
                row: 1,
                text: text.to_owned(),
            };
            edit_of(&document, Table::Paths, cell).err()
        };
        let speed = Column::Attribute("speed".into());
        assert_eq!(edit(speed.clone(), "2.5"), None);
        let error = edit(speed, "fast").unwrap();
        assert!(
            error.contains("speed of lane 1: fast is no number"),
            "{error}"
        );
        assert_eq!(edit(Column::Direction, "two-way"), None);
        assert!(edit(Column::Direction, "up").is_some());
        set_language(Language::German);
        let text = cell_text(document.layout(), Table::Paths, &Column::Direction, 1);
        assert_eq!(text, "Einbahn");
        assert_eq!(edit(Column::Direction, "beide Richtungen"), None);
        set_language(Language::English);
        assert!(edit(Column::Length, "3").unwrap().contains("follows"));
        assert!(edit(Column::Level, "attic").unwrap().contains("attic"));
    }
}
