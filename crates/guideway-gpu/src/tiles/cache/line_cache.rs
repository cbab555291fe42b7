//! Cached lines: all lines of one LOD, except those of clusters that were edited since.

use guideway_scene::View;

use crate::tiles::frame::line_lod::LineLod;
use crate::tiles::frame::line_source::LineSource;
use guideway_scene::cluster::DirtyClusters;

/// Part of the clusters, or of their lines, that may change before all lines are flattened again.
const MAX_CHANGED_PART: usize = 4;

/// Describes the cached lines of the line buffers.
pub(crate) struct CachedLines {
    pub(crate) lod: LineLod,
    /// Number of lines, with invalidated ones.
    count: u32,
    /// Number of lines when all were flattened.
    flattened: u32,
    /// The view that flattened the lines, and the paths it showed. `None` after a refresh.
    pub(crate) drawn_paths: Option<(View, u32)>,
    dirty: DirtyClusters,
}

impl CachedLines {
    pub(crate) fn new(lod: LineLod, count: u32, drawn_paths: (View, u32)) -> Self {
        Self {
            lod,
            count,
            flattened: count,
            drawn_paths: Some(drawn_paths),
            dirty: DirtyClusters::default(),
        }
    }

    pub(crate) fn count(&self) -> u32 {
        self.count
    }

    /// The lines as source of a window.
    pub(crate) fn source(&self) -> LineSource {
        match self.dirty.len() {
            0 => LineSource::Cached(self.count),
            dirty => LineSource::Refreshed(self.count, dirty),
        }
    }

    /// Indices of the dirty clusters.
    pub(crate) fn dirty_clusters(&self) -> impl Iterator<Item = usize> {
        self.dirty.iter()
    }

    /// Marks clusters, of `clusters` in all. Returns `false` if all lines had better be flattened
    /// again.
    pub(crate) fn mark_dirty(&mut self, dirty: &DirtyClusters, clusters: usize) -> bool {
        self.dirty.join(dirty);
        self.dirty.len() as usize <= max_dirty(clusters)
    }

    /// The cache after dirty clusters were flattened again, with `count` lines in all. `None` if
    /// too many lines are new.
    pub(crate) fn refreshed(self, count: u32) -> Option<Self> {
        // About as many lines are invalidated as are added.
        let added = count.saturating_sub(self.flattened) as usize;
        (added <= self.flattened as usize / MAX_CHANGED_PART).then_some(Self {
            count,
            drawn_paths: None,
            dirty: DirtyClusters::default(),
            ..self
        })
    }
}

/// Most dirty clusters of a cache, of `clusters` in all.
pub(crate) fn max_dirty(clusters: usize) -> usize {
    clusters / MAX_CHANGED_PART
}
