// Counters of a frame and one slot per cluster. Rust: `FrameCounters`, `ClusterSlot`.
// The importing shader binds `counters: CounterBuffer`.
//
// Lines, references and split lists are counted beyond the capacity of their buffers, so that the
// host can grow them and draw again.

// import: shared/work_counts.wgsl

struct Counters {
    // Visible clusters drawn from rounded and from exact points.
    rounded_clusters: atomic<u32>,
    exact_clusters: atomic<u32>,
    lines: atomic<u32>,
    references: atomic<u32>,
    drawn_paths: atomic<u32>,
    // Length of the longest tile list.
    longest_list: atomic<u32>,
    // Tiles whose samples are all covered.
    full_tiles: atomic<u32>,
    // Greatest loop count of a thread of a composited tile.
    max_loops: atomic<u32>,
    // Visible clusters whose exact points are not on the device.
    missing_clusters: atomic<u32>,
    // Tiles whose lists are split among workgroups, and the parts of these lists.
    split_tiles: atomic<u32>,
    split_parts: atomic<u32>,
    // Length of the longest list or list part that one workgroup covers, if lists are split.
    longest_unsplit: atomic<u32>,
    // Each member of `Work` as two words, low word first.
    work: array<atomic<u32>, 8>,
}

struct ClusterSlot {
    // Visible clusters: those drawn from rounded points from the front, the others from the back.
    visible: u32,
    // Newest line block of the cluster with this index.
    block: atomic<u32>,
}

struct CounterBuffer {
    totals: Counters,
    clusters: array<ClusterSlot>,
}

// Adds the work of this thread to the counters.
fn report_work() {
    if COUNTS {
        var counts = array(work.tests, work.atomics, work.words_read, work.words_written);
        for (var i = 0u; i < 4u; i++) {
            let before = atomicAdd(&counters.totals.work[2u * i], counts[i]);
            if before > ~counts[i] {
                atomicAdd(&counters.totals.work[2u * i + 1u], 1u);
            }
        }
    }
}
