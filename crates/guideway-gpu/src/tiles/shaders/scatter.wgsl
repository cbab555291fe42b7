// One thread for one line after the other: enters it into the lists of the tiles that it may touch.

override WORKGROUP: u32;

@group(0) @binding(1) var<storage, read> found: CountersBefore;
@group(0) @binding(2) var<storage, read> lines_px: array<vec4f>;
@group(0) @binding(3) var<storage, read> line_ranks: array<u32>;
@group(0) @binding(4) var<storage, read> styles: array<Style>;
@group(0) @binding(5) var<storage, read_write> filled: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> references: array<u32>;

@compute @workgroup_size(WORKGROUP)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    // What has no room is drawn again with more.
    if found.lines > frame.line_room || found.references > frame.reference_room {
        return;
    }
    let threads = count.x * count.y * WORKGROUP;
    for (var i = workgroup_index(id, count) * WORKGROUP + thread; i < found.lines; i += threads) {
        let rank = line_ranks[i];
        if rank == NO_RANK {
            continue;
        }
        let line = lines_px[i];
        let reach = radius_of(rank) + MARGIN_PX;
        let rows = rows_of(line, reach);
        for (var row = rows.x; row < rows.y; row++) {
            let columns = columns_of(line, reach, row);
            for (var column = columns.x; column < columns.y; column++) {
                let place = atomicAdd(&filled[tile_index(row, column)], 1u);
                if place < FULL {
                    references[place] = i;
                }
            }
        }
    }
}
