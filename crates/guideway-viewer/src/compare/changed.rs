//! The changes of one comparison, with rows of both documents.

use crate::language::{say, t, translated};
use guideway_document::{Element, Elements, Snapshot, text_format};
use guideway_layout::{Change, Changes, CompareOptions, ElementChange, ElementKind, changes};
use guideway_scene::Table;

/// Positions and curves within a millimeter are the same: files round to that.
const TOLERANCE_M: f64 = 1e-3;

/// The fate of an element from the other file to the active one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ChangeKind {
    Gone,
    New,
    Changed,
}

/// A line of the list of changes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ChangeLine {
    pub(crate) kind: ChangeKind,
    pub(crate) text: String,
    /// The element in the active file, or in the other one if it is gone.
    pub(crate) element: Element,
}

/// All changes from the other file to the active one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Changed {
    pub(crate) lines: Vec<ChangeLine>,
    /// Changes of levels, vehicle types, blocks and zones.
    pub(crate) groups: Vec<String>,
    /// Elements of the other file that are gone.
    pub(crate) gone: Elements,
    /// Elements of the active file that are new.
    pub(crate) new: Elements,
    /// Elements of the active file that differ.
    pub(crate) changed: Elements,
}

impl Changed {
    /// Compares two snapshots; takes seconds for a million paths.
    pub(super) fn of(other: &Snapshot, active: &Snapshot) -> Self {
        let options = CompareOptions {
            tolerance_m: TOLERANCE_M,
            ..CompareOptions::default()
        };
        let (old, new) = (other.to_layout(), active.to_layout());
        let found = changes(&old, &new, &options);
        let rows = |snapshot: &Snapshot| Table::ALL.map(|of| snapshot.kept(of));
        let (old_rows, new_rows) = (rows(other), rows(active));
        let mut changed = Self::default();
        for change in found.elements.iter() {
            let Some(of) = table(change.element) else {
                continue;
            };
            let place = |rows: &[Vec<usize>; 3], row: u32| {
                let rows = &rows[of as usize];
                rows.get(row as usize).map_or(row, |&row| row as u32)
            };
            let (kind, row) = match (change.old_row(), change.new_row()) {
                (Some(old), None) => (ChangeKind::Gone, place(&old_rows, old)),
                (None, Some(new)) => (ChangeKind::New, place(&new_rows, new)),
                (_, Some(new)) => (ChangeKind::Changed, place(&new_rows, new)),
                (None, None) => continue,
            };
            let set = match kind {
                ChangeKind::Gone => &mut changed.gone,
                ChangeKind::New => &mut changed.new,
                ChangeKind::Changed => &mut changed.changed,
            };
            set.rows_mut(of).insert(row);
            changed.lines.push(ChangeLine {
                kind,
                text: text_of(of, &found, &change),
                element: Element::new(of, row),
            });
        }
        let groups = found.groups.iter();
        changed.groups = groups
            .map(|group| {
                let [what, example] = [&group.what, &group.example].map(|text| translated(text));
                format!("{what}: {}; {example}", group.count)
            })
            .collect();
        changed
    }

    /// Number of lines of a kind.
    pub(crate) fn count(&self, kind: ChangeKind) -> usize {
        self.lines.iter().filter(|line| line.kind == kind).count()
    }
}

fn table(kind: ElementKind) -> Option<Table> {
    match kind {
        ElementKind::Path => Some(Table::Paths),
        ElementKind::Node => Some(Table::Nodes),
        ElementKind::Station => Some(Table::Stations),
        ElementKind::Level | ElementKind::VehicleType | ElementKind::Block | ElementKind::Zone => {
            None
        }
    }
}

/// Facts of elements beside their properties, as a comparison names them.
const FACTS: [&str; 7] = [
    "direction",
    "end node",
    "level",
    "nodes",
    "position",
    "start node",
    "vehicle types",
];

/// `path a: maxSpeed 1 m/s, was 2 m/s`.
fn text_of(of: Table, found: &Changes<'_>, change: &ElementChange) -> String {
    let what = t(of.element());
    let id = found.id(change);
    let detail = match change.change {
        Change::Added => t("is new").to_owned(),
        Change::Removed => t("is gone").to_owned(),
        Change::Renamed => say!(
            "is called {name} now",
            name = found.new_id(change).unwrap_or_default()
        ),
        Change::Moved { distance_m } => say!(
            "moved by {length}",
            length = text_format::length(distance_m)
        ),
        Change::Reshaped { greatest_m } => {
            say!(
                "has another shape, up to {length} away",
                length = text_format::length(greatest_m)
            )
        }
        Change::Set(_) => {
            let Some(values) = found.values(change) else {
                return format!("{what} {id}");
            };
            let of = values.vehicle_type.map(|name| say!(" for {name}", name));
            let [before, after] = [values.before, values.after];
            let [before, after] =
                [before, after].map(|v| v.unwrap_or_else(|| t("none").to_owned()));
            let of = of.unwrap_or_default();
            // Names and values of columns are the file's.
            let is_fact = FACTS.contains(&values.property);
            let word = |text: String| match is_fact {
                true => translated(&text).into_owned(),
                false => text,
            };
            let [name, after, before] = [values.property.into(), after, before].map(word);
            say!(
                "{name}{of} is {after}, was {before}",
                name,
                of,
                after,
                before
            )
        }
    };
    format!("{what} {id}: {detail}")
}

#[cfg(test)]
mod tests {
    use guideway_document::Document;
    use guideway_layout::Value;

    use super::*;
    use crate::tests::services::lanes;

    #[test]
    fn changes_have_rows_of_their_documents() {
        let snapshot = |document: &Document| document.snapshot();
        let mut old = Document::new(lanes(3).into(), &Default::default()).unwrap();
        old.delete(&Elements::of_paths([0]), false).unwrap();
        let mut layout = lanes(4);
        layout.paths.attributes.set(1, "speed", Value::Float(9.0));
        let mut new = Document::new(layout.into(), &Default::default()).unwrap();
        new.delete(&Elements::of_paths([0, 2]), false).unwrap();
        let changed = Changed::of(&snapshot(&old), &snapshot(&new));
        let rows = |elements: &Elements| elements.paths.iter().collect::<Vec<_>>();
        assert_eq!(rows(&changed.gone), [2]);
        assert_eq!(rows(&changed.new), [3]);
        assert_eq!(rows(&changed.changed), [1]);
        let texts: Vec<&str> = changed.lines.iter().map(|line| &*line.text).collect();
        assert!(
            texts.contains(&"path lane 1: speed is 9, was 0.5"),
            "{texts:?}"
        );
        assert!(texts.contains(&"path lane 2: is gone"));
        assert_eq!(changed.count(ChangeKind::New), 3, "a path and two nodes");
    }
}
