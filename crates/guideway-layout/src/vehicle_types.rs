//! [`VehicleTypes`]: the set of vehicle types that may use each path.

use std::collections::HashMap;

/// One set of vehicle types per path. Each name is stored once.
#[derive(Clone, Debug, Default)]
pub struct VehicleTypes {
    names: Vec<String>,
    /// Row of each name, because a file may have as many names as paths.
    rows: HashMap<String, u32>,
    ends: Vec<u32>,
    members: Vec<u32>,
}

impl VehicleTypes {
    /// No restriction for `rows` paths.
    pub(crate) fn unrestricted(rows: usize) -> Self {
        Self {
            ends: vec![0; rows],
            ..Self::default()
        }
    }

    pub(crate) fn push(&mut self, types: &[&str]) {
        for &name in types {
            let index = match self.rows.get(name) {
                Some(&row) => row,
                None => {
                    let row = self.names.len() as u32;
                    self.names.push(name.to_owned());
                    self.rows.insert(name.to_owned(), row);
                    row
                }
            };
            self.members.push(index);
        }
        self.ends.push(self.members.len() as u32);
    }

    /// Names of all vehicle types, in order of first use.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The types that may use a path; empty means all.
    pub fn of(&self, path: usize) -> impl ExactSizeIterator<Item = &str> {
        let start = if path == 0 {
            0
        } else {
            self.ends[path - 1] as usize
        };
        self.members[start..self.ends[path] as usize]
            .iter()
            .map(|&m| self.names[m as usize].as_str())
    }

    /// Heap bytes in use.
    pub fn heap_bytes(&self) -> usize {
        (self.ends.capacity() + self.members.capacity()) * size_of::<u32>()
            + 2 * self.names.iter().map(String::capacity).sum::<usize>()
    }
}
