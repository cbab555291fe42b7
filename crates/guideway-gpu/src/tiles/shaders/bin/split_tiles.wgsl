// Splits long tile lists into parts that several workgroups cover, as far as capacities allow.
//
// Bindings: frame -> tile_lists, counters, split_lists. One thread per tile.

// import: shared/frame.wgsl
// import: shared/counters.wgsl
// import: shared/split_lists.wgsl

override THREADS: u32;
// The longest unsplit list: all references of a frame, divided by the number of lists that keep a
// device busy, within limits.
override TARGET_LISTS: u32;
override MIN_UNSPLIT: u32;
override MAX_UNSPLIT: u32;

@group(0) @binding(1) var<storage, read_write> tile_lists: array<vec2u>;
@group(0) @binding(2) var<storage, read_write> counters: CounterBuffer;
@group(0) @binding(3) var<storage, read_write> split_lists: SplitLists;

// Splits a list into equal parts of at most `most` lines. Returns whether capacity sufficed.
fn split_list(tile: u32, list: vec2u, most: u32) -> bool {
    let lines = list.y - list.x;
    let parts = (lines + most - 1u) / most;
    let slot = atomicAdd(&counters.totals.split_tiles, 1u);
    let first = atomicAdd(&counters.totals.split_parts, parts);
    count_atomics(2u);
    if slot >= MAX_SPLIT_TILES || first >= MAX_SPLIT_PARTS || parts > MAX_SPLIT_PARTS - first {
        return false;
    }
    split_lists.tiles[slot] = tile + 1u;
    let length = (lines + parts - 1u) / parts;
    for (var i = 0u; i < parts; i++) {
        let start = min(list.x + i * length, list.y);
        split_lists.parts[first + i] = ListPart(tile, slot, start, min(start + length, list.y));
    }
    count_writes(1u + 4u * parts);
    return true;
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) group_count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let tile = workgroup_index(id, group_count) * THREADS + thread;
    if tile >= frame.columns * frame.rows {
        return;
    }
    let list = tile_lists[tile];
    count_reads(2u);
    let all = atomicLoad(&counters.totals.references);
    let most = clamp(all / TARGET_LISTS, MIN_UNSPLIT, MAX_UNSPLIT);
    var longest = list.y - list.x;
    if longest > most && split_list(tile, list, most) {
        longest = most;
        // The tile itself keeps an empty list.
        tile_lists[tile].y = list.x;
        count_writes(1u);
    }
    atomicMax(&counters.totals.longest_unsplit, longest);
    count_atomics(1u);
    report_work();
}
