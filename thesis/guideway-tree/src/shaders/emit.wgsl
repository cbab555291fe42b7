// Emits the inner nodes of an LBVH over sorted leaves, in one pass from the leaves up (Apetrei
// 2014). Inner node `i` splits the leaves after leaf `i`. Where two neighbors differ in a higher
// bit, the split is nearer to the root; equal keys differ by their place.
//
// Two threads meet at a node and exchange the ends of their ranges by one atomic operation, so no
// thread depends on the order of other writes.

override WORKGROUP: u32;

const NONE: u32 = 0xffffffffu;

@group(0) @binding(1) var<storage, read> keys: array<u32>;
@group(0) @binding(2) var<storage, read_write> children: array<u32>;
@group(0) @binding(3) var<storage, read_write> parents: array<u32>;
// Per inner node, one more than the far end of the range of the first thread; 0 before.
@group(0) @binding(4) var<storage, read_write> ends: array<atomic<u32>>;

// Returns true if the split after leaf `a` is nearer to the leaves than the one after leaf `b`.
fn is_below(a: u32, b: u32) -> bool {
    let by_key_a = keys[a] ^ keys[a + 1u];
    let by_key_b = keys[b] ^ keys[b + 1u];
    if by_key_a != by_key_b {
        return by_key_a < by_key_b;
    }
    return (a ^ (a + 1u)) < (b ^ (b + 1u));
}

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
    let last = build.leaves - 1u;
    var node = last + leaf;
    var low = leaf;
    var high = leaf;
    while low > 0u || high < last {
        let is_left = low == 0u || (high < last && is_below(high, low - 1u));
        let parent = select(low - 1u, high, is_left);
        children[2u * parent + select(1u, 0u, is_left)] = node;
        parents[node] = parent;
        let end = select(high, low, is_left);
        let met = atomicExchange(&ends[parent], end + 1u);
        if met == 0u {
            return;
        }
        if is_left {
            high = met - 1u;
        } else {
            low = met - 1u;
        }
        node = parent;
    }
    parents[node] = NONE;
    children[2u * last] = node;
}
