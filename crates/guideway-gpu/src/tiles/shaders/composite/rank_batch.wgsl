// Takes the lines of a list in batches of falling draw rank (a top-k select): lines of tiles that
// fill early are never sorted.
//
//     list     7 2 9 4 9 1 7 ...      histogram of ranks in 512 buckets, highest first
//     batch 1  9 9 7 7 | stop at BATCH_CAPACITY lines; repeat with the ranks below
//
// Cost: one pass over the list per batch, more if many lines share few buckets.

// import: composite/sort_batch.wgsl

// The rest of a list: lines with ranks in [low, high]. `position` is where to continue if the
// highest rank alone has more lines than a batch.
struct Remaining {
    low: u32,
    high: u32,
    position: u32,
    is_any: bool,
}

// The ranks of a batch. `are_one`: a single rank with more lines than fit, taken in pieces.
struct RankRange {
    low: u32,
    high: u32,
    are_one: bool,
}

fn rank_at(position: u32) -> u32 {
    count_reads(2u);
    return line_ranks[references[position]];
}

// Returns the lowest and the highest rank of a list.
fn list_remaining(thread: u32, list: vec2u) -> Remaining {
    if thread == 0u {
        atomicStore(&lowest, 0xffffffffu);
        atomicStore(&highest, 0u);
    }
    workgroupBarrier();
    var low = 0xffffffffu;
    var high = 0u;
    for (var position = list.x + thread; position < list.y; position += THREADS) {
        let rank = rank_at(position);
        low = min(low, rank);
        high = max(high, rank);
        loops++;
    }
    atomicMin(&lowest, low);
    atomicMax(&highest, high);
    workgroupBarrier();
    let ranks = broadcast(thread, vec2u(atomicLoad(&lowest), atomicLoad(&highest)));
    return Remaining(ranks.x, ranks.y, list.x, true);
}

// Selects the ranks of the next batch: as many as fit, or one rank that alone exceeds a batch.
fn select_ranks(thread: u32, list: vec2u, remaining: Remaining) -> RankRange {
    var low = remaining.low;
    var high = remaining.high;
    var are_one = false;
    for (var is_found = false; !is_found;) {
        let shift = shift_of(low, high);
        clear_buckets(thread);
        for (var position = list.x + thread; position < list.y; position += THREADS) {
            let rank = rank_at(position);
            if rank >= low && rank <= high {
                atomicAdd(&scratch[(high - rank) >> shift], 1u);
            }
            loops++;
        }
        add_buckets(thread);
        // Number of leading buckets that fit.
        for (var i = 0u; i < BUCKETS_PER_THREAD; i++) {
            let bucket = thread * BUCKETS_PER_THREAD + i;
            if atomicLoad(&scratch[bucket]) <= BATCH_CAPACITY {
                atomicMax(&batch_count, bucket + 1u);
            }
        }
        workgroupBarrier();
        let fitting = atomicLoad(&batch_count);
        var is_any = 0u;
        if fitting > 0u {
            is_any = atomicLoad(&scratch[fitting - 1u]);
        }
        let found = broadcast(thread, vec2u(fitting, is_any));
        is_found = true;
        if found.y == 0u {
            // The first bucket that is not empty exceeds a batch: look into it.
            high -= found.x << shift;
            is_found = shift == 0u;
            are_one = is_found;
            low = max(low, high - min(high, (1u << shift) - 1u));
        } else if found.x < BUCKETS {
            low = max(low, high - min(high, (found.x << shift) - 1u));
        }
    }
    return RankRange(low, high, are_one);
}

// Loads the next batch. Returns its number of lines, which may be 0.
fn next_batch(thread: u32, list: vec2u, remaining: ptr<function, Remaining>) -> u32 {
    if list.y - list.x <= BATCH_CAPACITY {
        (*remaining).is_any = false;
        let ranks = vec2u((*remaining).low, (*remaining).high);
        sort_batch(thread, list.x, list.y - list.x, ranks, false);
        return list.y - list.x;
    }
    var ranks = RankRange((*remaining).high, (*remaining).high, true);
    if (*remaining).position == list.x {
        ranks = select_ranks(thread, list, *remaining);
    }
    var range = list;
    if ranks.are_one {
        range = vec2u((*remaining).position, min((*remaining).position + BATCH_CAPACITY, list.y));
    }
    (*remaining).position = select(list.x, range.y, range.y < list.y);
    if (*remaining).position == list.x {
        (*remaining).is_any = ranks.low > (*remaining).low;
        (*remaining).high = ranks.low - 1u;
    } else {
        (*remaining).high = ranks.high;
    }
    clear_buckets(thread);
    for (var position = range.x + thread; position < range.y; position += THREADS) {
        let rank = rank_at(position);
        if rank >= ranks.low && rank <= ranks.high {
            batch[atomicAdd(&batch_count, 1u)] = references[position];
        }
        loops++;
    }
    workgroupBarrier();
    let count = broadcast(thread, vec2u(atomicLoad(&batch_count))).x;
    sort_batch(thread, 0u, count, vec2u(ranks.low, ranks.high), true);
    return count;
}
