// Brings a portion into order, whose ranks are between two, from the front of it or from the list.
fn order(thread: u32, start: u32, count: u32, ranks: vec2u, is_gathered: bool) {
    let shift = shift_of(ranks.x, ranks.y);
    var lines: array<u32, PLACES>;
    var own: array<u32, PLACES>;
    var places: array<u32, PLACES>;
    clear_buckets(thread);
    for (var i = 0u; i < PLACES; i++) {
        let at = i * THREADS + thread;
        if at < count {
            if is_gathered {
                lines[i] = portion[at];
            } else {
                lines[i] = references[start + at];
            }
            reads(2u);
            own[i] = line_ranks[lines[i]];
            places[i] = atomicAdd(&scratch[(ranks.y - own[i]) >> shift], 1u);
        }
    }
    add_buckets(thread);
    for (var i = 0u; i < PLACES; i++) {
        if i * THREADS + thread < count {
            places[i] += start_of((ranks.y - own[i]) >> shift);
            portion[places[i]] = own[i];
        }
    }
    workgroupBarrier();
    for (var i = 0u; i < PLACES; i++) {
        if i * THREADS + thread < count {
            // Behind all of the bucket that are higher, and those as high that came before.
            let bucket = (ranks.y - own[i]) >> shift;
            let first = start_of(bucket);
            let end = atomicLoad(&scratch[bucket]);
            var place = first;
            for (var other = first; other < end; other++) {
                let rank = portion[other];
                place += select(0u, 1u, rank > own[i] || (rank == own[i] && other < places[i]));
                rounds++;
            }
            places[i] = place;
        }
    }
    workgroupBarrier();
    for (var i = 0u; i < PLACES; i++) {
        if i * THREADS + thread < count {
            portion[places[i]] = lines[i];
        }
    }
    workgroupBarrier();
}

fn start_of(bucket: u32) -> u32 {
    if bucket == 0u {
        return 0u;
    }
    return atomicLoad(&scratch[bucket - 1u]);
}
