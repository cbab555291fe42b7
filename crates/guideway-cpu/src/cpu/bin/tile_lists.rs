//! Lists per tile: the keys of the visible clusters that may touch it, and the line ranges of
//! clusters that span many tiles.
//!
//! A counting sort by tile, in parallel: each bin counts its items per tile, then places them.
//!
//! ```text
//!             tile 0      tile 1    tile 2
//!   bin 0   [ 3 7       | 7       | 9 12  ]     a bin per part of the clusters,
//!   bin 1   [ 80        |         | 81    ]     filled by one thread
//!   list of tile 2: 9 12 81                     (bins in order)
//! ```

use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use rayon::prelude::*;

use super::cull::VisibleCluster;
use super::line_lists::{BinInput, LineLists, LineRange};

/// Bins per thread: enough for an even load.
const BINS_PER_THREAD: usize = 4;
/// Most bins: each tile reads all of them.
const MAX_BINS: usize = 32;
/// Fewest items per bin: fewer are not worth a task.
const MIN_BIN_ITEMS: usize = 512;

/// The lists of all tiles of a band.
pub(crate) struct TileLists {
    /// Keys of visible clusters.
    clusters: BinnedItems<u32>,
    /// Line ranges of clusters that span many tiles.
    line_ranges: BinnedItems<LineRange>,
    pub(crate) line_lists: LineLists,
}

/// One list per tile, in bins.
#[derive(Default)]
struct BinnedItems<T> {
    bins: Vec<Bin<T>>,
}

/// The part of all lists that one thread fills.
#[derive(Default)]
struct Bin<T> {
    /// End of the list of each tile in `items`. While the bin is filled: first the length of the
    /// list of the tile before, then the next free place.
    ends: Vec<u32>,
    items: Vec<T>,
}

impl TileLists {
    pub(crate) fn new() -> Self {
        Self {
            clusters: BinnedItems::default(),
            line_ranges: BinnedItems::default(),
            line_lists: LineLists::new(),
        }
    }

    /// Heap bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        self.clusters.bytes() + self.line_ranges.bytes() + self.line_lists.bytes()
    }

    /// Lists what may touch each damaged tile.
    ///
    /// # Errors
    /// If the lists need more than `limit_bytes`: the bytes they need.
    pub(crate) fn fill(&mut self, input: BinInput<'_>, limit_bytes: u64) -> Result<(), u64> {
        let range_bytes = size_of::<(u32, LineRange)>() + size_of::<LineRange>();
        // Line ranges only save time: they get half of the memory.
        let max_ranges = limit_bytes as usize / 2 / range_bytes;
        self.line_lists.find(input, max_ranges);
        let line_list_bytes = self.line_lists.bytes();
        let limit_bytes = limit_bytes.saturating_sub(line_list_bytes);
        let tiles = input.grid.len();
        let lists = self.line_lists.lists();
        let size = (lists.len(), lists.iter().map(Vec::len).sum());
        self.line_ranges
            .fill(tiles, size, limit_bytes, |part| {
                let line_ranges = lists[part].iter().flatten();
                line_ranges.map(|&(tile, line_range)| (tile as usize, line_range))
            })
            .map_err(|bytes| bytes + line_list_bytes)?;

        let range_bytes = self.line_ranges.bytes();
        let limit_bytes = limit_bytes.saturating_sub(range_bytes);
        let visible = input.visible;
        let size = (visible.chunks(), visible.len());
        self.clusters
            .fill(tiles, size, limit_bytes, |chunks| {
                let others = self.line_lists.others(visible, chunks);
                others.flat_map(|(key, cluster)| {
                    damaged_tiles(cluster, input).map(move |tile| (tile, key))
                })
            })
            .map_err(|bytes| bytes + line_list_bytes + range_bytes)
    }

    /// Keys of the visible clusters that may touch a tile, ascending.
    pub(crate) fn clusters(&self, tile: usize) -> impl Iterator<Item = u32> {
        self.clusters.of(tile).flatten().copied()
    }

    /// Line ranges that may touch a tile, by ascending key. Those of a cluster are in one slice.
    pub(crate) fn line_ranges(&self, tile: usize) -> impl Iterator<Item = &[LineRange]> {
        self.line_ranges.of(tile)
    }
}

