//! Comparison of rows: tells whether an element is as its file has it.

use guideway_layout::{Attributes, Layout, Level, SourceSpans, TypeEntries, Value};

/// The levels of a layout as the file has it, and as it is, that are the same object of the file.
pub(super) struct LevelPairs {
    after: Vec<Option<u32>>,
    before: Vec<Option<u32>>,
}

impl LevelPairs {
    /// Pairs the levels by their objects, else by their identifiers.
    pub(super) fn of(old: &Layout, new: &Layout) -> Self {
        let mut pairs = Self {
            after: vec![None; old.levels.len()],
            before: vec![None; new.levels.len()],
        };
        pairs.pair(old, new, |a, b| a.source.is_some() && a.source == b.source);
        pairs.pair(old, new, |a, b| a.id == b.id);
        pairs
    }

    fn pair(&mut self, old: &Layout, new: &Layout, is_same: impl Fn(&Level, &Level) -> bool) {
        for (b, level) in new.levels.iter().enumerate() {
            let is_free = |a: &usize| self.after[*a].is_none();
            let mut free = (0..old.levels.len()).filter(is_free);
            let found = free.find(|&a| is_same(&old.levels[a], level));
            if let (None, Some(a)) = (self.before[b], found) {
                self.before[b] = Some(a as u32);
                self.after[a] = Some(b as u32);
            }
        }
    }

    /// The row now of a level of the file; `None` if it was removed.
    pub(super) fn after(&self, level: u32) -> Option<u32> {
        self.after.get(level as usize).copied().flatten()
    }

    /// Returns whether a level is not in the file.
    pub(super) fn is_new(&self, level: u32) -> bool {
        self.before[level as usize].is_none()
    }

    /// Returns whether an element is on another level than in the file.
    pub(super) fn is_moved(&self, before: Option<u32>, now: Option<u32>) -> bool {
        match before {
            Some(level) => self.after(level).is_none_or(|level| now != Some(level)),
            None => now.is_some(),
        }
    }
}

/// Rows of a table with the same object of the file.
pub(super) struct SameObject {
    /// First byte of the object.
    pub(super) start: usize,
    /// Rows of the layout as the file has it.
    pub(super) old: Vec<u32>,
    /// Rows of the layout as it is.
    pub(super) new: Vec<u32>,
}

/// Pairs the rows of two tables by their objects, in the order of the text. Returns the pairs, and
/// the rows of the second table that are in none. An object without a new row was removed.
pub(super) fn pair(
    old: &SourceSpans,
    old_rows: usize,
    new: &SourceSpans,
    new_rows: usize,
) -> (Vec<SameObject>, Vec<u32>) {
    let sorted = |spans: &SourceSpans, rows: usize| {
        let rows = (0..rows).filter_map(|row| Some((spans.start(row)?, row as u32)));
        let mut rows: Vec<(usize, u32)> = rows.collect();
        rows.sort_unstable();
        rows
    };
    let (old, placed) = (sorted(old, old_rows), sorted(new, new_rows));
    let is_added = |row: &u32| new.start(*row as usize).is_none();
    let mut added: Vec<u32> = (0..new_rows as u32).filter(is_added).collect();
    let mut rest = placed.as_slice();
    let mut pairs = Vec::new();
    for objects in old.chunk_by(|a, b| a.0 == b.0) {
        let start = objects[0].0;
        let before = rest.iter().take_while(|(at, _)| *at < start).count();
        added.extend(rest[..before].iter().map(|(_, row)| row));
        let same = rest[before..].iter().take_while(|(at, _)| *at == start);
        let new: Vec<u32> = same.map(|&(_, row)| row).collect();
        rest = &rest[before + new.len()..];
        pairs.push(SameObject {
            start,
            old: objects.iter().map(|&(_, row)| row).collect(),
            new,
        });
    }
    added.extend(rest.iter().map(|(_, row)| row));
    added.sort_unstable();
    (pairs, added)
}

/// Returns whether a row of two tables has the same values.
pub(super) fn same_values(a: &Attributes, row_a: usize, b: &Attributes, row_b: usize) -> bool {
    let is_in_b = |name: &str, value| same_value(value, b.value(row_b, name));
    let of_a = a
        .iter()
        .all(|column| is_in_b(&column.name, column.values.get(row_a)));
    let mut only_b = b.iter().filter(|column| a.get(&column.name).is_none());
    of_a && only_b.all(|column| column.values.get(row_b).is_none())
}

fn same_value(a: Option<Value<'_>>, b: Option<Value<'_>>) -> bool {
    match (a, b) {
        // An edit widens a column of whole numbers.
        (Some(Value::Int(a)), Some(Value::Float(b))) => a as f64 == b,
        (Some(Value::Float(a)), Some(Value::Int(b))) => a == b as f64,
        (a, b) => a == b,
    }
}

/// Returns whether an element has the same vehicle types with the same values.
pub(super) fn same_types(a: &TypeEntries, row_a: usize, b: &TypeEntries, row_b: usize) -> bool {
    let (of_a, of_b) = (a.entries(row_a), b.entries(row_b));
    of_a.len() == of_b.len()
        && of_a.zip(of_b).all(|(entry_a, entry_b)| {
            a.type_of(entry_a) == b.type_of(entry_b)
                && same_values(&a.attributes, entry_a, &b.attributes, entry_b)
        })
}

/// Returns whether two paths have the same curve, to the last bit. A written curve stands for its
/// runs, which approximate it.
pub(super) fn same_curve(a: &Layout, path_a: usize, b: &Layout, path_b: usize) -> bool {
    match (a.paths.written_curve(path_a), b.paths.written_curve(path_b)) {
        (Some(a), Some(b)) => a == b,
        (None, None) => {
            let (a, b) = (a.paths.get(path_a), b.paths.get(path_b));
            a.runs().len() == b.runs().len()
                && a.runs().zip(b.runs()).all(|(a, b)| a.iter().eq(b.iter()))
        }
        _ => false,
    }
}
