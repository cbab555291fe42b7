// Takes the lines of a list in falling draw rank, as many at a time as there are places for: those of a tile that is soon full
// are never brought into order. Lines of one path stand together.

const TILE_THREADS: u32 = 256u;
// Buckets that ranks are told apart by, and most lines of a portion.
const BUCKET_BITS: u32 = 9u;
const BUCKETS: u32 = 1u << BUCKET_BITS;
const PORTION: u32 = BUCKETS;
// Of each thread.
const PLACES: u32 = PORTION / TILE_THREADS;
const BUCKETS_EACH: u32 = BUCKETS / TILE_THREADS;

// References of the lines that were taken, at first as they come, then the ranks of each bucket together, then references in order.
var<workgroup> portion: array<u32, PORTION>;
// How many lines each bucket has, then where it ends; at last sums of colors. The less a workgroup shares, the more run at a time.
var<workgroup> scratch: array<atomic<u32>, BUCKETS>;
var<workgroup> lowest: atomic<u32>;
var<workgroup> highest: atomic<u32>;
var<workgroup> told: vec2u;
var<workgroup> taken: atomic<u32>;

// What is left of a list: lines of ranks between two. Where the highest has more lines than a portion, only those from a place on.
struct Left {
    low: u32,
    high: u32,
    place: u32,
    is_any: bool,
}

// The ranks of a portion; of one that has more lines than a portion, those are taken in parts.
struct Ranks {
    low: u32,
    high: u32,
    are_one: bool,
}

// What two numbers are for all threads, as the first one knows them.
fn tell(thread: u32, numbers: vec2u) -> vec2u {
    if thread == 0u {
        told = numbers;
    }
    return workgroupUniformLoad(&told);
}

fn rank_at(place: u32) -> u32 {
    reads(2u);
    return line_ranks[references[place]];
}

// The lowest and the highest rank of a list.
fn left_of(thread: u32, list: vec2u) -> Left {
    if thread == 0u {
        atomicStore(&lowest, 0xffffffffu);
        atomicStore(&highest, 0u);
    }
    workgroupBarrier();
    var low = 0xffffffffu;
    var high = 0u;
    for (var place = list.x + thread; place < list.y; place += THREADS) {
        let rank = rank_at(place);
        low = min(low, rank);
        high = max(high, rank);
        rounds++;
    }
    atomicMin(&lowest, low);
    atomicMax(&highest, high);
    workgroupBarrier();
    let ranks = tell(thread, vec2u(atomicLoad(&lowest), atomicLoad(&highest)));
    return Left(ranks.x, ranks.y, list.x, true);
}

// By how many bits ranks between two are shortened to be the number of a bucket; the highest rank is in the first one.
fn shift_of(low: u32, high: u32) -> u32 {
    return max(32u - countLeadingZeros(high - low), BUCKET_BITS) - BUCKET_BITS;
}

fn clear_buckets(thread: u32) {
    for (var i = 0u; i < BUCKETS_EACH; i++) {
        atomicStore(&scratch[i * THREADS + thread], 0u);
    }
    if thread == 0u {
        atomicStore(&taken, 0u);
    }
    workgroupBarrier();
}

// Makes of the number of lines in each bucket where it ends.
fn add_buckets(thread: u32) {
    workgroupBarrier();
    var counts: array<u32, BUCKETS_EACH>;
    var own = 0u;
    for (var i = 0u; i < BUCKETS_EACH; i++) {
        counts[i] = atomicLoad(&scratch[thread * BUCKETS_EACH + i]);
        own += counts[i];
    }
    var end = add_up(thread, own) - own;
    for (var i = 0u; i < BUCKETS_EACH; i++) {
        end += counts[i];
        atomicStore(&scratch[thread * BUCKETS_EACH + i], end);
    }
    workgroupBarrier();
}

// The ranks of the next portion of a long list: as many as fit, or one that has more lines than that.
fn next_ranks(thread: u32, list: vec2u, left: Left) -> Ranks {
    var low = left.low;
    var high = left.high;
    var are_one = false;
    for (var is_found = false; !is_found;) {
        let shift = shift_of(low, high);
        clear_buckets(thread);
        for (var place = list.x + thread; place < list.y; place += THREADS) {
            let rank = rank_at(place);
            if rank >= low && rank <= high {
                atomicAdd(&scratch[(high - rank) >> shift], 1u);
            }
            rounds++;
        }
        add_buckets(thread);
        // How many buckets fit.
        for (var i = 0u; i < BUCKETS_EACH; i++) {
            let bucket = thread * BUCKETS_EACH + i;
            if atomicLoad(&scratch[bucket]) <= PORTION {
                atomicMax(&taken, bucket + 1u);
            }
        }
        workgroupBarrier();
        let fitting = atomicLoad(&taken);
        var is_any = 0u;
        if fitting > 0u {
            is_any = atomicLoad(&scratch[fitting - 1u]);
        }
        let found = tell(thread, vec2u(fitting, is_any));
        is_found = true;
        if found.y == 0u {
            // The first bucket that has any has too many.
            high -= found.x << shift;
            is_found = shift == 0u;
            are_one = is_found;
            low = max(low, high - min(high, (1u << shift) - 1u));
        } else if found.x < BUCKETS {
            low = max(low, high - min(high, (found.x << shift) - 1u));
        }
    }
    return Ranks(low, high, are_one);
}

// Takes the next portion of a list. Returns how many lines it has; it may have none.
fn take_portion(thread: u32, list: vec2u, left: ptr<function, Left>) -> u32 {
    if list.y - list.x <= PORTION {
        (*left).is_any = false;
        order(thread, list.x, list.y - list.x, vec2u((*left).low, (*left).high), false);
        return list.y - list.x;
    }
    var ranks = Ranks((*left).high, (*left).high, true);
    if (*left).place == list.x {
        ranks = next_ranks(thread, list, *left);
    }
    var places = list;
    if ranks.are_one {
        places = vec2u((*left).place, min((*left).place + PORTION, list.y));
    }
    (*left).place = select(list.x, places.y, places.y < list.y);
    if (*left).place == list.x {
        (*left).is_any = ranks.low > (*left).low;
        (*left).high = ranks.low - 1u;
    } else {
        (*left).high = ranks.high;
    }
    clear_buckets(thread);
    for (var place = places.x + thread; place < places.y; place += THREADS) {
        let rank = rank_at(place);
        if rank >= ranks.low && rank <= ranks.high {
            portion[atomicAdd(&taken, 1u)] = references[place];
        }
        rounds++;
    }
    workgroupBarrier();
    let count = tell(thread, vec2u(atomicLoad(&taken))).x;
    order(thread, 0u, count, vec2u(ranks.low, ranks.high), true);
    return count;
}
