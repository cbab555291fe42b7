// Covers one tile of a scene of one opaque color: lines need no order.

// import: shared/blend.wgsl
// import: shared/counters.wgsl
// import: cover/distribute_rows.wgsl

@group(0) @binding(7) var<storage, read_write> tile_counts: array<u32>;
@group(0) @binding(8) var<storage, read_write> counters: CounterBuffer;

// The tile's count and the range of its list, read by thread 0.
var<workgroup> tile_header: vec3u;

// Resolves samples to pixels, and flags the tile if all of its pixels are full.
fn resolve_tile(tile: Tile, thread: u32) {
    close_full_pixels(thread, THREADS);
    for (var pixel = thread; pixel < TILE_PX * TILE_PX; pixel += THREADS) {
        let steps = covered_samples(pixel) * (PIXEL_STEPS / (SAMPLE_ROWS * SAMPLES_PER_ROW));
        write_pixel(tile, pixel, over_background(opaque_channels(frame.color) * steps));
    }
    workgroupBarrier();
    if thread == 0u && atomicLoad(&open_pixel_count) == 0u {
        tile_counts[tile.index] |= FULL;
        atomicAdd(&counters.totals.full_tiles, 1u);
        count_atomics(1u);
    }
}

fn cover_tile(own: Thread, index: u32) {
    let thread = own.number;
    let tile = tile_of(index);
    if thread == 0u {
        tile_header = vec3u(tile_counts[index], tile_list(index));
        count_reads(3u);
    }
    // Overlaps with the loads above.
    clear_samples(tile, thread);
    let header = workgroupUniformLoad(&tile_header);
    // Occlusion pass 1 has written its pixels.
    if (header.x & FULL) != 0u {
        return;
    }
    let list = cached_tile_list(index, header.x, header.yz);
    if list.x >= list.y {
        for (var pixel = thread; pixel < TILE_PX * TILE_PX; pixel += THREADS) {
            write_pixel(tile, pixel, frame.background);
        }
        return;
    }
    cover_list(team_of(own), tile, list);
    workgroupBarrier();
    resolve_tile(tile, thread);
}
