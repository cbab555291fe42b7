// Prefix sum, step 1: scans every block of cells on its own.

@group(0) @binding(0) var<storage, read> counts: array<u32>;
@group(0) @binding(1) var<storage, read_write> starts: array<u32>;
@group(0) @binding(2) var<storage, read_write> block_sums: array<u32>;

@compute @workgroup_size(SCAN_THREADS)
fn main(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let block = workgroup.y * workgroups.x + workgroup.x;
    let first = 2u * (block * SCAN_THREADS + thread);
    // Reads past the end return any value; only sums past the end depend on them.
    tree[2u * thread] = counts[first];
    tree[2u * thread + 1u] = counts[first + 1u];
    let sum = scan(thread);
    if first < arrayLength(&starts) {
        starts[first] = tree[2u * thread];
    }
    if first + 1u < arrayLength(&starts) {
        starts[first + 1u] = tree[2u * thread + 1u];
    }
    if thread == 0u && block < arrayLength(&block_sums) {
        block_sums[block] = sum;
    }
}
