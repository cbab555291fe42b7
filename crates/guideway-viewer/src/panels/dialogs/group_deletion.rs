//! Asks for the fate of the elements of deleted levels and vehicle types.

use eframe::egui::{Context, Id, Modal, ScrollArea, Ui};
use guideway_document::{Document, Elements, Group, LevelContent, TypeUse};

use crate::action::Action;
use crate::editing::EditTask;
use crate::language::{counted, say, t};
use crate::selection::counts;

/// Height of a long list of choices, in points.
const LIST_HEIGHT: f32 = 160.0;

/// Width of the dialog, in points.
const WIDTH: f32 = 360.0;

/// The dialog; open while it has something to delete.
#[derive(Default)]
pub(crate) struct GroupDeletion {
    open: Option<Deletion>,
}

impl GroupDeletion {
    /// Deletes elements, levels and vehicle types: by the returned edit, or by the answer to the
    /// question for what belongs to them.
    pub(crate) fn ask(&mut self, document: &Document, all: Elements) -> Option<EditTask> {
        let deletion = Deletion::new(document, all);
        if !deletion.asks() {
            return Some(deletion.edit());
        }
        self.open = Some(deletion);
        None
    }

    pub(super) fn is_open(&self) -> bool {
        self.open.is_some()
    }

    pub(super) fn close(&mut self) {
        self.open = None;
    }

    /// Shows the dialog, and returns the edit of its answer.
    pub(super) fn show(&mut self, ctx: &Context) -> Option<Action> {
        let open = self.open.as_mut()?;
        let (mut deletes, mut cancels) = (false, false);
        let modal = Modal::new(Id::unique("deletion")).show(ctx, |ui| {
            ui.set_width(WIDTH);
            open.show(ui);
            ui.horizontal(|ui| {
                deletes = ui.button(t("Delete")).clicked();
                cancels = ui.button(t("Cancel")).clicked();
            });
        });
        if deletes || cancels || modal.should_close() {
            let deletion = self.open.take().filter(|_| deletes);
            return deletion.map(|deletion| Action::Edit(deletion.edit()));
        }
        None
    }
}

/// The deletion, and the fate of the elements that belong to what is deleted.
struct Deletion {
    all: Elements,
    of_levels: Option<Question<LevelContent>>,
    /// The type that takes the place of the deleted ones, if any.
    of_types: Option<Question<Option<String>>>,
}

/// A question with its possible answers; without any it is a fact.
struct Question<T> {
    text: String,
    choices: Vec<(String, T)>,
    chosen: usize,
}

impl Deletion {
    fn new(document: &Document, all: Elements) -> Self {
        Self {
            of_levels: (!all.levels.is_empty()).then(|| of_levels(document, &all)),
            of_types: (!all.vehicle_types.is_empty()).then(|| of_types(document, &all)),
            all,
        }
    }

    /// Returns `true` if there is something to decide.
    fn asks(&self) -> bool {
        self.of_levels.as_ref().is_some_and(Question::asks)
            || self.of_types.as_ref().is_some_and(Question::asks)
    }

    /// Shows the questions.
    fn show(&mut self, ui: &mut Ui) {
        let elements = Elements {
            levels: Default::default(),
            vehicle_types: Default::default(),
            ..self.all.clone()
        };
        let elements = counts(&elements);
        if !elements.is_empty() {
            let elements = elements.join(", ");
            ui.label(say!("Deleted too: {elements}.", elements));
        }
        if let Some(question) = &mut self.of_levels {
            question.show(ui, "levels");
        }
        if let Some(question) = &mut self.of_types {
            question.show(ui, "vehicle types");
        }
    }

