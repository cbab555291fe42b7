//! Caches the polylines of every cluster between frames, with the scale and style that they are
//! valid for.

use rayon::prelude::*;

use super::cluster_lines::ClusterLines;
use crate::cpu::ground::frame_context::{FrameContext, LineCacheKey};

/// Largest drift of curves from their cached lines, in units. A quarter of a unit is half of what
/// rounding to units costs already.
const MAX_DRIFT_UNITS: f64 = 0.25;

/// The cached lines of all clusters.
#[derive(Debug, Default)]
pub(crate) struct LineCache {
    /// Lines of each cluster.
    pub(crate) lines: Vec<ClusterLines>,
    /// State of the lines of each cluster; apart from them, because every frame tests all visible
    /// ones.
    pub(crate) states: Vec<LineState>,
    /// Heap bytes of all lines.
    pub(crate) bytes: u64,
}

/// State of the cached lines of a cluster: the views that they are valid for.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LineState {
    /// Key of the views that can draw them; the default key is that of no view.
    pub(crate) key: LineCacheKey,
    /// Bound of the distance, in meters, between the curves and lines that were translated with
    /// them: every translation rounds the control points.
    pub(crate) drift_m: f64,
    /// Number of paths and of lines.
    pub(crate) counts: [u32; 2],
}

impl LineState {
    /// Returns `true` if a frame can draw the lines.
    pub(crate) fn is_valid(&self, ctx: &FrameContext<'_>) -> bool {
        self.key == ctx.cache_key() && self.drift_m <= MAX_DRIFT_UNITS * ctx.unit_m()
    }

    /// Marks the lines as stale.
    pub(crate) fn invalidate(&mut self) {
        self.key = LineCacheKey::default();
    }
}

impl LineCache {
    /// Adds empty entries, up to `clusters` of them.
    pub(crate) fn grow(&mut self, clusters: usize) {
        let new = (self.lines.len()..clusters).into_par_iter();
        self.lines.par_extend(new.map(|_| ClusterLines::default()));
        self.states.resize(clusters, LineState::default());
    }

    /// Drops the entries of all clusters from this one on.
    pub(crate) fn truncate(&mut self, clusters: usize) {
        let dropped = self.lines.drain(clusters..);
        self.bytes -= dropped.map(|lines| lines.bytes()).sum::<u64>();
        self.states.truncate(clusters);
    }

    /// Evicts the lines of all clusters except those that `keep` accepts.
    pub(crate) fn evict(&mut self, keep: impl Fn(u32) -> bool) {
        let entries = self.lines.iter_mut().zip(&mut self.states);
        for (cluster, (lines, state)) in (0..).zip(entries) {
            if !keep(cluster) {
                (*lines, *state) = (ClusterLines::None, LineState::default());
            }
        }
        self.bytes = self.lines.iter().map(ClusterLines::bytes).sum();
    }

    /// Heap bytes of the tables, without the lines.
    pub(crate) fn table_bytes(&self) -> u64 {
        let lines = self.lines.capacity() * size_of::<ClusterLines>();
        (lines + self.states.capacity() * size_of::<LineState>()) as u64
    }

    /// Upper bound of [`Self::table_bytes`].
    pub(crate) fn planned_table_bytes(clusters: usize) -> u64 {
        (clusters * (size_of::<ClusterLines>() + size_of::<LineState>())) as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn evicts_all_but_the_accepted_clusters() {
        let mut cache = LineCache::default();
        cache.grow(3);
        for state in &mut cache.states {
            state.counts = [1, 1];
        }
        cache.evict(|cluster| cluster == 1);
        let counts: Vec<_> = cache.states.iter().map(|state| state.counts[0]).collect();
        assert_eq!((counts, cache.bytes), (vec![0, 1, 0], 0));
    }
}
