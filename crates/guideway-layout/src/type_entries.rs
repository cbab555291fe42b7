//! [`TypeEntries`]: the vehicle types of each element of a table, with properties per type.
//!
//! ```text
//!   element   0        1     2                 an element without an entry is open to all types
//!   entries  [0 1]    [ ]   [2]                stored as ends: 2 2 3
//!   type      tug fork      tug                row in the list of names
//!   maxSpeed  1.0  2.0                         attributes, one row per entry
//! ```

use std::collections::HashMap;
use std::ops::Range;

use crate::{Attributes, Value};

/// The entries of each element of a table, in groups by element. Each name is stored once.
#[derive(Clone, Debug, Default)]
pub struct TypeEntries {
    names: Vec<String>,
    /// Row of each name, because a file may have as many names as elements.
    rows: HashMap<String, u32>,
    ends: Vec<u32>,
    types: Vec<u32>,
    /// Properties that differ between the vehicle types of an element, one row per entry. A
    /// property that applies to all of them is in the table of the element.
    pub attributes: Attributes,
}

impl TypeEntries {
    /// No entries for `rows` elements.
    pub(crate) fn unrestricted(rows: usize) -> Self {
        Self {
            ends: vec![0; rows],
            ..Self::default()
        }
    }

    /// Appends an element with one entry per type.
    ///
    /// # Panics
    /// In later calls when there are 2^32 entries or more; readers refuse such files earlier.
    pub fn push(&mut self, types: &[&str]) {
        for &name in types {
            let row = self.intern(name);
            self.types.push(row);
        }
        self.ends.push(self.types.len() as u32);
    }

    /// Row of a name, which is added if it is new.
    fn intern(&mut self, name: &str) -> u32 {
        match self.rows.get(name) {
            Some(&row) => row,
            None => {
                let row = self.names.len() as u32;
                self.names.push(name.to_owned());
                self.rows.insert(name.to_owned(), row);
                row
            }
        }
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Returns `true` if there are no elements.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Names of all vehicle types, in order of first use.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The vehicle type, if the table names one only.
    pub fn only_name(&self) -> Option<&str> {
        match self.names() {
            [one] => Some(one),
            _ => None,
        }
    }

    /// Rows of the entries of an element; empty if it is open to all types.
    ///
    /// # Panics
    /// When `element` is not below [`Self::len`].
    pub fn entries(&self, element: usize) -> Range<usize> {
        let start = if element == 0 {
            0
        } else {
            self.ends[element - 1] as usize
        };
        start..self.ends[element] as usize
    }

    /// Vehicle type of an entry.
    pub fn type_of(&self, entry: usize) -> &str {
        &self.names[self.types[entry] as usize]
    }

    /// The types of an element; empty means all.
    pub fn of(&self, element: usize) -> impl ExactSizeIterator<Item = &str> {
        self.entries(element).map(|entry| self.type_of(entry))
    }

    /// The entry of an element for a type.
    pub fn entry_for(&self, element: usize, vehicle_type: &str) -> Option<usize> {
        let mut entries = self.entries(element);
        entries.find(|&entry| self.type_of(entry) == vehicle_type)
    }

    /// The first value that an entry of an element has in a column.
    pub fn first_value(&self, element: usize, name: &str) -> Option<Value<'_>> {
        let values = &self.attributes.get(name)?.values;
        self.entries(element).find_map(|entry| values.get(entry))
    }

    /// Replaces the types of an element. Entries of types that stay keep their properties.
    ///
    /// Cost: O(all entries).
    pub fn set(&mut self, element: usize, types: &[&str]) {
        let old = self.entries(element);
        let kept = types.iter().map(|name| self.entry_for(element, name));
        let kept: Vec<Option<usize>> = kept.collect();
        let new: Vec<u32> = types.iter().map(|name| self.intern(name)).collect();
        let after = old.end..self.types.len();
        // A row past the end selects no value.
        let none = self.types.len();
        let rows = (0..old.start)
            .chain(kept.iter().map(|entry| entry.unwrap_or(none)))
            .chain(after);
        let rows: Vec<usize> = rows.collect();
        self.attributes = self.attributes.select(&rows);
        let shift = new.len() as i64 - old.len() as i64;
        self.types.splice(old, new);
        for end in &mut self.ends[element..] {
            *end = (i64::from(*end) + shift) as u32;
        }
    }

    /// Replaces the entries of some elements, each once, by those of `with`, which has one element
    /// for each of them. Names that no element has any more are dropped.
    ///
    /// Cost: O(all entries).
    ///
    /// # Panics
    /// When an element is not below [`Self::len`].
    pub fn replace(&mut self, elements: &[usize], with: &Self) {
        let mut sources = vec![None; self.len()];
        for (at, &element) in elements.iter().enumerate() {
            sources[element] = Some(at);
        }
        let mut replaced = Self::default();
        // A row past the end selects no value.
        let none = self.types.len();
        let (mut kept, mut new_rows, mut new_from) = (Vec::new(), Vec::new(), Vec::new());
        for (element, source) in sources.into_iter().enumerate() {
            let (table, element) = source.map_or((&*self, element), |at| (with, at));
            let entries = table.entries(element);
            if source.is_some() {
                let first = replaced.types.len();
                new_rows.extend(first..first + entries.len());
                kept.extend(entries.clone().map(|_| none));
                new_from.extend(entries);
            } else {
                kept.extend(entries);
            }
            let types: Vec<&str> = table.of(element).collect();
            replaced.push(&types);
        }
        replaced.attributes = self.attributes.select(&kept);
        for column in with.attributes.iter() {
            let values = column.values.select(&new_from);
            let rows = new_rows.iter().copied();
            let (name, quantity) = (&column.name, column.quantity);
            let has_values = values.iter().any(|value| value.is_some());
            if has_values {
                replaced.attributes.set_rows(name, quantity, rows, &values);
            }
        }
        *self = replaced;
    }

