// Walks over an AABB tree from the leftmost leaf to the rightmost. Inner node `i` splits the leaves
// after leaf `i`; leaf `i` is node `leaves - 1 + i`.

// derived: the keys that split the leaves have 32 bits, and so have the numbers of the leaves.
const MAX_DEPTH: u32 = 64u;

// Leaves in the order of the tree.
@group(0) @binding(3) var<storage, read> order: array<u32>;
// Per node, packed.
@group(0) @binding(4) var<storage, read> boxes: array<vec4u>;
// Left and right child per inner node; then the root.
@group(0) @binding(9) var<storage, read> children: array<u32>;
// Per node, the highest rank below it.
@group(0) @binding(10) var<storage, read> top_ranks: array<u32>;

// Resumes at leaf `resume.x`.
fn walk(pixel: ptr<function, Pixel>, low_m: vec2f, high_m: vec2f, resume: vec2u) -> vec2u {
    let window = packed_window(low_m, high_m);
    let inner = view.leaves - 1u;
    var stack: array<u32, MAX_DEPTH>;
    var depth = 0u;
    var node = children[2u * inner];
    var spent = 0u;
    loop {
        count_bytes(pixel, 16u);
        spent += 1u;
        var is_visible = all(boxes[node] >= window);
        if is_visible && EXIT {
            var rank = 1u;
            if RANKED {
                rank = top_ranks[node];
            }
            is_visible = !is_hidden(pixel, rank);
        }
        if is_visible && node < inner {
            count_bytes(pixel, 8u);
            if resume.x > node {
                node = children[2u * node + 1u];
            } else {
                stack[depth] = node;
                depth += 1u;
                node = children[2u * node];
            }
            continue;
        }
        if is_visible && node - inner >= resume.x {
            cover_segment(pixel, order[node - inner]);
            spent += segment_cost();
            if !RANKED && is_hidden(pixel, 1u) {
                break;
            }
        }
        if depth == 0u {
            break;
        }
        depth -= 1u;
        let split = stack[depth];
        if spent >= view.limit {
            return vec2u(split + 1u, 0u);
        }
        node = children[2u * split + 1u];
    }
    return vec2u(DONE, 0u);
}
