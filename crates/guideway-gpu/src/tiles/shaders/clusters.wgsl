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

// Whether a launch is to draw a cluster, and where its points begin.
struct Taken {
    is_here: bool,
    first_point: u32,
}

// Counts a cluster whose exact points are missing, if it is to tell of that.
fn taken(cluster: Cluster, index: u32, tells: bool) -> Taken {
    let is_of_round = chunk.round == 0u || (index % STRIDE == 0u) == (chunk.round == 1u);
    let is_near = cluster.step_m > frame.most_step_m;
    let is_here = index >= chunk.first_cluster && index < chunk.end_cluster && is_of_round
        && is_near == (chunk.is_near != 0u);
    if !is_here {
        return Taken(false, 0u);
    }
    let first_point = first_point_of_cluster(cluster, index);
    let has_points = !is_near || first_point != 0u;
    if !has_points && tells {
        atomicAdd(&found.counters.missing, 1u);
    }
    return Taken(has_points, first_point);
}

// The box of a cluster, which says whether its lines have to be cut.
fn look_at(cluster: Cluster) -> vec4f {
    let box = box_px(cluster);
    is_inside = all(abs(box.xy) < frame.reach_px) && all(abs(box.zw) < frame.reach_px);
    return box;
}

// Whether a stroke may leave a mark, and whether its lines are made.
struct Need {
    is_there: bool,
    is_needed: bool,
}

fn need_of(cluster: Cluster, all_box: vec4f, curve: Curve, segments: u32, radius: f32) -> Need {
    let has_any = segments > 0u;
    if chunk.round < 2u && is_all_drawn(cluster, all_box) {
        return Need(has_any, has_any);
    }
    let box = box_of(curve, segments);
    let reach = reach_of(radius);
    let is_there = has_any && is_drawn(box, reach);
    if chunk.round < 2u {
        return Need(is_there, has_any && is_made(box, reach));
    }
    let box_px = vec4f(px_from_level(box.xy), px_from_level(box.zw));
    return Need(is_there, is_there && !is_hidden(box_px, radius + MARGIN_PX));
}
