// A workgroup covers one tile, or a part of the list of one that is shared; once all have, it shows one of those.

// Whether it shows them.
override SHOWS: bool;

@group(0) @binding(9) var<storage, read_write> shares: Shares;

// Words of the samples of a tile.
fn tile_words() -> u32 {
    return TILE_PX * SAMPLE_ROWS * WORDS;
}

var<workgroup> part: Part;
var<workgroup> shown: u32;

fn cover_part(own: Thread, number: u32) {
    if own.number == 0u {
        part = Part(0u, 0u, 0u, 0u);
        if number < atomicLoad(&found.counters.parts) {
            part = shares.parts[number];
            shares.parts[number] = Part(0u, 0u, 0u, 0u);
            reads(4u);
            writes(4u);
        }
    }
    let it = workgroupUniformLoad(&part);
    let list = min(vec2u(it.start, it.end), vec2u(frame.reference_room));
    if list.x >= list.y {
        return;
    }
    let tile = tile_of(it.tile);
    clear(tile, own.number);
    workgroupBarrier();
    cover_list(team_of(own), tile, list);
    workgroupBarrier();
    for (var word = own.number; word < tile_words(); word += THREADS) {
        let bits = atomicLoad(&samples[word]);
        if bits != 0u {
            atomicOr(&shares.samples[it.place * tile_words() + word], bits);
            atomics(1u);
        }
    }
}

fn show_shared(own: Thread, place: u32) {
    if own.number == 0u {
        shown = 0u;
        if place < atomicLoad(&found.counters.shared_tiles) {
            shown = shares.tiles[place];
            shares.tiles[place] = 0u;
            reads(1u);
            writes(1u);
        }
    }
    let index = workgroupUniformLoad(&shown);
    if index == 0u {
        return;
    }
    let tile = tile_of(index - 1u);
    clear(tile, own.number);
    workgroupBarrier();
    for (var word = own.number; word < tile_words(); word += THREADS) {
        atomicStore(&samples[word], atomicExchange(&shares.samples[place * tile_words() + word], 0u));
        atomics(1u);
    }
    workgroupBarrier();
    show(tile, own.number);
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    own: Thread,
) {
    let number = workgroup_index(id, count);
    if SHOWS {
        if number < SHARED_TILES {
            show_shared(own, number);
        }
    } else if number < SHARED_PARTS {
        cover_part(own, number);
    } else if number - SHARED_PARTS < frame.columns * frame.rows {
        cover_tile(own, number - SHARED_PARTS);
    }
    report_work();
}
