// Tiles that several workgroups cover: each goes through a part of the list.

// Most tiles, and parts of lists.
const SHARED_TILES: u32 = 256u;
const SHARED_PARTS: u32 = 1024u;

struct Part {
    tile: u32,
    // Its place among shared tiles.
    place: u32,
    // Of its list.
    start: u32,
    end: u32,
}

// What is done with is set to zero again.
struct Shares {
    // One more than the index of each tile.
    tiles: array<u32, SHARED_TILES>,
    parts: array<Part, SHARED_PARTS>,
    // What is covered of each tile.
    samples: array<atomic<u32>>,
}
