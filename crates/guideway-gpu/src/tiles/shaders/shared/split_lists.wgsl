// Tile lists that are split among workgroups, each covering one part. Rust: `MAX_SPLIT_TILES`.

// Capacities.
const MAX_SPLIT_TILES: u32 = 256u;
const MAX_SPLIT_PARTS: u32 = 1024u;

struct ListPart {
    tile: u32,
    // Index among the split tiles.
    slot: u32,
    // Range of the tile's list.
    start: u32,
    end: u32,
}

// Consumers set what they have read back to zero.
struct SplitLists {
    // Tile index plus one.
    tiles: array<u32, MAX_SPLIT_TILES>,
    parts: array<ListPart, MAX_SPLIT_PARTS>,
    // Covered samples of each split tile.
    samples: array<atomic<u32>>,
}