    /// The edit that deletes, with the chosen fate of the elements.
    fn edit(&self) -> EditTask {
        let content = self.of_levels.as_ref().and_then(Question::answer);
        let content = content.copied().unwrap_or(LevelContent::Keep);
        let other = self.of_types.as_ref().and_then(Question::answer);
        let (all, other) = (self.all.clone(), other.cloned().flatten());
        EditTask::edit(move |document: &mut Document| {
            let uses = other.as_deref().map_or(TypeUse::Remove, TypeUse::Replace);
            document.delete_all(&all, content, uses)
        })
    }
}

impl<T> Question<T> {
    fn fact(text: String) -> Self {
        Self {
            text,
            choices: Vec::new(),
            chosen: 0,
        }
    }

    fn asks(&self) -> bool {
        !self.choices.is_empty()
    }

    fn answer(&self) -> Option<&T> {
        self.choices.get(self.chosen).map(|(_, answer)| answer)
    }

    fn show(&mut self, ui: &mut Ui, id: &str) {
        ui.label(&self.text);
        let list = ScrollArea::vertical().max_height(LIST_HEIGHT).id_salt(id);
        let list = list.auto_shrink([false, true]);
        list.show(ui, |ui| {
            for (index, (label, _)) in self.choices.iter().enumerate() {
                ui.radio_value(&mut self.chosen, index, label);
            }
        });
    }
}

fn of_levels(document: &Document, all: &Elements) -> Question<LevelContent> {
    let layout = document.layout();
    let levels = layout.levels.iter().zip(0..);
    let (gone, others): (Vec<_>, Vec<_>) = levels.partition(|(_, row)| all.levels.contains(*row));
    let ids: Vec<&str> = gone.iter().map(|(level, _)| &*level.id).collect();
    let ids = ids.join(", ");
    let zones = layout.zones.iter();
    let zones = zones.filter(|zone| zone.level.is_some_and(|level| all.levels.contains(level)));
    let elements = document.members_of_all(all.levels.iter().map(Group::Level));
    let mut counts = counts(&elements);
    let zones = zones.count() as u64;
    counts.extend((zones > 0).then(|| counted(zones, "zone")));
    let is_one = gone.len() == 1;
    if counts.is_empty() {
        return Question::fact(match is_one {
            true => say!("Nothing is on the level {id}.", id = ids),
            false => say!("Nothing is on the levels {ids}.", ids),
        });
    }
    let counts = counts.join(", ");
    let moves = others.iter().map(|(level, other)| {
        let label = say!("Move to {name}", name = level.name_or_id());
        (label, LevelContent::MoveTo(Some(*other)))
    });
    let rest = [
        (t("Take off all levels"), LevelContent::MoveTo(None)),
        (t("Delete with the level"), LevelContent::Delete),
    ];
    let rest = rest.map(|(label, content)| (label.to_owned(), content));
    Question {
        text: match is_one {
            true => say!(
                "On the level {id} are {all}. What becomes of them?",
                id = ids,
                all = counts
            ),
            false => say!(
                "On the levels {ids} are {all}. What becomes of them?",
                ids,
                all = counts
            ),
        },
        choices: moves.chain(rest).collect(),
        chosen: 0,
    }
}

fn of_types(document: &Document, all: &Elements) -> Question<Option<String>> {
    let gone = &all.vehicle_types;
    let [paths, nodes] = document.count_users_of_types(gone);
    let names: Vec<&str> = gone.iter().map(String::as_str).collect();
    let name = names.join(", ");
    if paths + nodes == 0 {
        return Question::fact(say!("No path and no node names {name}.", name));
    }
    let others = document.layout().vehicle_type_names().into_iter();
    let others = others.filter(|other| !gone.contains(*other));
    let replace = others.map(|other| {
        let label = say!("Replace by {other}", other);
        (label, Some(other.to_owned()))
    });
    let remove = (t("Take it off them").to_owned(), None);
    Question {
        text: say!(
            "{paths} and {nodes} name {name}. What becomes of them?",
            paths = counted(paths, "path"),
            nodes = counted(nodes, "node"),
            name,
        ),
        choices: replace.chain([remove]).collect(),
        chosen: 0,
    }
}