    /// Copies the properties of an element's entries to the entries of another one, by type.
    pub fn copy_values(&mut self, from: usize, to: usize) {
        for entry in self.entries(to) {
            if let Some(source) = self.entry_for(from, self.type_of(entry)) {
                self.attributes.copy_row(source, entry);
            }
        }
    }

    /// Renames a vehicle type. Returns false, and changes nothing, if no element has it or the new
    /// name is in use.
    pub fn rename(&mut self, old: &str, new: &str) -> bool {
        if self.rows.contains_key(new) {
            return false;
        }
        let Some(row) = self.rows.remove(old) else {
            return false;
        };
        new.clone_into(&mut self.names[row as usize]);
        self.rows.insert(new.to_owned(), row);
        true
    }

    /// Appends the entries of all elements of another table.
    pub(crate) fn append(&mut self, other: &Self) {
        let first = self.types.len();
        for element in 0..other.len() {
            let types: Vec<&str> = other.of(element).collect();
            self.push(&types);
        }
        self.attributes.extend(first, &other.attributes);
    }

    /// The given elements, in this order.
    #[must_use]
    pub fn select(&self, elements: &[usize]) -> Self {
        let mut selected = Self::default();
        let mut entries = Vec::new();
        for &element in elements {
            let types: Vec<&str> = self.of(element).collect();
            selected.push(&types);
            entries.extend(self.entries(element));
        }
        selected.attributes = self.attributes.select(&entries);
        selected
    }

    /// Heap bytes in use.
    pub fn heap_bytes(&self) -> usize {
        (self.ends.capacity() + self.types.capacity()) * size_of::<u32>()
            + 2 * self.names.iter().map(String::capacity).sum::<usize>()
            + self.attributes.heap_bytes()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> TypeEntries {
        let mut entries = TypeEntries::default();
        entries.push(&["tug", "fork"]);
        entries.push(&[]);
        entries.push(&["tug"]);
        for (entry, speed) in [(0, 1.0), (1, 2.0), (2, 3.0)] {
            entries
                .attributes
                .set(entry, "maxSpeed", Value::Float(speed));
        }
        entries
    }

    fn speeds(entries: &TypeEntries, element: usize) -> Vec<(&str, Option<Value<'_>>)> {
        let value = |entry| entries.attributes.value(entry, "maxSpeed");
        let rows = entries.entries(element);
        rows.map(|e| (entries.type_of(e), value(e))).collect()
    }

    #[test]
    fn set_keeps_the_properties_of_types_that_stay() {
        let mut entries = sample();
        entries.set(0, &["crane", "fork"]);
        entries.set(1, &["tug"]);
        let number = |value| Some(Value::Float(value));
        assert_eq!(
            speeds(&entries, 0),
            [("crane", None), ("fork", number(2.0))]
        );
        assert_eq!(speeds(&entries, 1), [("tug", None)]);
        assert_eq!(speeds(&entries, 2), [("tug", number(3.0))]);
        assert_eq!(entries.first_value(0, "maxSpeed"), number(2.0));
    }

    #[test]
    fn replace_keeps_other_elements_and_is_its_own_inverse() {
        let mut entries = sample();
        let before = entries.clone();
        let mut with = TypeEntries::default();
        with.push(&["crane"]);
        with.push(&["fork", "tug"]);
        with.attributes.set(1, "maxSpeed", Value::Float(7.0));
        let old = entries.select(&[2, 1]);
        entries.replace(&[2, 1], &with);
        let number = |value| Some(Value::Float(value));
        assert_eq!(speeds(&entries, 0), speeds(&before, 0));
        assert_eq!(speeds(&entries, 1), [("fork", number(7.0)), ("tug", None)]);
        assert_eq!(speeds(&entries, 2), [("crane", None)]);
        entries.replace(&[2, 1], &old);
        for element in 0..3 {
            assert_eq!(speeds(&entries, element), speeds(&before, element));
        }
        assert_eq!(entries.names(), before.names());
    }

    #[test]
    fn copies_values_to_the_same_types() {
        let mut entries = sample();
        entries.push(&["fork", "crane"]);
        entries.copy_values(0, 3);
        let number = |value| Some(Value::Float(value));
        assert_eq!(
            speeds(&entries, 3),
            [("fork", number(2.0)), ("crane", None)]
        );
    }

    #[test]
    fn select_and_append_keep_entries_with_their_elements() {
        let entries = sample();
        let mut selected = entries.select(&[2, 1]);
        selected.append(&entries);
        assert_eq!(selected.len(), 5);
        for (row, of) in [2, 1, 0, 1, 2].into_iter().enumerate() {
            assert_eq!(speeds(&selected, row), speeds(&entries, of));
        }
    }

    #[test]
    fn rename_changes_all_entries_and_refuses_a_name_in_use() {
        let mut entries = sample();
        assert!(!entries.rename("tug", "fork"));
        assert!(!entries.rename("crane", "lift"));
        assert!(entries.rename("tug", "tugger"));
        assert!(entries.of(2).eq(["tugger"]));
        assert!(entries.entry_for(0, "tug").is_none());
    }
}
