//! Commands that need a number or a name: fillet, weld, distribute, array, level, rename.

use guideway_document::{
    Document, Element, Elements, Group, LevelFact, PathSet, ShapeError, levels_by_height,
};
use guideway_layout::{Layout, UserError};
use guideway_spline::Point;

use super::arrange::{corners, selected_nodes, selected_paths};
use crate::command::Command;
use crate::editing::EditTask;
use crate::language::{say, t};

/// The question for what a command needs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TextQuestion {
    pub(crate) command: Command,
    pub(crate) label: String,
    /// The suggested text.
    pub(crate) text: String,
    /// The vehicle type that the answer renames.
    pub(crate) renamed_type: Option<String>,
}

/// The question of a command; `None` for commands that need nothing typed.
///
/// # Errors
/// When nothing suitable is selected.
pub(crate) fn question(
    command: Command,
    document: &Document,
) -> Option<Result<TextQuestion, UserError>> {
    let ask = |label: &str, text: &str| {
        Ok(TextQuestion {
            command,
            label: label.to_owned(),
            text: text.to_owned(),
            renamed_type: None,
        })
    };
    Some(match command {
        Command::Fillet => {
            corners(document).and_then(|_| ask(t("Radius of the corner, in m"), "1"))
        }
        Command::Weld => {
            selected_paths(document).and_then(|_| ask(t("Weld ends within, in m"), "0.05"))
        }
        Command::Distribute => ask(
            t("Distance from node to node, in m; empty keeps the ends"),
            "",
        ),
        Command::Array => something(document)
            .and_then(|()| ask(t("Number of copies, and the step x, y in m"), "1, 1, 0")),
        Command::MoveToLevel => something(document).and_then(|()| {
            let names = level_names(document.layout()).join(", ");
            ask(&say!("Level, one of: {names}", names), "")
        }),
        Command::Rename => {
            let layout = document.layout();
            match only_named(document.selected()) {
                Ok(Named::Element(element)) => ask(t("New name"), element.id(layout)),
                Ok(Named::Group(group)) => {
                    let label = match group {
                        Group::Level(_) => t("New identifier of the level"),
                        Group::VehicleType(_) => t("New name of the vehicle type"),
                    };
                    let question = ask(label, group.id(layout).unwrap_or_default());
                    question.map(|question| TextQuestion {
                        renamed_type: match group {
                            Group::Level(_) => None,
                            Group::VehicleType(name) => Some(name),
                        },
                        ..question
                    })
                }
                Err(error) => Err(error),
            }
        }
        _ => return None,
    })
}

/// The edit of a command with the answer to its question.
///
/// # Errors
/// The mistake in the text.
pub(crate) fn prompted_edit(command: Command, text: &str) -> Result<EditTask, String> {
    let text = text.trim().to_owned();
    Ok(match command {
        Command::Fillet => {
            let [radius_m] = numbers(&text)?;
            EditTask::edit(move |document: &mut Document| {
                for node in corners(document)? {
                    document.fillet_at(node, radius_m)?;
                }
                Ok::<(), UserError>(())
            })
        }
        Command::Weld => {
            let [tolerance_m] = numbers(&text)?;
            EditTask::edit(move |document: &mut Document| {
                let paths = selected_paths(document)?;
                let welded = document.weld(&paths, tolerance_m);
                welded.map(drop).map_err(UserError::from)
            })
        }
        Command::Distribute => {
            let spacing_m = match text.is_empty() {
                true => None,
                false => Some(numbers::<1>(&text)?[0]),
            };
            EditTask::edit(move |document: &mut Document| {
                let nodes = selected_nodes(document);
                let distributed = document.distribute_nodes(&nodes, spacing_m);
                distributed.map_err(UserError::from)
            })
        }
        Command::Array => {
            let [count, x_m, y_m] = numbers(&text)?;
            let count = copies(count)?;
            EditTask::edit(move |document: &mut Document| {
                let selected = document.selected().clone();
                document
                    .copy(&selected, count, Point::new(x_m, y_m))
                    .map(drop)
            })
        }
        Command::MoveToLevel => EditTask::edit(move |document: &mut Document| {
            let level = level_named(document, &text)?;
            let selected = document.selected().clone();
            let moved = document.set_level(&selected, Some(level));
            moved.map_err(|error| error.to_string())?;
            // Elements that are on another level now are no longer shown.
            document.apply_levels();
            Ok::<(), String>(())
        }),
        Command::Rename => EditTask::edit(move |document: &mut Document| {
            let renamed = match only_named(document.selected())? {
                Named::Element(element) => {
                    let (of, row) = element.table_row();
                    document.rename(of, row, &text)
                }
                Named::Group(Group::Level(row)) => {
                    document.set_level_fact(&PathSet::from_iter([row]), LevelFact::Id(&text))
                }
                Named::Group(Group::VehicleType(name)) => {
                    document.change_vehicle_type(&name, &text, &[])
                }
            };
            renamed.map_err(|error| UserError::from(ShapeError::from(error)))
        }),
        _ => return Err(t("this command needs no text").to_owned()),
    })
}

