//! [`RowPairs`]: pairs of rows that stand for the same element in two layouts.

use std::collections::{HashMap, HashSet};
use std::hash::Hash;

/// Pairs of rows of two tables.
pub(super) struct RowPairs {
    /// Row in the second table of each row of the first one.
    partners: Vec<Option<u32>>,
    /// Rows of the second table without a partner.
    added: Vec<u32>,
    /// Rows were matched by their order, because no identifier was kept.
    by_order: bool,
}

impl RowPairs {
    /// Matches rows by identifier, in order among equal ones. If no identifier matches, the tables
    /// have the same length, and most rows keep their place, matches them by order.
    pub(super) fn of<'a>(
        rows_a: usize,
        rows_b: usize,
        id_a: impl Fn(u32) -> &'a str,
        id_b: impl Fn(u32) -> &'a str,
        keeps_place: impl Fn(u32) -> bool,
    ) -> Self {
        let by_id = Self::by_id(rows_a, rows_b, id_a, id_b);
        let is_renamed = rows_a > 0 && rows_a == rows_b && by_id.added.len() == rows_b;
        let keep_place = || (0..rows_a as u32).filter(|&row| keeps_place(row)).count();
        if is_renamed && 2 * keep_place() >= rows_a {
            return Self {
                partners: (0..rows_a as u32).map(Some).collect(),
                added: Vec::new(),
                by_order: true,
            };
        }
        by_id
    }

    /// Matches rows by identifier, in order among equal ones.
    pub(super) fn by_id<'a>(
        rows_a: usize,
        rows_b: usize,
        id_a: impl Fn(u32) -> &'a str,
        id_b: impl Fn(u32) -> &'a str,
    ) -> Self {
        let mut rows: HashMap<&str, Vec<u32>> = HashMap::new();
        for row in (0..rows_b as u32).rev() {
            rows.entry(id_b(row)).or_default().push(row);
        }
        let take = |row| rows.get_mut(id_a(row)).and_then(Vec::pop);
        let partners: Vec<Option<u32>> = (0..rows_a as u32).map(take).collect();
        let mut added: Vec<u32> = rows.into_values().flatten().collect();
        added.sort_unstable();
        Self {
            partners,
            added,
            by_order: false,
        }
    }

    /// Matches the rows that have no partner yet by a key, such as their place. Rows without a key
    /// and rows whose key several others have stay without a partner.
    pub(super) fn match_rest<K: Eq + Hash>(
        &mut self,
        key_a: impl Fn(u32) -> Option<K>,
        key_b: impl Fn(u32) -> Option<K>,
    ) {
        let removed: Vec<u32> = self.removed().collect();
        let mut rows: HashMap<K, [Vec<u32>; 2]> = HashMap::new();
        for row in removed {
            if let Some(key) = key_a(row) {
                rows.entry(key).or_default()[0].push(row);
            }
        }
        for &row in &self.added {
            if let Some(key) = key_b(row) {
                rows.entry(key).or_default()[1].push(row);
            }
        }
        let mut matched = HashSet::new();
        for [of_a, of_b] in rows.into_values() {
            if let ([a], [b]) = (&of_a[..], &of_b[..]) {
                self.partners[*a as usize] = Some(*b);
                matched.insert(*b);
            }
        }
        self.added.retain(|row| !matched.contains(row));
    }

    /// Matches rows without a partner that are each other's only candidates.
    pub(super) fn match_candidates(&mut self, mut candidates: Vec<(u32, u32)>) {
        candidates.sort_unstable();
        candidates.dedup();
        let mut counts: [HashMap<u32, u32>; 2] = Default::default();
        for &(a, b) in &candidates {
            *counts[0].entry(a).or_default() += 1;
            *counts[1].entry(b).or_default() += 1;
        }
        candidates.retain(|(a, b)| counts[0][a] == 1 && counts[1][b] == 1);
        for &(a, b) in &candidates {
            self.partners[a as usize] = Some(b);
        }
        let matched: HashSet<u32> = candidates.into_iter().map(|(_, b)| b).collect();
        self.added.retain(|row| !matched.contains(row));
    }

    /// Returns `true` if rows of both tables have no partner.
    pub(super) fn has_rest(&self) -> bool {
        !self.added.is_empty() && self.removed().next().is_some()
    }

    /// Row in the first table of each of the `rows` rows of the second one.
    pub(super) fn inverse(&self, rows: usize) -> Vec<Option<u32>> {
        let mut inverse = vec![None; rows];
        self.pairs()
            .for_each(|(a, b)| inverse[b as usize] = Some(a));
        inverse
    }

    /// Pairs of rows, in the order of the first table.
    pub(super) fn pairs(&self) -> impl Iterator<Item = (u32, u32)> {
        let rows = self.partners.iter().enumerate();
        rows.filter_map(|(a, b)| Some((a as u32, (*b)?)))
    }

    /// Rows of the first table without a partner.
    pub(super) fn removed(&self) -> impl Iterator<Item = u32> {
        let rows = self.partners.iter().enumerate();
        rows.filter(|(_, partner)| partner.is_none())
            .map(|(row, _)| row as u32)
    }

    /// Rows of the second table without a partner.
    pub(super) fn added(&self) -> &[u32] {
        &self.added
    }

    /// Returns `true` if identifiers differ and rows were matched by order.
    pub(super) fn is_by_order(&self) -> bool {
        self.by_order
    }

    /// Row in the second table of a row of the first one.
    pub(super) fn partner(&self, row: u32) -> Option<u32> {
        *self.partners.get(row as usize)?
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pairs(a: &[&str], b: &[&str]) -> RowPairs {
        at_places(a, b, &|_| true)
    }

    fn at_places(a: &[&str], b: &[&str], keeps_place: &dyn Fn(u32) -> bool) -> RowPairs {
        let ids = [a, b].map(|ids| move |r: u32| ids[r as usize]);
        RowPairs::of(a.len(), b.len(), ids[0], ids[1], keeps_place)
    }

    #[test]
    fn matches_equal_identifiers_in_order() {
        let found = pairs(&["x", "y", "x", "z"], &["x", "x", "w", "y"]);
        assert!(found.pairs().eq([(0, 0), (1, 3), (2, 1)]));
        assert!(found.removed().eq([3]));
        assert_eq!(found.added(), [2]);
        assert!(!found.is_by_order());
    }

    #[test]
    fn matches_by_order_if_no_identifier_is_kept() {
        let found = pairs(&["a", "b"], &["1", "2"]);
        assert!(found.is_by_order());
        assert!(found.pairs().eq([(0, 0), (1, 1)]));
        assert!(!pairs(&["a", "b"], &["1", "b"]).is_by_order());
        assert!(!pairs(&["a"], &["1", "2"]).is_by_order());
        let other = at_places(&["a", "b", "c"], &["1", "2", "3"], &|row| row == 0);
        assert!(!other.is_by_order() && other.removed().count() == 3);
        let moved = at_places(&["a", "b", "c"], &["1", "2", "3"], &|row| row != 0);
        assert!(moved.is_by_order());
    }

    #[test]
    fn matches_the_rest_by_unique_keys() {
        let (a, b) = (["x", "p", "q", "r"], ["1", "x", "2", "3"]);
        let mut found = RowPairs::by_id(4, 4, |r| a[r as usize], |r| b[r as usize]);
        let keys_a = [None, Some(7), Some(8), Some(9)];
        let keys_b = [Some(8), None, Some(9), Some(9)];
        found.match_rest(|r| keys_a[r as usize], |r| keys_b[r as usize]);
        assert!(found.pairs().eq([(0, 1), (2, 0)]));
        assert!(found.removed().eq([1, 3]));
        assert_eq!(found.added(), [2, 3]);
        // Row 3 has two candidates, row 1 one that has no other.
        assert!(found.has_rest());
        found.match_candidates(vec![(1, 2), (1, 2)]);
        assert_eq!(found.inverse(4), [Some(2), Some(0), Some(1), None]);
        found.match_candidates(vec![(3, 3)]);
        assert!(!found.has_rest() && found.partner(3) == Some(3));
    }

    #[test]
    fn several_candidates_match_none() {
        let ids = |_| "";
        let mut found = RowPairs::by_id(2, 0, ids, ids);
        found.added = vec![0, 1];
        found.match_candidates(vec![(0, 0), (1, 0)]);
        found.match_candidates(vec![(0, 0), (0, 1)]);
        assert_eq!((found.removed().count(), found.added()), (2, &[0, 1][..]));
    }
}
