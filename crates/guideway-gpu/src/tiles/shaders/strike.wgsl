// A workgroup for each cluster that an edit has touched: strikes out its lines, and lists it so that others are made.

@group(0) @binding(3) var<storage, read_write> lines: array<u32>;
@group(0) @binding(4) var<storage, read> touched: array<u32>;

@compute @workgroup_size(WORKGROUP)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let number = workgroup_index(id, count);
    if number >= frame.touched {
        return;
    }
    let index = touched[number];
    var block = atomicLoad(&found.places[index].block);
    while block != NO_BLOCK {
        let head = (block - 1u) * LINE_WORDS;
        let lines_there = lines[head + 2u];
        for (var line = thread; line < lines_there; line += WORKGROUP) {
            lines[(block + line) * LINE_WORDS] = NOWHERE;
        }
        block = lines[head + 1u];
    }
    workgroupBarrier();
    if thread == 0u {
        atomicStore(&found.places[index].block, NO_BLOCK);
        list_cluster(index);
    }
}
