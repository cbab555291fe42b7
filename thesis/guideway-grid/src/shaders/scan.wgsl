// Blelloch's work-efficient exclusive scan (Harris et al., GPU Gems 3, chapter 39): a tree of sums
// in workgroup memory. Cost: linear in the values. No workgroup waits for another.

// Threads per workgroup, a power of two; each has two values of a block.
override SCAN_THREADS: u32;

var<workgroup> tree: array<u32, 2u * SCAN_THREADS>;

// Replaces each value of the tree by the sum of all values before it; returns the total.
fn scan(thread: u32) -> u32 {
    // Up: every inner node gets the sum of its leaves.
    var stride = 1u;
    for (var nodes = SCAN_THREADS; nodes > 0u; nodes >>= 1u) {
        workgroupBarrier();
        if thread < nodes {
            let right = stride * (2u * thread + 2u) - 1u;
            tree[right] += tree[right - stride];
        }
        stride <<= 1u;
    }
    let root = 2u * SCAN_THREADS - 1u;
    let sum = workgroupUniformLoad(&tree[root]);
    if thread == 0u {
        tree[root] = 0u;
    }
    // Down: every node passes its prefix to the left child, and prefix plus left sum to the right.
    for (var nodes = 1u; nodes <= SCAN_THREADS; nodes <<= 1u) {
        stride >>= 1u;
        workgroupBarrier();
        if thread < nodes {
            let right = stride * (2u * thread + 2u) - 1u;
            let left_sum = tree[right - stride];
            tree[right - stride] = tree[right];
            tree[right] += left_sum;
        }
    }
    workgroupBarrier();
    return sum;
}
