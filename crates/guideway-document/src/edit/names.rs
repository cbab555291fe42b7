//! Names of new elements: unique in their table, numbered where the wanted name is taken.

use std::collections::{HashMap, HashSet};

use guideway_scene::{Scene, Table};

use super::error::OperationError;
use crate::document::Document;

/// The identifiers of a table that are in use.
pub(super) struct Names<'a> {
    of: Table,
    taken: HashSet<&'a str>,
    new: HashSet<String>,
    /// Last number tried for a name.
    numbers: HashMap<String, u32>,
}

impl<'a> Names<'a> {
    pub(super) fn of(of: Table, scene: &'a Scene) -> Self {
        let layout = scene.layout();
        let rows = 0..of.row_count(layout) as u32;
        let rows = rows.filter(|&row| scene.exists(of, row));
        Self {
            of,
            taken: rows.map(|row| of.id(layout, row)).collect(),
            new: HashSet::new(),
            numbers: HashMap::new(),
        }
    }

    /// Takes the wanted name, or the first of `NAME 2`, `NAME 3` and so on that is free.
    pub(super) fn unique(&mut self, wanted: &str) -> String {
        let mut name = wanted.to_owned();
        while self.is_taken(&name) {
            let number = self.numbers.entry(wanted.to_owned()).or_insert(1);
            *number += 1;
            name = format!("{wanted} {number}");
        }
        self.new.insert(name.clone());
        name
    }

    /// Takes the next number that is free, with as many digits: for `dock-07` it is `dock-08`, or
    /// `dock-12` if those up to `dock-11` are in use. `None` for a name that ends in no number.
    pub(super) fn next_number(&mut self, id: &str) -> Option<String> {
        let stem = id.trim_end_matches(|sign: char| sign.is_ascii_digit());
        let width = id.len() - stem.len();
        let own: u32 = id[stem.len()..].parse().ok()?;
        // A number of a million copies is not looked for from the first one on.
        let last = self.numbers.get(stem).copied().unwrap_or(own).max(own);
        let numbers = last.checked_add(1)?..=u32::MAX;
        let mut names = numbers.map(|number| (number, format!("{stem}{number:0width$}")));
        let (number, name) = names.find(|(_, name)| !self.is_taken(name))?;
        self.numbers.insert(stem.to_owned(), number);
        self.new.insert(name.clone());
        Some(name)
    }

    /// Takes names for the pieces of an element: `NAME.1`, `NAME.2` and so on, without those in
    /// use.
    pub(super) fn pieces(&mut self, name: &str, count: usize) -> Vec<String> {
        let numbered = (1..).map(|number: u64| format!("{name}.{number}"));
        let free = numbered.filter(|name| !self.is_taken(name)).take(count);
        let free: Vec<String> = free.collect();
        self.new.extend(free.iter().cloned());
        free
    }

    /// Takes exactly this name.
    pub(super) fn exact(&mut self, id: &str) -> Result<String, OperationError> {
        let what = self.of.element();
        if id.is_empty() {
            return Err(OperationError::EmptyId { what });
        }
        if self.is_taken(id) {
            let id = id.to_owned();
            return Err(OperationError::IdTaken { what, id });
        }
        self.new.insert(id.to_owned());
        Ok(id.to_owned())
    }

    /// Gives a name free.
    pub(super) fn release(&mut self, id: &str) {
        self.taken.remove(id);
    }

    /// Returns `true` if an element has the name, or it was taken for a new one.
    pub(super) fn is_taken(&self, id: &str) -> bool {
        self.taken.contains(id) || self.new.contains(id)
    }
}

impl Document {
    /// The names of a table, to take new ones.
    pub(super) fn names(&self, of: Table) -> Names<'_> {
        Names::of(of, &self.scene)
    }
}
