// Computes the key of every segment from the center of its box. Quadtree: the level and cell, and
// the segments per level. Tree: the place along Morton's curve.

override WORKGROUP: u32;
override QUADTREE: bool;

@group(0) @binding(3) var<storage, read_write> keys: array<u32>;
@group(0) @binding(4) var<storage, read_write> order: array<u32>;
@group(0) @binding(5) var<storage, read_write> boxes: array<vec4u>;
@group(0) @binding(6) var<storage, read_write> counters: array<atomic<u32>>;

var<workgroup> levels: array<atomic<u32>, 16>;

@compute @workgroup_size(WORKGROUP)
fn main(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    if thread < 16u {
        atomicStore(&levels[thread], 0u);
    }
    workgroupBarrier();
    let segment = (workgroup.y * workgroups.x + workgroup.x) * WORKGROUP + thread;
    if segment < build.leaves {
        let box = box_of(segment);
        let center_m = (box.low_m + box.high_m) * 0.5;
        order[segment] = segment;
        if QUADTREE {
            let size_m = max(box.high_m.x - box.low_m.x, box.high_m.y - box.low_m.y);
            var level = build.max_level;
            while level > 0u && size_m > ldexp(build.side_m, -i32(level)) {
                level -= 1u;
            }
            let cell = cell_of(center_m, build.origin_m, build.side_m, level);
            keys[segment] = key_of(cell, level);
            boxes[segment] = packed_box(box);
            atomicAdd(&levels[level], 1u);
        } else {
            keys[segment] = morton(cell_of(center_m, build.origin_m, build.side_m, 16u));
        }
    }
    workgroupBarrier();
    if QUADTREE && thread < 15u && atomicLoad(&levels[thread]) > 0u {
        atomicAdd(&counters[1u + thread], atomicLoad(&levels[thread]));
    }
}
