// Which pixels of a tile are open: have samples to cover yet.

// Those of each row of pixels, a bit each, from the left.
var<workgroup> open: array<atomic<u32>, TILE_PX>;

// Opens the pixels that are part of the picture: so many columns and rows.
fn open_all(tile: Tile, thread: u32) -> vec2u {
    let size = min(vec2u(TILE_PX), vec2u(frame.width_px, frame.height_px) - vec2u(tile.left, tile.top));
    if thread < TILE_PX {
        atomicStore(&open[thread], select(0u, low_bits(size.x), thread < size.y));
    }
    return size;
}

// The rows of pixels in which a line may reach into an open one, a bit each: by its part that is within reach of the row.
fn rows_shown(capsule: Capsule) -> u32 {
    let rows = rows_touched(capsule);
    let height = f32(SAMPLE_ROWS);
    let reach = capsule.radius + SLACK;
    var shown = 0u;
    for (var row = rows.x / SAMPLE_ROWS; row * SAMPLE_ROWS < rows.y; row++) {
        let top = f32(row) * height;
        let near = vec2f(top - reach, top + height + reach) - capsule.upper.y;
        let x = capsule.upper.x + capsule.along.x * clamp(near * capsule.per_row, vec2f(0.0), vec2f(1.0));
        let low = clamp((min(x.x, x.y) - reach) / height, 0.0, f32(TILE_PX));
        let high = clamp((max(x.x, x.y) + reach) / height + 1.0, 0.0, f32(TILE_PX));
        if (atomicLoad(&open[row]) & low_bits(u32(high)) & ~low_bits(u32(low))) != 0u {
            shown |= 1u << row;
        }
    }
    return shown;
}

// The pixels of a word all of whose bits are set, a bit each.
fn full_pixels(word: u32) -> u32 {
    // The lowest bit of each stands for all.
    var all = word;
    for (var shift = 1u; shift < SAMPLES_A_ROW; shift *= 2u) {
        all &= all >> shift;
    }
    if SAMPLES_A_ROW == 16u {
        return (all & 1u) | ((all >> 15u) & 2u);
    }
    // Brings every fourth bit together.
    all &= 0x11111111u;
    all = (all | (all >> 3u)) & 0x03030303u;
    all = (all | (all >> 6u)) & 0x000f000fu;
    return (all | (all >> 12u)) & 0xffu;
}
