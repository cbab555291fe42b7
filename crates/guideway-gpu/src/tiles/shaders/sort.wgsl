// A workgroup sorts the list of one tile by draw rank, the highest first (Batcher's bitonic sort in the form
// in which all comparisons point the same way, so that a list of any length behaves as if it ended in
// entries that never move).

override THREADS: u32;

@group(0) @binding(1) var<storage, read> starts: array<u32>;
@group(0) @binding(2) var<storage, read_write> references: array<u32>;
@group(0) @binding(3) var<storage, read> line_ranks: array<u32>;

fn rank_of(place: u32) -> u32 {
    return line_ranks[references[place]];
}

fn order(a: u32, b: u32) {
    if rank_of(a) < rank_of(b) {
        let line = references[a];
        references[a] = references[b];
        references[b] = line;
    }
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) group_count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let index = workgroup_index(id, group_count);
    if index >= frame.columns * frame.rows {
        return;
    }
    let start = starts[index];
    let end = starts[index + 1u];
    if end > frame.reference_room || end - start < 2u {
        return;
    }
    let count = end - start;
    var block = 2u;
    loop {
        // The first half of a block against the mirrored second half, then ever closer pairs.
        for (var step = block / 2u; step > 0u; step /= 2u) {
            for (var pair = thread; pair * 2u < count + block; pair += THREADS) {
                let low = (pair / step) * 2u * step + pair % step;
                var high = low + step;
                if step == block / 2u {
                    high = (low / block) * block + block - 1u - low % block;
                }
                if high < count {
                    order(start + low, start + high);
                }
            }
            storageBarrier();
        }
        if block >= count {
            break;
        }
        block *= 2u;
    }
}
