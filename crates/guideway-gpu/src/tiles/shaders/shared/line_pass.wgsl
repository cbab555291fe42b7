// Bindings of kernels that go through the lines of a frame and find the tiles of each.

// import: shared/frame.wgsl
// import: shared/counters.wgsl
// import: shared/style.wgsl
// import: shared/line.wgsl
// import: shared/tile_range.wgsl

override THREADS: u32;

@group(0) @binding(1) var<storage, read_write> counters: CounterBuffer;
@group(0) @binding(2) var<storage, read> lines: array<u32>;
@group(0) @binding(3) var<storage, read> line_ranks: array<u32>;
@group(0) @binding(4) var<storage, read> styles: array<Style>;

// Distance from a line up to which its stroke touches tiles.
fn line_reach_px(line: u32) -> f32 {
    return radius_of(rank_of(line)) + ROUNDING_MARGIN_PX;
}
