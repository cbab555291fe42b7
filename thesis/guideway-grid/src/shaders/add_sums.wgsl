// Prefix sum, step 3: adds to every cell the sum of all blocks before its block.

override SCAN_THREADS: u32;

@group(0) @binding(0) var<storage, read_write> starts: array<u32>;
@group(0) @binding(1) var<storage, read> block_sums: array<u32>;

@compute @workgroup_size(SCAN_THREADS)
fn main(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let block = workgroup.y * workgroups.x + workgroup.x;
    let first = 2u * (block * SCAN_THREADS + thread);
    if first < arrayLength(&starts) {
        starts[first] += block_sums[block];
    }
    if first + 1u < arrayLength(&starts) {
        starts[first + 1u] += block_sums[block];
    }
}
