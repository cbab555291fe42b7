// Tracks the open pixels of a tile: pixels with uncovered samples.

// import: shared/frame.wgsl
// import: shared/capsule.wgsl
// import: shared/tile.wgsl

// One word per pixel row, one bit per pixel, from the left.
var<workgroup> open_pixels: array<atomic<u32>, TILE_PX>;

// Opens the pixels inside the picture. Returns their columns and rows.
fn init_open_pixels(tile: Tile, thread: u32) -> vec2u {
    let picture = vec2u(frame.width_px, frame.height_px);
    let size = min(vec2u(TILE_PX), picture - vec2u(tile.left, tile.top));
    if thread < TILE_PX {
        atomicStore(&open_pixels[thread], select(0u, low_bits(size.x), thread < size.y));
    }
    return size;
}

// Pixel rows in which a capsule may reach an open pixel, one bit each.
fn open_pixel_rows(capsule: Capsule) -> u32 {
    let rows = capsule_rows(capsule);
    var shown = 0u;
    for (var row = rows.x / SAMPLE_ROWS; row * SAMPLE_ROWS < rows.y; row++) {
        let top = f32(row * SAMPLE_ROWS) * STEP;
        let bottom = f32((row + 1u) * SAMPLE_ROWS) * STEP;
        let columns = columns_between(capsule, top, bottom);
        if (atomicLoad(&open_pixels[row]) & columns) != 0u {
            shown |= 1u << row;
        }
    }
    return shown;
}

// Pixels of a word whose samples are all set, one bit each.
fn full_pixel_bits(word: u32) -> u32 {
    // The lowest bit of each pixel stands for all of its samples.
    var all = word;
    for (var shift = 1u; shift < SAMPLES_PER_ROW; shift *= 2u) {
        all &= all >> shift;
    }
    if SAMPLES_PER_ROW == 16u {
        return (all & 1u) | ((all >> 15u) & 2u);
    }
    // Packs every fourth bit.
    all &= 0x11111111u;
    all = (all | (all >> 3u)) & 0x03030303u;
    all = (all | (all >> 6u)) & 0x000f000fu;
    return (all | (all >> 12u)) & 0xffu;
}
