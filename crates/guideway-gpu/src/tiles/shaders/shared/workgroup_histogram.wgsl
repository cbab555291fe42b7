// Hashed histogram of tiles in workgroup memory: neighboring lines touch the same tiles, so that
// one atomic addition in storage serves many lines. The importing shader declares
// `override THREADS: u32`.

// A slot serves all tiles whose row and column are equal modulo HISTOGRAM_SIDE.
const HISTOGRAM_SIDE: u32 = 16u;
const HISTOGRAM_SLOTS: u32 = HISTOGRAM_SIDE * HISTOGRAM_SIDE;
const NO_TILE: u32 = 0xffffffffu;

var<workgroup> histogram_tiles: array<atomic<u32>, HISTOGRAM_SLOTS>;
var<workgroup> histogram_counts: array<atomic<u32>, HISTOGRAM_SLOTS>;

fn clear_histogram(thread: u32) {
    for (var slot = thread; slot < HISTOGRAM_SLOTS; slot += THREADS) {
        atomicStore(&histogram_tiles[slot], NO_TILE);
        atomicStore(&histogram_counts[slot], 0u);
    }
}

// Returns the slot of a tile, or NO_TILE if another tile holds it.
fn histogram_slot(row: u32, column: u32, tile: u32) -> u32 {
    let slot = (row % HISTOGRAM_SIDE) * HISTOGRAM_SIDE + column % HISTOGRAM_SIDE;
    var there = atomicLoad(&histogram_tiles[slot]);
    if there == NO_TILE {
        let taken = atomicCompareExchangeWeak(&histogram_tiles[slot], NO_TILE, tile);
        there = select(taken.old_value, tile, taken.exchanged);
    }
    return select(NO_TILE, slot, there == tile);
}
