/// The values of a column, of which some rows may have none: as much memory as the values, and a byte a row more once one is
/// missing.
#[derive(Clone, Debug, Default)]
pub struct Cells<T> {
    /// Anything where there is none.
    values: Vec<T>,
    /// Whether there is one; none while all rows have one.
    present: Option<Vec<bool>>,
}

impl<T: Copy + Default> Cells<T> {
    /// None yet, with room for so many rows.
    pub fn with_capacity(rows: usize) -> Self {
        Self {
            values: Vec::with_capacity(rows),
            present: None,
        }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The value of a row, if it has one; rows past the end have none.
    pub fn get(&self, row: usize) -> Option<T> {
        let value = *self.values.get(row)?;
        let is_there = self.present.as_ref().is_none_or(|present| present[row]);
        is_there.then_some(value)
    }

    /// The values of all rows.
    pub fn iter(&self) -> impl Iterator<Item = Option<T>> {
        (0..self.len()).map(|row| self.get(row))
    }

    /// The values that there are.
    pub fn values(&self) -> impl Iterator<Item = T> {
        self.iter().flatten()
    }

    /// Appends rows that have a value each.
    pub fn extend_present(&mut self, values: impl ExactSizeIterator<Item = T>) {
        if let Some(present) = &mut self.present {
            present.resize(self.values.len() + values.len(), true);
        }
        self.values.extend(values);
    }

    /// Appends a row.
    pub fn push(&mut self, value: Option<T>) {
        if value.is_none() && self.present.is_none() {
            self.present = Some(vec![true; self.values.len()]);
        }
        if let Some(present) = &mut self.present {
            present.push(value.is_some());
        }
        self.values.push(value.unwrap_or_default());
    }

    /// Gives a row a value, with rows of none before it as needed.
    pub(crate) fn set(&mut self, row: usize, value: T) {
        self.pad_to(row);
        if row == self.len() {
            self.push(Some(value));
            return;
        }
        self.values[row] = value;
        if let Some(present) = &mut self.present {
            present[row] = true;
        }
    }

    /// Appends rows of none until there are so many.
    pub(crate) fn pad_to(&mut self, rows: usize) {
        while self.len() < rows {
            self.push(None);
        }
    }

    /// Heap bytes held.
    pub(crate) fn heap_bytes(&self) -> usize {
        let present = self.present.as_ref().map_or(0, Vec::capacity);
        self.values.capacity() * size_of::<T>() + present
    }
}

impl<T: Copy + Default> FromIterator<Option<T>> for Cells<T> {
    fn from_iter<I: IntoIterator<Item = Option<T>>>(rows: I) -> Self {
        let mut cells = Self::default();
        rows.into_iter().for_each(|row| cells.push(row));
        cells
    }
}

impl<T: Copy + Default + PartialEq> PartialEq for Cells<T> {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_have_what_they_were_given() {
        let mut cells = Cells::with_capacity(3);
        cells.extend_present([1, 2].into_iter());
        assert_eq!(cells.heap_bytes(), 3 * size_of::<i32>());
        cells.push(None);
        cells.extend_present([4].into_iter());
        cells.set(6, 7);
        cells.set(2, 3);
        let rows = [Some(1), Some(2), Some(3), Some(4), None, None, Some(7)];
        assert!(cells.iter().eq(rows));
        assert_eq!((cells.get(7), cells.len()), (None, 7));
        assert!(cells.values().eq([1, 2, 3, 4, 7]));
    }

    #[test]
    fn columns_are_equal_by_what_their_rows_have() {
        let whole: Cells<i32> = [Some(1), Some(2)].into_iter().collect();
        let mut filled: Cells<i32> = [Some(1), None].into_iter().collect();
        assert_ne!(whole, filled);
        filled.set(1, 2);
        assert_eq!(whole, filled);
        assert_ne!(whole, [Some(1)].into_iter().collect());
    }
}
