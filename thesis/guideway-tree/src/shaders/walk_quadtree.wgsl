// Walks over a linear quadtree: on every level the cells that a window meets, each by a binary
// search over the sorted keys. A segment belongs to the cell of its center on the deepest level
// whose cells are as large as its box, so it reaches at most half a cell beyond its cell.

// Segments in the order of the keys.
@group(0) @binding(3) var<storage, read> order: array<u32>;
// Per segment, packed.
@group(0) @binding(4) var<storage, read> boxes: array<vec4u>;
@group(0) @binding(9) var<storage, read> keys: array<u32>;

// The first of the sorted keys in a range that is not below a key.
fn lower_bound(pixel: ptr<function, Pixel>, key: u32, first: u32, end: u32) -> u32 {
    var low = first;
    var high = end;
    while low < high {
        count_bytes(pixel, 4u);
        let middle = (low + high) / 2u;
        if keys[middle] < key {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    return low;
}

// Resumes at cell `resume.x % 65536` of level `resume.x / 65536`, at key `resume.y`.
fn walk(pixel: ptr<function, Pixel>, low_m: vec2f, high_m: vec2f, resume: vec2u) -> vec2u {
    let window = packed_window(low_m, high_m);
    var spent = 0u;
    var end = 0u;
    for (var level = 0u; level <= view.max_level; level++) {
        let first = end;
        end += atomicLoad(&counters[1u + level]);
        if first == end || level < (resume.x >> 16u) {
            continue;
        }
        // A little more than half a cell covers rounding.
        let half_m = 0.501 * ldexp(view.side_m, -i32(level));
        let low = cell_of(low_m - half_m, view.origin_m, view.side_m, level);
        let high = cell_of(high_m + half_m, view.origin_m, view.side_m, level);
        let columns = high.x - low.x + 1u;
        let cells = columns * (high.y - low.y + 1u);
        for (var i = 0u; i < cells; i++) {
            let here = (level << 16u) | i;
            if here < resume.x {
                continue;
            }
            let key = key_of(low + vec2u(i % columns, i / columns), level);
            var at = lower_bound(pixel, key, first, end);
            spent += 32u;
            if here == resume.x {
                at = max(at, resume.y);
            }
            while at < end && keys[at] == key {
                let segment = order[at];
                at += 1u;
                count_bytes(pixel, 24u);
                spent += 1u;
                if all(boxes[segment] >= window) && !is_hidden(pixel, segments[segment].y) {
                    cover_segment(pixel, segment);
                    spent += segment_cost();
                    if !RANKED && is_hidden(pixel, 1u) {
                        return vec2u(DONE, 0u);
                    }
                }
                if spent >= view.limit {
                    return vec2u(here, at);
                }
            }
            if spent >= view.limit {
                return vec2u(here, at);
            }
        }
    }
    return vec2u(DONE, 0u);
}
