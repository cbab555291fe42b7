// Prefix sum, step 2: replaces the sum of each block by the sum of all blocks before it. A single
// workgroup loops over all blocks.

@group(0) @binding(0) var<storage, read_write> block_sums: array<u32>;

@compute @workgroup_size(SCAN_THREADS)
fn main(@builtin(local_invocation_index) thread: u32) {
    var before = 0u;
    for (var start = 0u; start < arrayLength(&block_sums); start += 2u * SCAN_THREADS) {
        let first = start + 2u * thread;
        tree[2u * thread] = block_sums[first];
        tree[2u * thread + 1u] = block_sums[first + 1u];
        let sum = scan(thread);
        if first < arrayLength(&block_sums) {
            block_sums[first] = before + tree[2u * thread];
        }
        if first + 1u < arrayLength(&block_sums) {
            block_sums[first + 1u] = before + tree[2u * thread + 1u];
        }
        before += sum;
    }
}
