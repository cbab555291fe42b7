// Sorts a batch by falling draw rank: counts the ranks per bucket, then ranks each line within its
// bucket. Equal ranks keep their order.

// import: composite/rank_buckets.wgsl

// Sorts a batch with ranks in [x, y], read from `batch` or from the references.
fn sort_batch(thread: u32, start: u32, count: u32, ranks: vec2u, from_batch: bool) {
    let shift = shift_of(ranks.x, ranks.y);
    var lines: array<u32, LINES_PER_THREAD>;
    var own: array<u32, LINES_PER_THREAD>;
    var positions: array<u32, LINES_PER_THREAD>;
    clear_buckets(thread);
    for (var i = 0u; i < LINES_PER_THREAD; i++) {
        let at = i * THREADS + thread;
        if at < count {
            if from_batch {
                lines[i] = batch[at];
            } else {
                lines[i] = references[start + at];
            }
            count_reads(2u);
            own[i] = line_ranks[lines[i]];
            positions[i] = atomicAdd(&scratch[(ranks.y - own[i]) >> shift], 1u);
        }
    }
    add_buckets(thread);
    for (var i = 0u; i < LINES_PER_THREAD; i++) {
        if i * THREADS + thread < count {
            positions[i] += start_of((ranks.y - own[i]) >> shift);
            batch[positions[i]] = own[i];
        }
    }
    workgroupBarrier();
    for (var i = 0u; i < LINES_PER_THREAD; i++) {
        if i * THREADS + thread < count {
            // Position: behind all higher ranks of the bucket, and equal ranks that came before.
            let bucket = (ranks.y - own[i]) >> shift;
            let first = start_of(bucket);
            let end = atomicLoad(&scratch[bucket]);
            var position = first;
            for (var other = first; other < end; other++) {
                let rank = batch[other];
                let is_before = rank > own[i] || (rank == own[i] && other < positions[i]);
                position += select(0u, 1u, is_before);
                loops++;
            }
            positions[i] = position;
        }
    }
    workgroupBarrier();
    for (var i = 0u; i < LINES_PER_THREAD; i++) {
        if i * THREADS + thread < count {
            batch[positions[i]] = lines[i];
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
