// One thread a tile: shares out a list that is long among several workgroups, as far as there is room for that.

override THREADS: u32;
// As many lists as long as the longest that one workgroup covers have all references of a frame together: so many workgroups
// keep a device busy. It is held between two lengths.
override ENOUGH_LISTS: u32;
override LEAST_ALONE: u32;
override MOST_ALONE: u32;

@group(0) @binding(1) var<storage, read_write> lists: array<vec2u>;
@group(0) @binding(2) var<storage, read_write> found: Found;
@group(0) @binding(3) var<storage, read_write> shares: Shares;

// Shares out a list, in equal parts of so many lines at most. Returns whether there is room for all of them.
fn share(tile: u32, list: vec2u, most: u32) -> bool {
    let lines = list.y - list.x;
    let parts = (lines + most - 1u) / most;
    let place = atomicAdd(&found.counters.shared_tiles, 1u);
    let first = atomicAdd(&found.counters.parts, parts);
    atomics(2u);
    if place >= SHARED_TILES || first >= SHARED_PARTS || parts > SHARED_PARTS - first {
        return false;
    }
    shares.tiles[place] = tile + 1u;
    let length = (lines + parts - 1u) / parts;
    for (var i = 0u; i < parts; i++) {
        let start = min(list.x + i * length, list.y);
        shares.parts[first + i] = Part(tile, place, start, min(start + length, list.y));
    }
    writes(1u + 4u * parts);
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
    let list = lists[tile];
    reads(2u);
    let all = atomicLoad(&found.counters.references);
    let most = clamp(all / ENOUGH_LISTS, LEAST_ALONE, MOST_ALONE);
    var longest = list.y - list.x;
    if longest > most && share(tile, list, most) {
        longest = most;
        // It has none of its own.
        lists[tile].y = list.x;
        writes(1u);
    }
    atomicMax(&found.counters.longest_alone, longest);
    atomics(1u);
    report_work();
}
