// What turns the strokes of clusters into lines.

// The clusters whose control points the bound buffer holds.
struct Chunk {
    first_cluster: u32,
    end_cluster: u32,
    // 0: all of them. 1: some, so that tiles may become full. 2: the others, where tiles are not full.
    round: u32,
    // 1: those seen from so near that exact points take the place of rounded ones. 0: the others.
    is_near: u32,
}

// Every so many clusters are of the first round.
const STRIDE: u32 = 4u;

@group(0) @binding(1) var<uniform> chunk: Chunk;
@group(0) @binding(3) var<storage, read> strokes: array<Stroke>;
@group(0) @binding(4) var<storage, read> clusters: array<Cluster>;
@group(0) @binding(5) var<storage, read> styles: array<Style>;
@group(0) @binding(6) var<storage, read_write> found: Found;
@group(0) @binding(7) var<storage, read_write> lines: array<u32>;
@group(0) @binding(8) var<storage, read_write> line_ranks: array<u32>;
@group(0) @binding(9) var<storage, read_write> counts: array<atomic<u32>>;

// Room for so many lines of a cluster: in a block, where they are kept.
fn room_for(cluster: u32, count: u32) -> u32 {
    atomics(1u);
    if frame.keeps_lines == 0u {
        return frame.first_line + atomicAdd(&found.counters.lines, count);
    }
    let head = frame.first_line + atomicAdd(&found.counters.lines, count + 1u);
    if head < frame.line_room {
        lines[head * LINE_WORDS] = NOWHERE;
        lines[head * LINE_WORDS + 1u] = atomicExchange(&found.places[cluster].block, head + 1u);
        lines[head * LINE_WORDS + 2u] = count;
    }
    return head + 1u;
}

// Whether all of a cluster's box is in what is drawn, with all its strokes.
fn is_all_drawn(cluster: Cluster, box: vec4f) -> bool {
    let reach = reach_of(widest_px(cluster));
    return all(box.xy - reach >= frame.drawn_low_px) && all(box.zw + reach <= frame.drawn_high_px);
}
