//! Optional columns: a column exists from the first row on whose value is not the default.

/// A column of one value per row, or `None` while all rows have the default.
pub(crate) type OptionalColumn<T> = Option<Vec<T>>;

/// An optional column, created if `is_needed`.
pub(crate) fn column_for<T: Clone>(
    column: &mut OptionalColumn<T>,
    rows: usize,
    none: T,
    is_needed: bool,
) -> Option<&mut Vec<T>> {
    if is_needed {
        column.get_or_insert_with(|| vec![none; rows]);
    }
    column.as_mut()
}

/// Appends to an optional column of `rows` rows; creates it for the first value other than `none`.
pub(crate) fn push<T: Clone + PartialEq>(
    column: &mut OptionalColumn<T>,
    rows: usize,
    none: T,
    value: T,
) {
    let is_needed = value != none;
    if let Some(column) = column_for(column, rows, none, is_needed) {
        column.push(value);
    }
}

/// Sets a row of an optional column of `rows` rows; creates it for the first value other than
/// `none`.
pub(crate) fn set<T: Clone + PartialEq>(
    column: &mut OptionalColumn<T>,
    rows: usize,
    row: usize,
    none: T,
    value: T,
) {
    let is_needed = value != none;
    if let Some(column) = column_for(column, rows, none, is_needed) {
        column[row] = value;
    }
}

/// The given rows of an optional column, in this order.
pub(crate) fn pick<T: Copy>(column: &OptionalColumn<T>, rows: &[usize]) -> OptionalColumn<T> {
    let column = column.as_ref()?;
    Some(rows.iter().map(|&row| column[row]).collect())
}

pub(crate) fn bytes_of<T>(column: &OptionalColumn<T>) -> usize {
    column.as_ref().map_or(0, |c| c.capacity() * size_of::<T>())
}

/// Appends a column of `other_rows` rows to one of `rows` rows, with values mapped by `map`.
pub(crate) fn append<T: Copy + PartialEq>(
    column: &mut OptionalColumn<T>,
    rows: usize,
    other: &OptionalColumn<T>,
    other_rows: usize,
    none: T,
    map: impl Fn(T) -> T,
) {
    if column.is_none() && other.is_none() {
        return;
    }
    let column = column.get_or_insert_with(|| vec![none; rows]);
    match other {
        Some(other) => column.extend(other.iter().map(|&value| map(value))),
        None => column.resize(rows + other_rows, none),
    }
}
