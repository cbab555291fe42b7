//! Unique names: renames things that share an identifier, by a number at the end.

use std::borrow::Cow;

use hashbrown::HashMap;

/// Names in use, by which new names are made unique.
pub(crate) struct UniqueNames<'a> {
    /// Number of things per name so far; zero for a name that was not taken yet.
    taken: HashMap<Cow<'a, str>, u64>,
    /// Number of things that were renamed.
    pub(crate) renamed: usize,
}

impl<'a> UniqueNames<'a> {
    /// Reserves the names of a table.
    pub(crate) fn new(all: impl Iterator<Item = &'a str>) -> Self {
        Self {
            taken: all.map(|name| (Cow::Borrowed(name), 0)).collect(),
            renamed: 0,
        }
    }

    /// Takes a reserved name for a thing: the name itself, or with a number if another thing has
    /// it.
    pub(crate) fn take(&mut self, name: &'a str) -> Cow<'a, str> {
        let count = self.taken.entry(Cow::Borrowed(name)).or_insert(0);
        *count += 1;
        if *count == 1 && !name.is_empty() {
            return Cow::Borrowed(name);
        }
        self.renamed += 1;
        Cow::Owned(self.numbered(name))
    }

    /// Takes a new name: the name itself, or with a number if it is reserved or taken.
    pub(crate) fn make_unique(&mut self, name: &str) -> String {
        if self.taken.contains_key(name) {
            return self.numbered(name);
        }
        self.taken.insert(Cow::Owned(name.to_owned()), 1);
        name.to_owned()
    }

    fn numbered(&mut self, name: &str) -> String {
        let mut number = self.taken.get(name).copied().unwrap_or(0).max(2);
        loop {
            let numbered = format!("{name}~{number}");
            if !self.taken.contains_key(numbered.as_str()) {
                // The next search starts after this number.
                self.taken.insert(Cow::Owned(name.to_owned()), number);
                self.taken.insert(Cow::Owned(numbered.clone()), 1);
                return numbered;
            }
            number += 1;
        }
    }
}
