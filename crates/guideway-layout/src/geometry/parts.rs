//! Visits disjoint parts of a slice by all threads.

use std::ops::Range;

/// Parts that one task visits.
const TASK_PARTS: usize = 256;

/// Calls a function for each part of a slice: in parallel if there are many and they ascend.
pub(super) fn for_each_part<T: Send, J: Sync>(
    items: &mut [T],
    parts: &[(Range<usize>, J)],
    visit: &(impl Fn(&mut [T], &J) + Sync),
) {
    let ascend = parts.array_windows().all(|[a, b]| a.0.end <= b.0.start);
    let task_parts = if ascend { TASK_PARTS } else { usize::MAX };
    visit_from(0, items, parts, task_parts, visit);
}

/// Visits parts of the items from index `first` on.
fn visit_from<T: Send, J: Sync>(
    first: usize,
    items: &mut [T],
    parts: &[(Range<usize>, J)],
    task_parts: usize,
    visit: &(impl Fn(&mut [T], &J) + Sync),
) {
    if parts.len() <= task_parts {
        for (range, job) in parts {
            visit(&mut items[range.start - first..range.end - first], job);
        }
        return;
    }
    let (left, right) = parts.split_at(parts.len() / 2);
    let middle = right[0].0.start;
    let (left_items, right_items) = items.split_at_mut(middle - first);
    rayon::join(
        || visit_from(first, left_items, left, task_parts, visit),
        || visit_from(middle, right_items, right, task_parts, visit),
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn visits_many_parts_in_order_and_few_in_any_order() {
        let mut items = vec![0_usize; 3 * 5 * TASK_PARTS];
        let every_third = (0..items.len()).step_by(3);
        let parts: Vec<_> = every_third.map(|at| (at..at + 2, at)).collect();
        for_each_part(&mut items, &parts, &|part, &at| part.fill(at));
        let is_set = |(at, item): (usize, &usize)| match at % 3 {
            2 => *item == 0,
            other => *item == at - other,
        };
        assert!(items.iter().enumerate().all(is_set));
        for_each_part(
            &mut items,
            &[(4..6, 7), (0..1, 8), (4..5, 9)],
            &|part, &job| {
                part.fill(job);
            },
        );
        assert_eq!(items[..6], [8, 0, 0, 3, 9, 7]);
    }
}
