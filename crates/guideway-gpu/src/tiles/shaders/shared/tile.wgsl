// Access to one tile: its list of lines, its pixels. Used by all kernels that draw tiles.

// import: shared/frame.wgsl
// import: shared/work_counts.wgsl
// import: shared/capsule.wgsl
// import: shared/line.wgsl
// import: shared/style.wgsl

@group(0) @binding(1) var<storage, read> tile_lists: array<vec2u>;
@group(0) @binding(2) var<storage, read> references: array<u32>;
@group(0) @binding(3) var<storage, read> lines: array<u32>;
@group(0) @binding(4) var<storage, read> line_ranks: array<u32>;
@group(0) @binding(5) var<storage, read> styles: array<Style>;
@group(0) @binding(6) var<storage, read_write> pixels: array<u32>;

override THREADS: u32;
// Lines that a workgroup loads together.
const BATCH_LINES: u32 = 64u;

struct Tile {
    index: u32,
    // Its upper left pixel.
    left: u32,
    top: u32,
}

fn tile_of(index: u32) -> Tile {
    let row = frame.first_row + index / frame.columns;
    let column = frame.first_column + index % frame.columns;
    return Tile(index, column * TILE_PX, row * TILE_PX);
}

// Writes the pixel of a thread if it is inside the picture.
fn write_pixel(tile: Tile, thread: u32, color: u32) {
    let x = tile.left + thread % TILE_PX;
    let y = tile.top + thread / TILE_PX;
    if x < frame.width_px && y < frame.height_px {
        pixels[(y - frame.first_pixel_row) * frame.width_px + x] = color;
        count_writes(1u);
    }
}

// Samples of a row outside the picture: they start as covered, so that nothing waits for them.
fn outside_picture(tile: Tile, row: u32) -> SampleRow {
    var inside = (frame.width_px - tile.left) * SAMPLES_PER_ROW;
    if tile.top + row / SAMPLE_ROWS >= frame.height_px {
        inside = 0u;
    }
    var outside: SampleRow;
    for (var word = 0u; word < ROW_WORDS; word++) {
        outside[word] = bits_between(inside, ROW_WORDS * 32u, word);
    }
    return outside;
}

// Range of the tile's list, cut at the capacity of the lists.
fn tile_list(tile: u32) -> vec2u {
    return min(tile_lists[tile], vec2u(frame.reference_capacity));
}

// Range of the tile's list if `bin_cached` filled it: every tile has `list_capacity` entries.
fn cached_tile_list(tile: u32, counted: u32, reserved: vec2u) -> vec2u {
    if frame.list_capacity == 0u {
        return reserved;
    }
    return vec2u(0u, min(counted, frame.list_capacity)) + tile * frame.list_capacity;
}

// Capsule of the line at a position of the lists.
fn capsule_of_reference(tile: Tile, position: u32) -> Capsule {
    count_reads(1u);
    return capsule_of_line(tile, references[position]);
}

fn capsule_of_line(tile: Tile, line: u32) -> Capsule {
    return capsule_with_radius(tile, line, radius_of(rank_of(line)));
}

// Capsule of a line with the given radius.
fn capsule_with_radius(tile: Tile, line: u32, radius_px: f32) -> Capsule {
    return capsule_of(line_of(words_of_line(line)), corner_of(tile), radius_px);
}

// The upper left corner in pixels.
fn corner_of(tile: Tile) -> vec2f {
    return vec2f(f32(tile.left), f32(tile.top));
}

// Samples of one pixel in a word of a row.
fn pixel_bits(word: u32, pixel: u32) -> u32 {
    return (word >> (pixel * SAMPLES_PER_ROW)) & ((1u << SAMPLES_PER_ROW) - 1u);
}
