use std::ops::Range;

use guideway_render::FrameSize;

use super::canvas::TILE_PX;
use super::cluster::Cluster;

/// The tiles of a band of the picture: whole rows of them.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    pub(super) columns: usize,
    pub(super) rows: Range<usize>,
}

impl Grid {
    /// The tiles of a whole picture.
    pub(super) fn whole(size: FrameSize) -> Self {
        let tiles = |side_px: u32| (side_px as usize).div_ceil(TILE_PX);
        Self {
            columns: tiles(size.width()),
            rows: 0..tiles(size.height()),
        }
    }

    /// Number of tiles.
    pub(super) fn len(&self) -> usize {
        self.columns * self.rows.len()
    }
}

/// Which clusters may leave a mark on each tile.
#[derive(Default)]
pub(super) struct Bins {
    /// Where the clusters of each tile end.
    ends: Vec<u32>,
    clusters: Vec<u32>,
}

impl Bins {
    /// Bytes held.
    pub(super) fn bytes(&self) -> u64 {
        ((self.ends.capacity() + self.clusters.capacity()) * size_of::<u32>()) as u64
    }

    /// Lists the clusters of each tile, unless that takes more than so many bytes; then says how many.
    pub(super) fn fill(
        &mut self,
        clusters: &[Cluster],
        grid: &Grid,
        limit_bytes: u64,
    ) -> Result<(), u64> {
        self.ends.clear();
        self.ends.resize(grid.len() + 1, 0);
        for (_, rows, columns) in in_sight(clusters, grid) {
            for row in rows {
                let tiles = row * grid.columns + columns.start..row * grid.columns + columns.end;
                // Ends begin as counts, one place later: there each becomes the start of its tile.
                self.ends[tiles.start + 1..tiles.end + 1]
                    .iter_mut()
                    .for_each(|n| *n += 1);
            }
        }
        let total: u64 = self.ends.iter().map(|&n| u64::from(n)).sum();
        let needed = (total + self.ends.len() as u64) * size_of::<u32>() as u64;
        if needed > limit_bytes || total > u64::from(u32::MAX) {
            return Err(needed);
        }
        let mut next = 0;
        for end in &mut self.ends {
            next += *end;
            *end = next;
        }
        if self.clusters.capacity() < total as usize {
            self.clusters = Vec::with_capacity(total as usize);
        }
        self.clusters.clear();
        self.clusters.resize(total as usize, 0);
        for (cluster, rows, columns) in in_sight(clusters, grid) {
            for row in rows {
                for column in columns.clone() {
                    let place = &mut self.ends[row * grid.columns + column];
                    self.clusters[*place as usize] = cluster;
                    *place += 1;
                }
            }
        }
        Ok(())
    }

    /// The clusters of a tile, by ascending number.
    pub(super) fn tile(&self, tile: usize) -> &[u32] {
        let start = if tile == 0 { 0 } else { self.ends[tile - 1] };
        &self.clusters[start as usize..self.ends[tile] as usize]
    }
}

/// Clusters in sight, each with the rows (from the first of the grid) and columns of its tiles.
fn in_sight(
    clusters: &[Cluster],
    grid: &Grid,
) -> impl Iterator<Item = (u32, Range<usize>, Range<usize>)> {
    clusters.iter().zip(0..).filter_map(|(cluster, number)| {
        let sight = cluster.sight.as_ref()?;
        let first = sight.rows.start.max(grid.rows.start);
        let end = sight.rows.end.min(grid.rows.end).max(first);
        let rows = first - grid.rows.start..end - grid.rows.start;
        Some((number, rows, sight.columns.clone()))
    })
}
