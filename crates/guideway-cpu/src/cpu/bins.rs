//! What lies on each tile.

use super::crossings::{Crossing, Crossings, Drawn};
use super::sight::Sight;

/// What may leave a mark on each tile.
pub(super) struct Bins {
    /// Keys of clusters.
    clusters: Lists<u32>,
    /// Lines of those that are wide.
    crossings: Lists<Crossing>,
    pub(super) found: Crossings,
}

/// A list for each tile.
#[derive(Default)]
struct Lists<T> {
    /// Where they end. At first where they begin, and before that, one tile later, how long they are.
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
        self.crossings.begin(tiles);
        let crossings = || self.found.iter();
        crossings().for_each(|&(tile, _)| self.crossings.count(tile as usize));
        let with_found = |bytes| bytes + found_bytes;
        self.crossings.make_room(limit_bytes).map_err(with_found)?;
        crossings().for_each(|&(tile, crossing)| self.crossings.place(tile as usize, crossing));

        let limit_bytes = limit_bytes.saturating_sub(self.crossings.bytes());
        let others = || self.found.others(drawn.sights);
        self.clusters.begin(tiles);
        for (_, sight) in others() {
            for_each_tile(sight, drawn, |tile| self.clusters.count(tile));
        }
        let with_crossings = |bytes| with_found(bytes) + self.crossings.bytes();
        self.clusters
            .make_room(limit_bytes)
            .map_err(with_crossings)?;
        for (key, sight) in others() {
            for_each_tile(sight, drawn, |tile| self.clusters.place(tile, key));
        }
        Ok(())
    }

    /// Whether nothing lies on a tile.
    pub(super) fn is_empty(&self, tile: usize) -> bool {
        self.clusters(tile).is_empty() && self.crossings(tile).is_empty()
    }

    /// The clusters of a tile, by ascending number.
    pub(super) fn clusters(&self, tile: usize) -> &[u32] {
        self.clusters.of(tile)
    }

    /// The lines of wide clusters on a tile, by ascending number of these.
    pub(super) fn crossings(&self, tile: usize) -> &[Crossing] {
        self.crossings.of(tile)
    }
}

impl<T: Copy + Default> Lists<T> {
    fn begin(&mut self, tiles: usize) {
        self.ends.clear();
        self.ends.resize(tiles + 1, 0);
    }

    #[inline(always)]
    fn count(&mut self, tile: usize) {
        self.ends[tile + 1] += 1;
    }

    /// After all were counted.
    fn make_room(&mut self, limit_bytes: u64) -> Result<(), u64> {
        let total: u64 = self.ends.iter().map(|&n| u64::from(n)).sum();
        let ends_bytes = size_of_val(&self.ends[..]) as u64;
        let needed = total * size_of::<T>() as u64 + ends_bytes;
        if needed > limit_bytes || total > u64::from(u32::MAX) {
            return Err(needed);
        }
        let mut next = 0;
        for end in &mut self.ends {
            next += *end;
            *end = next;
        }
        if self.items.capacity() < total as usize {
            self.items = Vec::with_capacity(total as usize);
        }
        self.items.clear();
        self.items.resize(total as usize, T::default());
        Ok(())
    }

    #[inline(always)]
    fn place(&mut self, tile: usize, item: T) {
        let place = &mut self.ends[tile];
        self.items[*place as usize] = item;
        *place += 1;
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

/// Calls `found` with each tile of the grid that is drawn and that a cluster may leave a mark on.
#[inline(always)]
fn for_each_tile(sight: &Sight, drawn: Drawn<'_>, mut found: impl FnMut(usize)) {
    let Drawn { grid, parts, .. } = drawn;
    let rows = sight.rows();
    for row in rows.start.max(grid.rows.start)..rows.end.min(grid.rows.end) {
        for column in sight.columns() {
            if !parts.at(column, row).is_empty() {
                found(grid.tile(column, row));
            }
        }
    }
}
