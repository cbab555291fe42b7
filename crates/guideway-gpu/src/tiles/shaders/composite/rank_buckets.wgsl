// Buckets of draw ranks in workgroup memory, shared by selection and sorting.

// import: composite/loop_count.wgsl
// import: shared/workgroup_scan.wgsl
// import: shared/tile.wgsl

const TILE_THREADS: u32 = 256u;
// Rank buckets, and the most lines per batch.
const BUCKET_BITS: u32 = 9u;
const BUCKETS: u32 = 1u << BUCKET_BITS;
const BATCH_CAPACITY: u32 = BUCKETS;
// Per thread.
const LINES_PER_THREAD: u32 = BATCH_CAPACITY / TILE_THREADS;
const BUCKETS_PER_THREAD: u32 = BUCKETS / TILE_THREADS;

// References of the batch as they come, then ranks grouped by bucket, then references by rank.
var<workgroup> batch: array<u32, BATCH_CAPACITY>;
// Bucket counts, then bucket ends, at last color sums: shared memory bounds the occupancy.
var<workgroup> scratch: array<atomic<u32>, BUCKETS>;
var<workgroup> lowest: atomic<u32>;
var<workgroup> highest: atomic<u32>;
var<workgroup> broadcast_value: vec2u;
var<workgroup> batch_count: atomic<u32>;

// Broadcasts thread 0's numbers to the workgroup.
fn broadcast(thread: u32, numbers: vec2u) -> vec2u {
    if thread == 0u {
        broadcast_value = numbers;
    }
    return workgroupUniformLoad(&broadcast_value);
}

// Bits to drop from a rank distance so that it numbers a bucket; the highest rank is in bucket 0.
fn shift_of(low: u32, high: u32) -> u32 {
    return max(32u - countLeadingZeros(high - low), BUCKET_BITS) - BUCKET_BITS;
}

fn clear_buckets(thread: u32) {
    for (var i = 0u; i < BUCKETS_PER_THREAD; i++) {
        atomicStore(&scratch[i * THREADS + thread], 0u);
    }
    if thread == 0u {
        atomicStore(&batch_count, 0u);
    }
    workgroupBarrier();
}

// Turns bucket counts into bucket ends.
fn add_buckets(thread: u32) {
    workgroupBarrier();
    var counts: array<u32, BUCKETS_PER_THREAD>;
    var own = 0u;
    for (var i = 0u; i < BUCKETS_PER_THREAD; i++) {
        counts[i] = atomicLoad(&scratch[thread * BUCKETS_PER_THREAD + i]);
        own += counts[i];
    }
    var end = workgroup_scan(thread, own) - own;
    for (var i = 0u; i < BUCKETS_PER_THREAD; i++) {
        end += counts[i];
        atomicStore(&scratch[thread * BUCKETS_PER_THREAD + i], end);
    }
    workgroupBarrier();
}
