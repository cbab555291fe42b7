// How often a workgroup means a tile: neighbors mean the same few, and one addition for all of them is enough.

// Places, each for the tiles that are a multiple of so many columns and rows apart.
const TALLY_SIDE: u32 = 16u;
const TALLY_PLACES: u32 = TALLY_SIDE * TALLY_SIDE;
const NO_TILE: u32 = 0xffffffffu;

var<workgroup> tally_tiles: array<atomic<u32>, TALLY_PLACES>;
var<workgroup> tallies: array<atomic<u32>, TALLY_PLACES>;

fn clear_tallies(thread: u32) {
    for (var place = thread; place < TALLY_PLACES; place += THREADS) {
        atomicStore(&tally_tiles[place], NO_TILE);
        atomicStore(&tallies[place], 0u);
    }
}

// Where a tile is tallied; none where another one is.
fn tally_place(row: u32, column: u32, tile: u32) -> u32 {
    let place = (row % TALLY_SIDE) * TALLY_SIDE + column % TALLY_SIDE;
    var there = atomicLoad(&tally_tiles[place]);
    if there == NO_TILE {
        let taken = atomicCompareExchangeWeak(&tally_tiles[place], NO_TILE, tile);
        there = select(taken.old_value, tile, taken.exchanged);
    }
    return select(NO_TILE, place, there == tile);
}
