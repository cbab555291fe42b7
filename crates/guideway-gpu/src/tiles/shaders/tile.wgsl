// A workgroup draws one tile from its list of lines.

@group(0) @binding(1) var<storage, read> lists: array<vec2u>;
@group(0) @binding(2) var<storage, read> references: array<u32>;
@group(0) @binding(3) var<storage, read> lines: array<u32>;
@group(0) @binding(4) var<storage, read> line_ranks: array<u32>;
@group(0) @binding(5) var<storage, read> styles: array<Style>;
@group(0) @binding(6) var<storage, read_write> pixels: array<u32>;

override THREADS: u32;
// Lines that are looked at together.
const TURN: u32 = 64u;

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

// Writes the pixel of a thread, if it is part of the picture.
fn write(tile: Tile, thread: u32, color: u32) {
    let x = tile.left + thread % TILE_PX;
    let y = tile.top + thread / TILE_PX;
    if x < frame.width_px && y < frame.height_px {
        pixels[(y - frame.pixels_row) * frame.width_px + x] = color;
        writes(1u);
    }
}

// Samples of a row of the tile that lie beyond the picture's right border count as covered from the first,
// as do rows below it: nothing waits for them.
fn beyond(tile: Tile, row: u32) -> Row {
    var inside = (frame.width_px - tile.left) * SAMPLES_A_ROW;
    if tile.top + row / SAMPLE_ROWS >= frame.height_px {
        inside = 0u;
    }
    var outside: Row;
    for (var word = 0u; word < WORDS; word++) {
        outside[word] = bits_between(inside, WORDS * 32u, word);
    }
    return outside;
}

// Where the list of a tile begins, and where it ends as far as there is room for it.
fn list_of(tile: u32) -> vec2u {
    return min(lists[tile], vec2u(frame.reference_room));
}

// The same of a tile for which so many lines were counted, or its places, where each tile has as many.
fn list_of_counted(tile: u32, counted: u32, reserved: vec2u) -> vec2u {
    if frame.list_room == 0u {
        return reserved;
    }
    return vec2u(0u, min(counted, frame.list_room)) + tile * frame.list_room;
}

// The line at a place of the lists.
fn capsule_at(tile: Tile, place: u32) -> Capsule {
    reads(1u);
    return capsule_of_line(tile, references[place]);
}

fn capsule_of_line(tile: Tile, line: u32) -> Capsule {
    return capsule_as_wide(tile, line, radius_of(rank_of(line)));
}

// The line with half of such a width.
fn capsule_as_wide(tile: Tile, line: u32, radius_px: f32) -> Capsule {
    let corner = vec2f(f32(tile.left), f32(tile.top));
    return capsule_of(line_of(words_of_line(line)), corner, radius_px);
}

// The samples of one pixel in a word of a row.
fn bits_of_pixel(word: u32, pixel: u32) -> u32 {
    return (word >> (pixel * SAMPLES_A_ROW)) & ((1u << SAMPLES_A_ROW) - 1u);
}
