// Fits the boxes of all nodes to the curves. Every leaf adds its box, and the rank of its path, to
// the nodes above it by atomic maxima, and stops where it changes nothing: whoever made that node
// so large goes on. Maxima are commutative, so the result does not depend on the order.

override WORKGROUP: u32;
override RANKED: bool;

const NONE: u32 = 0xffffffffu;

@group(0) @binding(3) var<storage, read> order: array<u32>;
@group(0) @binding(4) var<storage, read> parents: array<u32>;
// Four numbers per node, zeros before.
@group(0) @binding(5) var<storage, read_write> boxes: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> top_ranks: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP)
fn main(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let leaf = (workgroup.y * workgroups.x + workgroup.x) * WORKGROUP + thread;
    if leaf >= build.leaves {
        return;
    }
    let segment = order[leaf];
    // The part that is left to add; 0 adds nothing.
    var box = packed_box(box_of(segment));
    var rank = select(0u, segments[segment].y, RANKED);
    var node = build.leaves - 1u + leaf;
    while node != NONE && (rank > 0u || any(box > vec4u(0u))) {
        box.x = raise(4u * node, box.x);
        box.y = raise(4u * node + 1u, box.y);
        box.z = raise(4u * node + 2u, box.z);
        box.w = raise(4u * node + 3u, box.w);
        if rank > 0u && atomicMax(&top_ranks[node], rank) >= rank {
            rank = 0u;
        }
        node = parents[node];
    }
}

// Raises a number of a box. Returns 0 if it was as high before.
fn raise(index: u32, value: u32) -> u32 {
    if value > 0u && atomicMax(&boxes[index], value) < value {
        return value;
    }
    return 0u;
}
