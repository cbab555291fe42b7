//! Entries of vehicle types in the text of a file: changes, removes and adds those that were
//! edited.

use std::collections::{HashMap, HashSet, VecDeque};

use crate::json::{ArrayEdit, Splices, Tree, items_at, member};
use crate::lif::model::robot_name;
use crate::lif::version::Version;
use crate::lif::write::Elements;

/// Vehicle types of an element with their properties. An empty name stands for an entry without a
/// type.
pub(super) type Types<'a> = Vec<(&'a str, Tree<'a>)>;

/// The positions of each name in a list of types, because an element may have many.
struct Positions<'t>(HashMap<&'t str, VecDeque<usize>>);

impl<'t> Positions<'t> {
    fn of(types: &'t Types<'_>) -> Self {
        let mut positions = HashMap::<_, VecDeque<_>>::new();
        for (at, (name, _)) in types.iter().enumerate() {
            positions.entry(*name).or_default().push_back(at);
        }
        Self(positions)
    }

    /// The first position of a name that is not taken.
    fn first_free(&mut self, name: &str, is_taken: &[bool]) -> Option<usize> {
        let positions = self.0.get_mut(name)?;
        while positions.front().is_some_and(|&at| is_taken[at]) {
            positions.pop_front();
        }
        positions.front().copied()
    }
}

/// Changes the entries of the object at byte `at`, whose types were `old` and are `new`.
pub(super) fn change<'a>(
    splices: &mut Splices<'_>,
    elements: &Elements<'a>,
    version: Version,
    (at, key): (usize, &'static str),
    old: &Types<'_>,
    new: &Types<'a>,
) {
    let text = splices.text();
    let mut is_written = vec![false; new.len()];
    let mut is_used = vec![false; old.len()];
    let (mut old_positions, mut new_positions) = (Positions::of(old), Positions::of(new));
    let array = member(text, at, key).filter(|array| text.as_bytes()[array.start] == b'[');
    let mut edit = array.map(|array| ArrayEdit::new(text, array.start));
    let items = edit
        .as_ref()
        .map_or(Vec::new(), |edit| edit.items().to_vec());
    for (index, item) in items.into_iter().enumerate() {
        let names = names(text, item.start, version);
        let before = names.iter().map(|name| {
            let found = old_positions.first_free(name, &is_used)?;
            is_used[found] = true;
            Some(found)
        });
        let Some(before) = before.collect::<Vec<_>>().into_iter().flatten().next() else {
            // An entry that the layout does not use.
            continue;
        };
        let after = names.iter();
        let after = after.map(|name| new_positions.first_free(name, &is_written));
        let after: Vec<Option<usize>> = after.collect();
        let Some(first) = after.iter().flatten().next().copied() else {
            if let Some(edit) = &mut edit {
                edit.remove(index);
            }
            continue;
        };
        let is_kept = |after: &Option<usize>| after.is_some_and(|i| new[i].1 == new[first].1);
        for i in after.iter().filter(|after| is_kept(after)).flatten() {
            is_written[*i] = true;
        }
        splices.change(item.start, &old[before].1, &new[first].1);
        let robots = member(text, item.start, "mobileRobotTypes");
        if let (Some(robots), false) = (robots, after.iter().all(is_kept)) {
            let mut list = ArrayEdit::new(text, robots.start);
            let lost = after
                .iter()
                .enumerate()
                .filter(|(_, after)| !is_kept(after));
            lost.for_each(|(i, _)| list.remove(i));
            list.apply(splices);
        }
    }
    // A type of before that has no entry in the text needs none now.
    let without = old.iter().zip(&is_used).filter(|(_, is_used)| !*is_used);
    let without: HashSet<&str> = without.map(|((name, _), _)| *name).collect();
    let added = new.iter().zip(is_written);
    let added = added.filter(|((name, _), is_written)| !is_written && !without.contains(name));
    let added = added.map(|((name, properties), _)| {
        let name = if name.is_empty() {
            crate::lif::model::ANY_TYPE
        } else {
            name
        };
        (name, properties.clone())
    });
    let added = elements.entries(added.collect());
    match edit {
        Some(mut edit) => {
            added.into_iter().for_each(|entry| edit.push(entry));
            edit.apply(splices);
        }
        None if added.is_empty() => {}
        None => {
            let list = Tree::Object(vec![(key.into(), Tree::Array(added))]);
            splices.change(at, &Tree::Object(Vec::new()), &list);
        }
    }
}

/// Returns the names of the vehicle types of an entry, as the reader names them; one empty name if
/// it has none.
fn names(text: &str, at: usize, version: Version) -> Vec<String> {
    let string = |at: usize, key: &str| {
        let value = &text[member(text, at, key)?];
        match serde_json::from_str(value).ok()? {
            serde_json::Value::String(text) => Some(text),
            serde_json::Value::Number(_) => Some(value.to_owned()),
            _ => None,
        }
    };
    let names: Vec<String> = match version {
        Version::V1 => string(at, "vehicleTypeId").into_iter().collect(),
        Version::V2 => {
            let robots = member(text, at, "mobileRobotTypes");
            let robots = robots.map_or(Vec::new(), |robots| items_at(text, robots.start));
            let name = |at| {
                let [manufacturer, series] =
                    ["manufacturer", "seriesName"].map(|key| string(at, key));
                robot_name(manufacturer.as_deref(), series.as_deref()).unwrap_or_default()
            };
            robots.into_iter().map(|robot| name(robot.start)).collect()
        }
    };
    if names.is_empty() {
        vec![String::new()]
    } else {
        names
    }
}
