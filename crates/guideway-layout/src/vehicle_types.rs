use std::collections::HashMap;

/// Sets of vehicle types, one a path, with each name held once.
#[derive(Clone, Debug, Default)]
pub struct VehicleTypes {
    names: Vec<String>,
    /// Where each name is, for a file may have as many names as paths.
    rows: HashMap<String, u32>,
    ends: Vec<u32>,
    members: Vec<u32>,
}

impl VehicleTypes {
    pub(crate) fn all(rows: usize) -> Self {
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

    /// The names of all vehicle types, in order of first use.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The types of one path; none means that any may use it.
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

    /// Heap bytes held.
    pub fn heap_bytes(&self) -> usize {
        (self.ends.capacity() + self.members.capacity()) * size_of::<u32>()
            + 2 * self.names.iter().map(String::capacity).sum::<usize>()
    }
}