impl<T: Copy + Default + Send> BinnedItems<T> {
    /// Fills the lists from `items`, which returns pairs of tile and item for a part of `0..steps`;
    /// `total` is about the number of items.
    ///
    /// # Errors
    /// If the lists need more than `limit_bytes`: the bytes they need.
    fn fill<I: Iterator<Item = (usize, T)>>(
        &mut self,
        tiles: usize,
        (steps, total): (usize, usize),
        limit_bytes: u64,
        items: impl Fn(Range<usize>) -> I + Sync,
    ) -> Result<(), u64> {
        let max_bins = (BINS_PER_THREAD * rayon::current_num_threads()).min(MAX_BINS);
        let bins = (total / MIN_BIN_ITEMS).clamp(1, max_bins);
        self.bins.resize_with(bins, Bin::default);
        let (total_bytes, all_fit) = (AtomicU64::new(0), AtomicBool::new(true));
        let numbered = self.bins.par_iter_mut().enumerate().with_max_len(1);
        numbered.for_each(|(i, bin)| {
            let part = steps * i / bins..steps * (i + 1) / bins;
            let len = bin.count(tiles, items(part.clone()));
            let bytes = (len * size_of::<T>() + tiles * size_of::<u32>()) as u64;
            let before = total_bytes.fetch_add(bytes, Ordering::Relaxed);
            if before + bytes <= limit_bytes && u32::try_from(len).is_ok() {
                bin.place(len, items(part));
            } else {
                all_fit.store(false, Ordering::Relaxed);
            }
        });
        if all_fit.into_inner() {
            Ok(())
        } else {
            Err(total_bytes.into_inner())
        }
    }

    /// The list of a tile, one slice per bin.
    fn of(&self, tile: usize) -> impl Iterator<Item = &[T]> {
        let bins = self.bins.iter();
        bins.map(move |bin| bin.of(tile))
    }

    fn bytes(&self) -> u64 {
        self.bins.iter().map(Bin::bytes).sum()
    }
}

impl<T: Copy + Default> Bin<T> {
    /// Counts the items per tile and returns their number.
    fn count(&mut self, tiles: usize, items: impl Iterator<Item = (usize, T)>) -> usize {
        self.ends.clear();
        self.ends.resize(tiles + 1, 0);
        items.for_each(|(tile, _)| self.ends[tile + 1] += 1);
        self.ends.iter().map(|&len| len as usize).sum()
    }

    /// Places the items that were counted, at most 2^32.
    fn place(&mut self, len: usize, items: impl Iterator<Item = (usize, T)>) {
        let mut next = 0;
        for end in &mut self.ends {
            next += *end;
            *end = next;
        }
        if self.items.capacity() < len {
            self.items = Vec::with_capacity(len);
        }
        self.items.clear();
        self.items.resize(len, T::default());
        items.for_each(|(tile, item)| {
            let place = &mut self.ends[tile];
            self.items[*place as usize] = item;
            *place += 1;
        });
    }

    fn of(&self, tile: usize) -> &[T] {
        let start = if tile == 0 { 0 } else { self.ends[tile - 1] };
        &self.items[start as usize..self.ends[tile] as usize]
    }

    fn bytes(&self) -> u64 {
        let items = self.items.capacity() * size_of::<T>();
        (self.ends.capacity() * size_of::<u32>() + items) as u64
    }
}

/// The damaged tiles of the grid that a cluster may touch.
#[inline(always)]
fn damaged_tiles<'a>(
    cluster: &VisibleCluster,
    input: BinInput<'a>,
) -> impl Iterator<Item = usize> + 'a {
    let BinInput { grid, damage, .. } = input;
    let (rows, columns) = (cluster.rows(), cluster.columns());
    let rows = rows.start.max(grid.rows.start)..rows.end.min(grid.rows.end);
    rows.flat_map(move |row| {
        let columns = columns.clone();
        let damaged = columns.filter(move |&column| !damage.at(column, row).is_empty());
        damaged.map(move |column| grid.tile(column, row))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_hold_the_items_of_their_tile_in_order() {
        let mut lists = BinnedItems::default();
        let items = |part: Range<usize>| part.map(|i| (i * 7 % 5, i as u32));
        lists.fill(5, (3000, 3000), u64::MAX, items).unwrap();
        for tile in 0..5 {
            let list = lists.of(tile).flatten().copied();
            assert!(list.eq((0..3000).filter(|i| i * 7 % 5 == tile as u32)));
        }
        let needed = lists.fill(5, (3000, 3000), 100, items).unwrap_err();
        assert!(needed >= 3000 * size_of::<u32>() as u64, "{needed}");
    }
}