/// Most copies of one array.
const MAX_COPIES: f64 = 1000.0;

fn copies(count: f64) -> Result<u32, String> {
    let is_count = count.fract() == 0.0 && (1.0..=MAX_COPIES).contains(&count);
    match is_count {
        true => Ok(count as u32),
        false => Err(say!(
            "{count} is no number of copies; type a whole number from 1 to {most}",
            count,
            most = MAX_COPIES
        )),
    }
}

/// The numbers of a text, separated by commas, semicolons or blanks.
fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let is_separator = |sign: char| sign.is_whitespace() || ",;".contains(sign);
    let parts = text.split(is_separator).filter(|part| !part.is_empty());
    let number = |part: &str| {
        let value = part.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| say!("`{part}` is no number; write it as 1.5", part))
    };
    let found: Vec<f64> = parts.map(number).collect::<Result<_, _>>()?;
    let count = found.len();
    found.try_into().map_err(|_| match N {
        1 => say!("type one number, not {count}", count),
        _ => say!(
            "type {all} numbers, separated by commas, not {count}",
            all = N,
            count
        ),
    })
}

fn something(document: &Document) -> Result<(), UserError> {
    match document.selected().has_elements() {
        true => Ok(()),
        false => Err(nothing_selected()),
    }
}

fn nothing_selected() -> UserError {
    let remedy = t("Click a path, node or station first");
    UserError::new("selection", t("nothing is selected"), remedy)
}

/// An object that has a name.
enum Named {
    Element(Element),
    Group(Group),
}

/// The selected element, level or vehicle type, if it is the only one.
fn only_named(selected: &Elements) -> Result<Named, UserError> {
    let elements = selected.iter().map(Named::Element);
    let mut all = elements.chain(selected.groups().map(Named::Group));
    match (all.next(), all.next()) {
        (Some(named), None) => Ok(named),
        (None, _) => Err(nothing_selected()),
        _ => Err(UserError::new(
            "selection",
            t("several elements are selected, and a name is for one"),
            t("Select one of them"),
        )),
    }
}

/// The names of all levels, or their identifiers where they have none, the highest first.
pub(crate) fn level_names(layout: &Layout) -> Vec<&str> {
    let rows = levels_by_height(layout).into_iter();
    let names = rows.map(|row| layout.levels[row as usize].name_or_id());
    names.collect()
}

fn level_named(document: &Document, name: &str) -> Result<u32, String> {
    let level = document.layout().level_named(name);
    level.ok_or_else(|| {
        let names = level_names(document.layout()).join(", ");
        say!(
            "there is no level `{name}`; the levels are: {names}",
            name,
            names
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_counted_and_read() {
        assert_eq!(numbers("3, 2.5; -1"), Ok([3.0, 2.5, -1.0]));
        assert_eq!(numbers::<1>(" 0.05 "), Ok([0.05]));
        for (text, part) in [("", "not 0"), ("1, 2", "not 2"), ("1, x, 2", "`x`")] {
            let error = numbers::<3>(text).unwrap_err();
            assert!(error.contains(part), "{text}: {error}");
        }
        assert!(copies(2.5).is_err() && copies(0.0).is_err() && copies(1e9).is_err());
        assert_eq!(copies(12.0), Ok(12));
    }
}
