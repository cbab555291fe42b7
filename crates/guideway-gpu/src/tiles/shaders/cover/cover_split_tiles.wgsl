// Covers the tiles of a scene of one opaque color, some of them by several workgroups.
//
// Bindings: those of `cover_tiles`, and split_lists. First dispatch: one workgroup per list part,
// then one per tile; parts merge their samples in `split_lists`. Second dispatch (RESOLVES): one
// workgroup per split tile writes its pixels.

// import: cover/cover_tile.wgsl
// import: shared/split_lists.wgsl

// True if this dispatch resolves split tiles.
override RESOLVES: bool;

@group(0) @binding(9) var<storage, read_write> split_lists: SplitLists;

// Words of samples per tile.
fn tile_words() -> u32 {
    return TILE_PX * SAMPLE_ROWS * ROW_WORDS;
}

var<workgroup> list_part: ListPart;
var<workgroup> resolved: u32;

fn cover_part(own: Thread, number: u32) {
    if own.number == 0u {
        list_part = ListPart(0u, 0u, 0u, 0u);
        if number < atomicLoad(&counters.totals.split_parts) {
            list_part = split_lists.parts[number];
            split_lists.parts[number] = ListPart(0u, 0u, 0u, 0u);
            count_reads(4u);
            count_writes(4u);
        }
    }
    let part = workgroupUniformLoad(&list_part);
    let list = min(vec2u(part.start, part.end), vec2u(frame.reference_capacity));
    if list.x >= list.y {
        return;
    }
    let tile = tile_of(part.tile);
    clear_samples(tile, own.number);
    workgroupBarrier();
    cover_list(team_of(own), tile, list);
    workgroupBarrier();
    for (var word = own.number; word < tile_words(); word += THREADS) {
        let bits = atomicLoad(&samples[word]);
        if bits != 0u {
            atomicOr(&split_lists.samples[part.slot * tile_words() + word], bits);
            count_atomics(1u);
        }
    }
}

fn resolve_split_tile(own: Thread, slot: u32) {
    if own.number == 0u {
        resolved = 0u;
        if slot < atomicLoad(&counters.totals.split_tiles) {
            resolved = split_lists.tiles[slot];
            split_lists.tiles[slot] = 0u;
            count_reads(1u);
            count_writes(1u);
        }
    }
    let index = workgroupUniformLoad(&resolved);
    if index == 0u {
        return;
    }
    let tile = tile_of(index - 1u);
    clear_samples(tile, own.number);
    workgroupBarrier();
    for (var word = own.number; word < tile_words(); word += THREADS) {
        let merged = atomicExchange(&split_lists.samples[slot * tile_words() + word], 0u);
        atomicStore(&samples[word], merged);
        count_atomics(1u);
    }
    workgroupBarrier();
    resolve_tile(tile, own.number);
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    own: Thread,
) {
    let number = workgroup_index(id, count);
    if RESOLVES {
        if number < MAX_SPLIT_TILES {
            resolve_split_tile(own, number);
        }
    } else if number < MAX_SPLIT_PARTS {
        cover_part(own, number);
    } else if number - MAX_SPLIT_PARTS < frame.columns * frame.rows {
        cover_tile(own, number - MAX_SPLIT_PARTS);
    }
    report_work();
}
