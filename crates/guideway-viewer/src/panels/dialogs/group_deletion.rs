//! Asks for the fate of the elements of a deleted level or vehicle type.

use eframe::egui::{ScrollArea, Ui};
use guideway_document::{Document, LevelContent, OperationError, TypeUse};
use guideway_layout::Level;

use crate::editing::EditTask;
use crate::language::{counted, say, t};

/// Height of a long list of choices, in points.
const LIST_HEIGHT: f32 = 160.0;

/// The level or the vehicle type; `None` for a new one.
#[derive(Clone)]
pub(super) enum Subject {
    Level(Option<u32>),
    VehicleType(Option<String>),
}

/// The elements of a deleted level or type, as text, and their possible fates.
#[derive(Default)]
pub(super) struct Deletion {
    text: String,
    choices: Vec<(String, Fate)>,
    chosen: usize,
}

#[derive(Clone)]
enum Fate {
    Level(LevelContent),
    ReplaceType(String),
    RemoveType,
}

impl Deletion {
    pub(super) fn of_level(document: &Document, row: u32, others: &[(&Level, u32)]) -> Self {
        let id = &document.layout().levels[row as usize].id;
        let elements = document.elements_of_level(row);
        let zones = document.layout().zones.iter();
        let zones = zones.filter(|zone| zone.level == Some(row)).count() as u64;
        let counts = [
            (elements.paths.len(), "path"),
            (elements.nodes.len(), "node"),
            (elements.stations.len(), "station"),
            (zones, "zone"),
        ];
        let counts = counts.into_iter().filter(|(count, _)| *count > 0);
        let counts: Vec<String> = counts.map(|(count, what)| counted(count, what)).collect();
        if counts.is_empty() {
            return Self {
                text: say!("Nothing is on the level {id}.", id),
                ..Self::default()
            };
        }
        let moves = others.iter().map(|(level, other)| {
            let label = say!("Move to {name}", name = level.name_or_id());
            (label, Fate::Level(LevelContent::MoveTo(Some(*other))))
        });
        let rest = [
            (t("Take off all levels"), LevelContent::MoveTo(None)),
            (t("Delete with the level"), LevelContent::Delete),
        ];
        let rest = rest.map(|(label, content)| (label.to_owned(), Fate::Level(content)));
        Self {
            text: say!(
                "On the level {id} are {all}. What becomes of them?",
                id,
                all = counts.join(", ")
            ),
            choices: moves.chain(rest).collect(),
            chosen: 0,
        }
    }

    pub(super) fn of_type(document: &Document, name: &str, others: &[String]) -> Self {
        let [paths, nodes] = document.count_users_of_type(name);
        if paths + nodes == 0 {
            return Self {
                text: say!("No path and no node names {name}.", name),
                ..Self::default()
            };
        }
        let replace = others.iter().map(|other| {
            let label = say!("Replace by {other}", other);
            (label, Fate::ReplaceType(other.clone()))
        });
        let remove = (t("Take it off them").to_owned(), Fate::RemoveType);
        Self {
            text: say!(
                "{paths} and {nodes} name {name}. What becomes of them?",
                paths = counted(paths as u64, "path"),
                nodes = counted(nodes as u64, "node"),
                name,
            ),
            choices: replace.chain([remove]).collect(),
            chosen: 0,
        }
    }

    /// Shows the text and the choices.
    pub(super) fn show(&mut self, ui: &mut Ui) {
        ui.label(&self.text);
        let list = ScrollArea::vertical().max_height(LIST_HEIGHT);
        let list = list.auto_shrink([false, true]);
        list.show(ui, |ui| {
            for (index, (label, _)) in self.choices.iter().enumerate() {
                ui.radio_value(&mut self.chosen, index, label);
            }
        });
    }

    /// The edit that deletes, with the chosen fate of the elements.
    pub(super) fn edit(&self, subject: &Subject) -> EditTask {
        let fate = self.choices.get(self.chosen);
        let (subject, fate) = (subject.clone(), fate.map(|(_, fate)| fate.clone()));
        EditTask::edit(
            move |document: &mut Document| -> Result<(), OperationError> {
                match (&subject, &fate) {
                    (Subject::Level(Some(row)), Some(Fate::Level(content))) => {
                        document.delete_level(*row, *content)
                    }
                    (Subject::Level(Some(row)), _) => {
                        document.delete_level(*row, LevelContent::Keep)
                    }
                    (Subject::VehicleType(Some(name)), Some(Fate::ReplaceType(other))) => {
                        document.delete_vehicle_type(name, TypeUse::Replace(other))
                    }
                    (Subject::VehicleType(Some(name)), _) => {
                        document.delete_vehicle_type(name, TypeUse::Remove)
                    }
                    _ => Ok(()),
                }
            },
        )
    }
}
