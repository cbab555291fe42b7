// Which path lies on top at each pixel of a tile: one more than the highest rank that covers any of its
// samples, or zero. It does not matter in which order lines come.

var<workgroup> capsules: array<Capsule, TURN>;
var<workgroup> ranks: array<u32, TURN>;
var<workgroup> tops: array<atomic<u32>, THREADS>;

fn raise(row: u32, covered: Row, rank: u32) {
    let pixels_a_word = 32u / SAMPLES_A_ROW;
    for (var word = 0u; word < WORDS; word++) {
        for (var of_word = 0u; of_word < pixels_a_word; of_word++) {
            if bits_of_pixel(covered[word], of_word) != 0u {
                let pixel = (row / SAMPLE_ROWS) * TILE_PX + word * pixels_a_word + of_word;
                atomicMax(&tops[pixel], rank + 1u);
            }
        }
    }
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let index = workgroup_index(id, count);
    if index >= frame.columns * frame.rows {
        return;
    }
    let tile = tile_of(index);
    let list = list_of(index);
    let start = list.x;
    let end = list.y;
    atomicStore(&tops[thread], 0u);
    for (var first = start; first < end; first += TURN) {
        let batch = min(TURN, end - first);
        workgroupBarrier();
        if thread < batch {
            capsules[thread] = capsule_at(tile, first + thread);
            ranks[thread] = line_ranks[references[first + thread]];
        }
        workgroupBarrier();
        for (var i = 0u; i < batch; i++) {
            var covered: Row;
            cover(&covered, capsules[i], thread);
            raise(thread, covered, ranks[i]);
        }
    }
    workgroupBarrier();
    write(tile, thread, atomicLoad(&tops[thread]));
}
