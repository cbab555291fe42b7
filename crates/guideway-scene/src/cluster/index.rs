//! Cluster index: clusters of rows with the bounds of each, by which a renderer culls.

use std::ops::Range;

use rayon::prelude::*;

use super::bounds::{ClusterBounds, MemberHull};
use super::order::{CLUSTER_LEN, ClusterOrder};

/// Rows in clusters, and where each cluster lies. [`ClusterIndex::begin_edit`] and the methods
/// beside it keep the bounds up to date.
#[derive(Clone, Debug, Default)]
pub struct ClusterIndex {
    pub(super) order: ClusterOrder,
    pub(super) bounds: Vec<Option<ClusterBounds>>,
}

impl ClusterIndex {
    /// Finds the bounds of each cluster by `hull`, which returns the box of some rows. All threads
    /// share the work.
    pub fn new(order: ClusterOrder, hull: impl Fn(&[u32]) -> MemberHull + Sync) -> Self {
        let clusters = order.rows().par_chunks(CLUSTER_LEN);
        let bounds = clusters.map(|rows| hull(rows).map(ClusterBounds::new));
        let bounds = bounds.collect();
        Self { order, bounds }
    }

    /// The order of the rows and their clusters.
    #[inline]
    pub fn order(&self) -> &ClusterOrder {
        &self.order
    }

    /// The rows of a cluster.
    ///
    /// # Panics
    /// If there is no such cluster.
    #[inline]
    pub fn rows_of(&self, cluster: u32) -> &[u32] {
        self.order.rows_of(cluster)
    }

    /// Bounds of each cluster; none of clusters without points.
    #[inline]
    pub fn bounds(&self) -> &[Option<ClusterBounds>] {
        &self.bounds
    }

    /// Appends clusters of rows that other clusters hold, too, until [`Self::drop_copies`]. Edits
    /// do not know them. `hull` returns the box of some rows.
    pub fn append_copies(
        &mut self,
        rows: Vec<u32>,
        hull: impl Fn(&[u32]) -> MemberHull + Sync,
    ) -> Range<u32> {
        let first = self.bounds.len() as u32;
        let clusters = rows.par_chunks(CLUSTER_LEN);
        let bounds = clusters.map(|rows| hull(rows).map(ClusterBounds::new));
        self.bounds.par_extend(bounds);
        self.order.append_copies(rows);
        first..self.bounds.len() as u32
    }

    /// Drops the clusters of [`Self::append_copies`].
    pub fn drop_copies(&mut self) {
        self.order.drop_copies();
        self.bounds.truncate(self.order.cluster_count());
    }

    /// Replaces the bounds of a cluster.
    pub fn set_bounds(&mut self, cluster: u32, bounds: ClusterBounds) {
        self.bounds[cluster as usize] = Some(bounds);
    }

    /// Heap bytes held.
    pub fn heap_bytes(&self) -> usize {
        let bounds = self.bounds.capacity() * size_of::<Option<ClusterBounds>>();
        self.order.heap_bytes() + bounds
    }

    /// Upper bound of [`Self::heap_bytes`] for `rows` rows.
    pub fn planned_bytes(rows: usize) -> usize {
        let bounds = rows.div_ceil(CLUSTER_LEN) * size_of::<Option<ClusterBounds>>();
        bounds + 2 * rows * size_of::<u32>()
    }
}
