// Sums half the perimeters of the boxes of inner nodes and of leaves, and finds the deepest leaf:
// one sum per workgroup. A walk visits a box in proportion to its size.

override WORKGROUP: u32;
// Nodes per thread.
override NODES: u32;

const NONE: u32 = 0xffffffffu;

@group(0) @binding(1) var<storage, read> parents: array<u32>;
@group(0) @binding(2) var<storage, read> boxes: array<vec4u>;
// Inner nodes, leaves, depth.
@group(0) @binding(3) var<storage, read_write> sums: array<vec4f>;

var<workgroup> parts: array<vec4f, WORKGROUP>;

@compute @workgroup_size(WORKGROUP)
fn main(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let group = workgroup.y * workgroups.x + workgroup.x;
    var sum = vec4f(0.0);
    for (var i = 0u; i < NODES; i++) {
        let node = (group * NODES + i) * WORKGROUP + thread;
        if node < 2u * build.leaves - 1u {
            let size_m = unordered(boxes[node].zw) - unordered(~boxes[node].xy);
            let is_leaf = node >= build.leaves - 1u;
            sum += select(vec4f(1.0, 0.0, 0.0, 0.0), vec4f(0.0, 1.0, 0.0, 0.0), is_leaf)
                * (size_m.x + size_m.y);
            if is_leaf && build.measures_depth == 1u {
                sum.z = max(sum.z, depth_of(node));
            }
        }
    }
    parts[thread] = sum;
    for (var half = WORKGROUP / 2u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if thread < half {
            let other = parts[thread + half];
            let own = parts[thread];
            parts[thread] = vec4f(own.xy + other.xy, max(own.z, other.z), 0.0);
        }
    }
    if thread == 0u && group < arrayLength(&sums) {
        sums[group] = parts[0];
    }
}

fn depth_of(leaf: u32) -> f32 {
    var depth = 0u;
    for (var node = parents[leaf]; node != NONE; node = parents[node]) {
        depth += 1u;
    }
    return f32(depth);
}

// The floats of `ordered`.
fn unordered(x: vec2u) -> vec2f {
    let is_negative = (x >> vec2u(31u)) == vec2u(0u);
    return bitcast<vec2f>(x ^ select(vec2u(0x80000000u), vec2u(0xffffffffu), is_negative));
}
