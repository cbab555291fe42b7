// What the stages of a frame find; more lines and references than there is room for are counted, too.

struct Counters {
    // Clusters that may be seen: those drawn from rounded points, and from exact ones.
    rounded: atomic<u32>,
    exact: atomic<u32>,
    lines: atomic<u32>,
    references: atomic<u32>,
    drawn: atomic<u32>,
    // Length of the longest list.
    longest: atomic<u32>,
    // Tiles all of whose samples are covered.
    full_tiles: atomic<u32>,
    // Times that a thread of a tile with layers has gone round its loops, at most.
    rounds: atomic<u32>,
    // Clusters that are seen from near and whose exact points are not there.
    missing: atomic<u32>,
    // Tiles that several workgroups cover, and the parts of their lists; more than there is room for are counted, too.
    shared_tiles: atomic<u32>,
    parts: atomic<u32>,
    // Length of the longest list, or part of one, that one workgroup goes through where others have such parts.
    longest_alone: atomic<u32>,
    // Each of `Work` in two words, the low one first.
    work: array<atomic<u32>, 8>,
}

struct Place {
    // A cluster that may be seen: those drawn from rounded points from the front, the others from the back.
    seen: u32,
    // Of the cluster of this number: its newest block of kept lines.
    block: atomic<u32>,
}

struct Found {
    counters: Counters,
    places: array<Place>,
}

// Adds what this thread has done to the work of the frame.
fn report_work() {
    if COUNTS {
        var counts = array(work.tests, work.atomics, work.words_read, work.words_written);
        for (var i = 0u; i < 4u; i++) {
            let before = atomicAdd(&found.counters.work[2u * i], counts[i]);
            if before > ~counts[i] {
                atomicAdd(&found.counters.work[2u * i + 1u], 1u);
            }
        }
    }
}
