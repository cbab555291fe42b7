//! What lies on each tile.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use rayon::prelude::*;

use super::crossings::{Crossing, Crossings, Drawn};
use super::sight::Sight;

/// Portions that what is listed is cut into: enough that threads share them evenly, and not too many, for each tile asks
/// all of them.
const PORTIONS_A_THREAD: usize = 4;
const MOST_PORTIONS: usize = 32;
/// Of so little one thread makes a portion sooner than two.
const LEAST_OF_A_PORTION: usize = 512;

/// What may leave a mark on each tile.
pub(super) struct Bins {
    /// Keys of clusters.
    clusters: Lists<u32>,
    /// Lines of those that are wide.
    crossings: Lists<Crossing>,
    pub(super) found: Crossings,
}

/// A list for each tile, in portions, each of which one thread makes.
#[derive(Default)]
struct Lists<T> {
    portions: Vec<Portion<T>>,
}

#[derive(Default)]
struct Portion<T> {
    /// Where the list of each tile ends. At first where it begins, and before that, one tile later, how long it is.
    ends: Vec<u32>,
    items: Vec<T>,
}

impl Bins {
    pub(super) fn new() -> Self {
        Self {
            clusters: Lists::default(),
            crossings: Lists::default(),
            found: Crossings::new(),
        }
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> u64 {
        self.clusters.bytes() + self.crossings.bytes() + self.found.bytes()
    }

    /// Lists what lies on each tile that is drawn, unless that takes more than so many bytes; then says how
    /// many.
    pub(super) fn fill(&mut self, drawn: Drawn<'_>, limit_bytes: u64) -> Result<(), u64> {
        let a_crossing = size_of::<(u32, Crossing)>() + size_of::<Crossing>();
        // They save time where there is room for them.
        let most_crossings = limit_bytes as usize / 2 / a_crossing;
        self.found.find(drawn, most_crossings);
        let found_bytes = self.found.bytes();
        let limit_bytes = limit_bytes.saturating_sub(found_bytes);
        let tiles = drawn.grid.len();
        let found = self.found.lists();
        let size = (found.len(), found.iter().map(Vec::len).sum());
        self.crossings
            .fill(tiles, size, limit_bytes, |lists| {
                let crossings = found[lists].iter().flatten();
                crossings.map(|&(tile, crossing)| (tile as usize, crossing))
            })
            .map_err(|bytes| bytes + found_bytes)?;

        let crossings_bytes = self.crossings.bytes();
        let limit_bytes = limit_bytes.saturating_sub(crossings_bytes);
        let sights = drawn.sights;
        let size = (sights.chunks(), sights.len());
        self.clusters
            .fill(tiles, size, limit_bytes, |chunks| {
                let others = self.found.others(sights, chunks);
                others
                    .flat_map(|(key, sight)| drawn_tiles(sight, drawn).map(move |tile| (tile, key)))
            })
            .map_err(|bytes| bytes + found_bytes + crossings_bytes)
    }

    /// The clusters of a tile, by ascending number.
    pub(super) fn clusters(&self, tile: usize) -> impl Iterator<Item = u32> {
        self.clusters.of(tile).flatten().copied()
    }

    /// The lines of wide clusters on a tile, by ascending number of these. All of a cluster are in one piece.
    pub(super) fn crossings(&self, tile: usize) -> impl Iterator<Item = &[Crossing]> {
        self.crossings.of(tile)
    }
}

impl<T: Copy + Default + Send> Lists<T> {
    /// Lists what `found` gives, with its tile, for a range of so many steps through so many things, unless that takes more
    /// than so many bytes; then says how many.
    fn fill<I: Iterator<Item = (usize, T)>>(
        &mut self,
        tiles: usize,
        (steps, things): (usize, usize),
        limit_bytes: u64,
        found: impl Fn(Range<usize>) -> I + Sync,
    ) -> Result<(), u64> {
        let most_portions = (PORTIONS_A_THREAD * rayon::current_num_threads()).min(MOST_PORTIONS);
        let portions = (things / LEAST_OF_A_PORTION).clamp(1, most_portions);
        self.portions.resize_with(portions, Portion::default);
        let (total_bytes, all_fit) = (AtomicU64::new(0), AtomicBool::new(true));
        let numbered = self.portions.par_iter_mut().enumerate().with_max_len(1);
        numbered.for_each(|(i, portion)| {
            let range = steps * i / portions..steps * (i + 1) / portions;
            let items = portion.count(tiles, found(range.clone()));
            let bytes = (items * size_of::<T>() + tiles * size_of::<u32>()) as u64;
            let before = total_bytes.fetch_add(bytes, Ordering::Relaxed);
            if before + bytes <= limit_bytes && u32::try_from(items).is_ok() {
                portion.place(items, found(range));
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

    /// What was listed for a tile, in one piece for each portion.
    fn of(&self, tile: usize) -> impl Iterator<Item = &[T]> {
        let portions = self.portions.iter();
        portions.map(move |portion| portion.of(tile))
    }

    fn bytes(&self) -> u64 {
        self.portions.iter().map(Portion::bytes).sum()
    }
}

impl<T: Copy + Default> Portion<T> {
    /// Counts what lies on each tile; says how much it is.
    fn count(&mut self, tiles: usize, found: impl Iterator<Item = (usize, T)>) -> usize {
        self.ends.clear();
        self.ends.resize(tiles + 1, 0);
        found.for_each(|(tile, _)| self.ends[tile + 1] += 1);
        self.ends.iter().map(|&len| len as usize).sum()
    }

    /// Places what was counted, 2^32 at most.
    fn place(&mut self, items: usize, found: impl Iterator<Item = (usize, T)>) {
        let mut next = 0;
        for end in &mut self.ends {
            next += *end;
            *end = next;
        }
        if self.items.capacity() < items {
            self.items = Vec::with_capacity(items);
        }
        self.items.clear();
        self.items.resize(items, T::default());
        found.for_each(|(tile, item)| {
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

/// The tiles of the grid that are drawn and that a cluster may leave a mark on.
#[inline(always)]
fn drawn_tiles<'a>(sight: &Sight, drawn: Drawn<'a>) -> impl Iterator<Item = usize> + 'a {
    let Drawn { grid, parts, .. } = drawn;
    let (rows, columns) = (sight.rows(), sight.columns());
    let rows = rows.start.max(grid.rows.start)..rows.end.min(grid.rows.end);
    rows.flat_map(move |row| {
        let columns = columns.clone();
        let drawn = columns.filter(move |&column| !parts.at(column, row).is_empty());
        drawn.map(move |column| grid.tile(column, row))
    })
}
