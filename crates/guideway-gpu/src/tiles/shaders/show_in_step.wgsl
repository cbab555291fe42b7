// How many samples of the pixels of a word are covered, those of two rows of this lane: eight bits each of even pixels and of odd
// ones, or sixteen.
fn counts_of(block: u32, word: u32) -> vec2u {
    var sum = vec2u(0u);
    for (var k = 0u; k < BLOCKS_A_PIXEL; k++) {
        let bits = samples[(block + k) * WORDS + word];
        if IS_FINE {
            sum.x += countOneBits(bits & 0xffffu) | (countOneBits(bits >> 16u) << 16u);
        } else {
            let pairs = bits - ((bits >> 1u) & 0x55555555u);
            let fours = (pairs & 0x33333333u) + ((pairs >> 2u) & 0x33333333u);
            sum += vec2u(fours, fours >> 4u) & vec2u(0x0f0f0f0fu);
        }
    }
    return sum;
}

// Shows what is covered of a tile, a row of pixels after the other.
fn show(tile: Tile, lane: u32) {
    let all = SAMPLE_ROWS * SAMPLES_A_ROW;
    var is_full = true;
    for (var y = 0u; y < TILE_PX; y++) {
        rounds++;
        var own = vec2u(0u);
        for (var word = 0u; word < WORDS; word++) {
            let sum = counts_of(BLOCKS_A_PIXEL * y, word);
            let even = subgroupAdd(sum.x);
            if IS_FINE {
                // Of two pixels.
                let count = (even >> (16u * (lane & 1u))) & 0xffffu;
                own.x = select(own.x, count, word == lane / 2u);
                own.y = select(own.y, count, word == lane / 2u + LANES / 2u);
            } else {
                let odd = subgroupAdd(sum.y);
                own[word] = (select(even, odd, (lane & 1u) != 0u) >> (8u * (lane / 2u))) & 0xffu;
            }
        }
        for (var half = 0u; half < 2u; half++) {
            let share = f32(own[half]) / f32(all);
            is_full = is_full && own[half] == all;
            let pixel = y * TILE_PX + half * LANES + lane;
            write(tile, pixel, over_background(channels(frame.color).rgb * share, share));
        }
    }
    if subgroupAll(is_full) && lane == 0u {
        counts[tile.index] |= FULL;
        atomicAdd(&found.counters.full_tiles, 1u);
        atomics(1u);
    }
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    own: Thread,
) {
    let lane = own.lane;
    let index = workgroup_index(id, count);
    if index >= frame.columns * frame.rows || (counts[index] & FULL) != 0u {
        return;
    }
    let tile = tile_of(index);
    let list = list_of_counted(index, counts[index], list_of(index));
    if lane == 0u {
        reads(3u);
    }
    clear(tile, lane);
    if list.x < list.y {
        cover_list(lane, tile, list);
    }
    show(tile, lane);
    if lane == 0u {
        atomicMax(&found.counters.rounds, rounds);
    }
    report_work();
}
