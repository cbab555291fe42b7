//! Cuts an order of rows into clusters of [`CLUSTER_LEN`] and finds the cluster of a row.

use std::sync::OnceLock;

use guideway_spline::{Bounds, Point};
use rayon::prelude::*;

use super::hilbert_sort::hilbert_order;

/// Rows per cluster: as many as [`Members`] has bits.
pub const CLUSTER_LEN: usize = Members::BITS as usize;

/// Some rows of one cluster: bit `i` is its `i`-th row.
pub type Members = u64;

/// Rows that one task of [`ClusterOrder::members_by_cluster`] looks up: fewer are not worth a task.
const TASK_ROWS: usize = 1 << 16;

/// An order of rows, cut into clusters: rows `64 k .. 64 k + 64` of the order are cluster `k`.
#[derive(Clone, Debug, Default)]
pub struct ClusterOrder {
    rows: Vec<u32>,
    /// Rows of clusters behind those of all rows: see [`Self::append_copies`].
    copies: Vec<u32>,
    /// Place of each row in `rows`; built at the first look-up.
    places: OnceLock<Vec<u32>>,
}

impl ClusterOrder {
    /// Orders the rows `0..count` along a Hilbert curve through `bounds`; see [`hilbert_order`].
    pub fn sorted(
        count: usize,
        bounds: Option<Bounds<f64>>,
        position: impl Fn(usize) -> Option<Point<f64>> + Sync,
    ) -> Self {
        Self {
            rows: hilbert_order(count, bounds, position),
            copies: Vec::new(),
            places: OnceLock::new(),
        }
    }

    /// The rows `0..count` in their own order, which follows a Hilbert curve already.
    pub fn of_sorted_rows(count: usize) -> Self {
        Self {
            rows: (0..count as u32).collect(),
            copies: Vec::new(),
            places: OnceLock::new(),
        }
    }

    /// All rows, those of a cluster next to each other.
    pub fn rows(&self) -> &[u32] {
        &self.rows
    }

    /// Number of clusters.
    pub fn cluster_count(&self) -> usize {
        self.rows.len().div_ceil(CLUSTER_LEN) + self.copies.len().div_ceil(CLUSTER_LEN)
    }

    /// The rows of a cluster: [`CLUSTER_LEN`], or fewer in the last cluster.
    ///
    /// # Panics
    /// If there is no such cluster.
    #[inline]
    pub fn rows_of(&self, cluster: u32) -> &[u32] {
        let first = cluster as usize * CLUSTER_LEN;
        let (rows, first) = match first.checked_sub(self.rows.len().next_multiple_of(CLUSTER_LEN)) {
            Some(first) => (&self.copies, first),
            None => (&self.rows, first),
        };
        &rows[first..rows.len().min(first + CLUSTER_LEN)]
    }

    /// Appends clusters of rows that other clusters hold, too. Look-ups find the others.
    pub(super) fn append_copies(&mut self, rows: Vec<u32>) {
        self.copies = rows;
    }

    /// Drops the clusters of [`Self::append_copies`].
    pub(super) fn drop_copies(&mut self) {
        self.copies = Vec::new();
    }

    /// Index of a row in [`Self::rows`], if there is such a row.
    pub fn place(&self, row: u32) -> Option<usize> {
        let place = self.places().get(row as usize)?;
        Some(*place as usize)
    }

    fn places(&self) -> &[u32] {
        self.places.get_or_init(|| {
            let mut places = vec![0; self.rows.len()];
            for (&row, place) in self.rows.iter().zip(0..) {
                places[row as usize] = place;
            }
            places
        })
    }

    /// Appends `count` new rows, numbered from the last one on. They fill up the last cluster, then
    /// clusters behind it, in ascending order.
    pub fn append(&mut self, count: usize) {
        let first = self.rows.len() as u32;
        let new_rows = first..first + count as u32;
        self.rows.extend(new_rows.clone());
        if let Some(places) = self.places.get_mut() {
            places.extend(new_rows);
        }
    }

    /// The clusters that hold some of `rows`, ascending, with the members that are among them.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn members_by_cluster(&self, rows: &[u32]) -> Vec<(u32, Members)> {
        let (clusters, places) = (self.cluster_count(), self.places());
        let mark = |mut members: Vec<Members>, rows: &[u32]| {
            for &row in rows {
                let place = places[row as usize] as usize;
                members[place / CLUSTER_LEN] |= 1 << (place % CLUSTER_LEN);
            }
            members
        };
        let merge = |mut a: Vec<Members>, b: Vec<Members>| {
            a.iter_mut().zip(b).for_each(|(a, b)| *a |= b);
            a
        };
        let tasks = rows.par_chunks(TASK_ROWS);
        let tasks = tasks.fold(|| vec![0; clusters], mark);
        let members = tasks.reduce_with(merge).unwrap_or_default();
        let named = (0..).zip(members).filter(|(_, members)| *members != 0);
        named.collect()
    }

    /// Heap bytes held.
    pub fn heap_bytes(&self) -> usize {
        let places = self.places.get().map_or(0, Vec::capacity);
        (self.rows.capacity() + self.copies.capacity() + places) * size_of::<u32>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn order(count: usize) -> ClusterOrder {
        let position = |row: usize| Point::new((row * 37 % count) as f64, 0.0);
        let bounds = Bounds::of_points((0..count).map(position));
        ClusterOrder::sorted(count, bounds, |row| Some(position(row)))
    }

    #[test]
    fn places_invert_the_order_after_appends_too() {
        let mut order = order(150);
        assert_eq!(order.place(150), None);
        order.append(60);
        assert_eq!(order.cluster_count(), 4);
        for (place, &row) in order.rows().iter().enumerate() {
            assert_eq!(order.place(row), Some(place));
        }
        assert_eq!(order.rows_of(3).len(), 210 - 3 * CLUSTER_LEN);
    }

    #[test]
    fn sorted_rows_stay_where_they_are() {
        let order = ClusterOrder::of_sorted_rows(150);
        assert!(order.rows().iter().copied().eq(0..150));
        assert_eq!((order.cluster_count(), order.place(140)), (3, Some(140)));
    }

    #[test]
    fn copies_have_clusters_behind_all_others_until_they_are_dropped() {
        let mut order = order(150);
        let places: Vec<_> = (0..150).map(|row| order.place(row)).collect();
        order.append_copies((0..70).collect());
        assert_eq!(order.cluster_count(), 5);
        let lengths: Vec<_> = (0..5).map(|at| order.rows_of(at).len()).collect();
        assert_eq!(lengths, [64, 64, 22, 64, 6]);
        assert_eq!(order.rows_of(4), [64, 65, 66, 67, 68, 69]);
        assert!((0..150).map(|row| order.place(row)).eq(places));
        order.drop_copies();
        assert_eq!((order.cluster_count(), order.rows_of(2).len()), (3, 22));
    }

    #[test]
    fn members_are_the_named_rows_of_each_cluster() {
        let order = order(200);
        let named: Vec<u32> = (0..200).step_by(3).collect();
        let mut found = Vec::new();
        for (cluster, members) in order.members_by_cluster(&named) {
            let rows = order.rows_of(cluster).iter().enumerate();
            found.extend(rows.filter_map(|(i, &row)| (members >> i & 1 == 1).then_some(row)));
        }
        found.sort_unstable();
        assert_eq!(found, named);
        assert!(order.members_by_cluster(&[]).is_empty());
    }
}
