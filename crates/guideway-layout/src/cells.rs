//! [`Cells`]: a column of optional values.

/// A column of optional values. It takes the memory of the values, plus one byte per row from the
/// first missing value on.
#[derive(Clone, Debug, Default)]
pub struct Cells<T> {
    /// Arbitrary in rows without a value.
    values: Vec<T>,
    /// One flag per row, true if it has a value; `None` while all rows have one.
    present: Option<Vec<bool>>,
}

impl<T: Copy + Default> Cells<T> {
    /// An empty column with capacity for `rows` rows.
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

    /// Returns `true` if there are no rows.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The value of a row; `None` if it has none or lies past the end.
    pub fn get(&self, row: usize) -> Option<T> {
        let value = *self.values.get(row)?;
        let is_present = self.present.as_ref().is_none_or(|present| present[row]);
        is_present.then_some(value)
    }

    /// The cells of all rows.
    pub fn iter(&self) -> impl Iterator<Item = Option<T>> {
        (0..self.len()).map(|row| self.get(row))
    }

    /// The values of the rows that have one.
    pub fn values(&self) -> impl Iterator<Item = T> {
        self.iter().flatten()
    }

    /// Appends rows that all have a value.
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

    /// Sets the value of a row; appends empty rows before it as needed.
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

    /// Removes the value of a row that exists.
    pub(crate) fn clear(&mut self, row: usize) {
        let rows = self.values.len();
        self.present.get_or_insert_with(|| vec![true; rows])[row] = false;
    }

    /// The given rows, in this order; rows past the end have no value.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        rows.iter().map(|&row| self.get(row)).collect()
    }

    /// Appends empty rows until the column has `rows` rows.
    pub(crate) fn pad_to(&mut self, rows: usize) {
        while self.len() < rows {
            self.push(None);
        }
    }

    /// Heap bytes in use.
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
    fn returns_the_values_that_were_set() {
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
    fn equality_compares_cells_and_ignores_the_storage() {
        let whole: Cells<i32> = [Some(1), Some(2)].into_iter().collect();
        let mut filled: Cells<i32> = [Some(1), None].into_iter().collect();
        assert_ne!(whole, filled);
        filled.set(1, 2);
        assert_eq!(whole, filled);
        assert_ne!(whole, [Some(1)].into_iter().collect());
    }
}
