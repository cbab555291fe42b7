//! [`for_each_row`]: visits the rows of a column that an edit names, by all threads.

use rayon::prelude::*;

/// Rows that one task visits.
const TASK_ROWS: usize = 1 << 12;

/// Returns `true` if rows ascend, each once.
pub fn rows_ascend<I: Sync>(items: &[I], row: &(impl Fn(&I) -> u32 + Sync)) -> bool {
    // Without an early exit the compiler vectorizes the comparison.
    let ascend = |items: &[I]| {
        let pairs = items.array_windows();
        pairs.fold(true, |all, [a, b]| all & (row(a) < row(b)))
    };
    if items.len() <= TASK_ROWS {
        return ascend(items);
    }
    // Chunks overlap by an item.
    let firsts = (0..items.len()).into_par_iter().step_by(TASK_ROWS);
    firsts.all(|first| ascend(&items[first..items.len().min(first + TASK_ROWS + 1)]))
}

/// Calls a function for the row of each item: by all threads if there are many and they ascend,
/// otherwise in the order of the items.
///
/// # Panics
/// When the column has no such row.
pub fn for_each_row<T: Send, I: Sync>(
    column: &mut [T],
    items: &[I],
    row: &(impl Fn(&I) -> u32 + Sync),
    visit: &(impl Fn(&mut T, &I) + Sync),
) {
    let is_parallel = items.len() > TASK_ROWS && rows_ascend(items, row);
    let task_rows = if is_parallel { TASK_ROWS } else { usize::MAX };
    visit_from(0, column, items, task_rows, row, visit);
}

/// Visits rows of a column from row `first` on.
fn visit_from<T: Send, I: Sync>(
    first: usize,
    column: &mut [T],
    items: &[I],
    task_rows: usize,
    row: &(impl Fn(&I) -> u32 + Sync),
    visit: &(impl Fn(&mut T, &I) + Sync),
) {
    if items.len() <= task_rows {
        for item in items {
            visit(&mut column[row(item) as usize - first], item);
        }
        return;
    }
    let (left, right) = items.split_at(items.len() / 2);
    let middle = row(&right[0]) as usize;
    let (left_rows, right_rows) = column.split_at_mut(middle - first);
    rayon::join(
        || visit_from(first, left_rows, left, task_rows, row, visit),
        || visit_from(middle, right_rows, right, task_rows, row, visit),
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn visits_the_named_rows_of_any_number_and_order() {
        for count in [9, 3 * 5 * TASK_ROWS as u32] {
            let items: Vec<(u32, u32)> = (0..count).step_by(3).map(|row| (row, row + 1)).collect();
            let backward: Vec<_> = items.iter().rev().copied().collect();
            for items in [items, backward] {
                let mut column = vec![0; count as usize];
                for_each_row(&mut column, &items, &|item| item.0, &|to, item| {
                    *to = item.1;
                });
                let is_set = |(row, value): (u32, &u32)| match row % 3 {
                    0 => *value == row + 1,
                    _ => *value == 0,
                };
                assert!((0..).zip(&column).all(is_set));
            }
        }
    }

    #[test]
    fn ascending_rows_are_told_from_others_at_any_place() {
        let rows: Vec<u32> = (0..3 * TASK_ROWS as u32).collect();
        assert!(rows_ascend(&rows, &|row| *row) && rows_ascend(&[], &|row: &u32| *row));
        for at in [1, TASK_ROWS, TASK_ROWS + 1, rows.len() - 1] {
            let mut twice = rows.clone();
            twice[at] = twice[at - 1];
            assert!(!rows_ascend(&twice, &|row| *row), "{at}");
        }
    }
}
