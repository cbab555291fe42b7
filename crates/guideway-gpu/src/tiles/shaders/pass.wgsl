// What threads share that go through lines which are there, and find the tiles of each.

override THREADS: u32;

@group(0) @binding(1) var<storage, read_write> found: Found;
@group(0) @binding(2) var<storage, read> lines: array<u32>;
@group(0) @binding(3) var<storage, read> line_ranks: array<u32>;
@group(0) @binding(4) var<storage, read> styles: array<Style>;

// How far from a line it may touch a tile.
fn reach_of_line(line: u32) -> f32 {
    return radius_of(rank_of(line)) + MARGIN_PX;
}
