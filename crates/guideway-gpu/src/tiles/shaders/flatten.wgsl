// A workgroup for one cluster after the other, a thread a stroke: turns curves into lines, and counts how
// many touch each tile.

override STROKES: u32;

// The clusters whose control points the bound buffer holds.
struct Chunk {
    first_cluster: u32,
    end_cluster: u32,
    // 0: all of them. 1: some, so that tiles may become full. 2: the others, where tiles are not full.
    round: u32,
    padding: u32,
}

// Every so many clusters are of the first round.
const STRIDE: u32 = 4u;
// Most tiles of a stroke's box that are looked at.
const MOST_LOOKS: u32 = 256u;

struct Found {
    counters: Counters,
    seen: array<u32>,
}

@group(0) @binding(1) var<uniform> chunk: Chunk;
@group(0) @binding(2) var<storage, read> points_m: array<vec2f>;
@group(0) @binding(3) var<storage, read> strokes: array<Stroke>;
@group(0) @binding(4) var<storage, read> clusters: array<Cluster>;
@group(0) @binding(5) var<storage, read> styles: array<Style>;
@group(0) @binding(6) var<storage, read_write> found: Found;
@group(0) @binding(7) var<storage, read_write> lines_px: array<vec4f>;
@group(0) @binding(8) var<storage, read_write> line_ranks: array<u32>;
@group(0) @binding(9) var<storage, read_write> counts: array<atomic<u32>>;

var<workgroup> clusters_seen: u32;
var<workgroup> group_lines: atomic<u32>;
var<workgroup> group_drawn: atomic<u32>;
var<workgroup> first_line: u32;

// The ends of the pieces of a stroke, a bit a segment, and the lines of all pieces together.
struct Plan {
    ends: u32,
    lines: u32,
}

fn plan_of(curve: Curve, segments: u32) -> Plan {
    var plan = Plan(0u, 0u);
    var first = 0u;
    while first < segments {
        var count = segments - first;
        while count > 1u && !is_flat(curve, first, count) {
            count = (count + 1u) / 2u;
        }
        if count == 1u {
            plan.lines += steps_of(curve, first);
        } else {
            plan.lines += 1u;
        }
        first += count;
        plan.ends |= 1u << (first - 1u);
    }
    return plan;
}

// The box of all control points of a stroke: upper left and lower right corner.
fn box_of(curve: Curve, segments: u32) -> vec4f {
    var low = control_px(curve, 0u);
    var high = low;
    for (var i = 1u; i < segments + 3u; i++) {
        let p = control_px(curve, i);
        low = min(low, p);
        high = max(high, p);
    }
    return vec4f(low, high);
}

fn is_full(tile: u32) -> bool {
    return (atomicLoad(&counts[tile]) & FULL) != 0u;
}

// Whether all tiles that a box reaches into are full.
fn is_hidden(box: vec4f, reach_px: f32) -> bool {
    let rows = rows_of(box, reach_px);
    let columns = columns_between(box.x - reach_px, box.z + reach_px);
    if (rows.y - rows.x) * (columns.y - columns.x) > MOST_LOOKS {
        return false;
    }
    for (var row = rows.x; row < rows.y; row++) {
        for (var column = columns.x; column < columns.y; column++) {
            if !is_full(tile_index(row, column)) {
                return false;
            }
        }
    }
    return true;
}

// The part of a line that is within reach of the picture (Liang and Barsky 1984): from x to y of its length,
// none if x is more than y. It is cut a pixel outside of what is seen, so that no cap shows where it is cut.
fn within_reach(a: vec2f, b: vec2f, reach_px: f32) -> vec2f {
    let window = window();
    let low = window.low_px - reach_px;
    let high = window.high_px + reach_px;
    let along = b - a;
    var part = vec2f(0.0, 1.0);
    for (var axis = 0u; axis < 2u; axis++) {
        if along[axis] == 0.0 {
            if a[axis] < low[axis] || a[axis] > high[axis] {
                return vec2f(1.0, 0.0);
            }
        } else {
            let t = (vec2f(low[axis], high[axis]) - a[axis]) / along[axis];
            part.x = max(part.x, min(t.x, t.y));
            part.y = min(part.y, max(t.x, t.y));
        }
    }
    return part;
}

fn emit(slot: u32, rank: u32, a: vec2f, b: vec2f, radius: f32) {
    if slot >= frame.line_room {
        return;
    }
    let part = within_reach(a, b, radius + 1.0);
    if part.x > part.y {
        line_ranks[slot] = NO_RANK;
        return;
    }
    // Ends inside stay as they are, to the bit.
    let start = select(a, a + (b - a) * part.x, part.x > 0.0);
    let end = select(b, a + (b - a) * part.y, part.y < 1.0);
    let line = vec4f(start, end);
    lines_px[slot] = line;
    line_ranks[slot] = rank;
    let reach = radius + MARGIN_PX;
    let rows = rows_of(line, reach);
    for (var row = rows.x; row < rows.y; row++) {
        let columns = columns_of(line, reach, row);
        for (var column = columns.x; column < columns.y; column++) {
            let tile = tile_index(row, column);
            if chunk.round < 2u || !is_full(tile) {
                atomicAdd(&counts[tile], 1u);
            }
        }
    }
}

fn emit_all(first_slot: u32, rank: u32, curve: Curve, segments: u32, ends: u32, radius: f32) {
    var slot = first_slot;
    var first = 0u;
    var a = vertex_px(curve, 0u);
    while first < segments {
        let count = firstTrailingBit(ends >> first) + 1u;
        let last = vertex_px(curve, first + count);
        if count == 1u {
            let steps = steps_of(curve, first);
            for (var step = 1u; step < steps; step++) {
                let b = point_px(curve, first, f32(step) / f32(steps));
                emit(slot, rank, a, b, radius);
                slot++;
                a = b;
            }
        }
        emit(slot, rank, a, last, radius);
        slot++;
        a = last;
        first += count;
    }
}

// Brings the control points of a cluster to the picture.
fn load(cluster: Cluster, thread: u32) {
    let offset = offset_m(cluster);
    for (var i = thread; i < cluster.points; i += STROKES) {
        points_px[i] = pixel_from_view(points_m[cluster.first_point + i] + offset);
    }
}

@compute @workgroup_size(STROKES)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    if thread == 0u {
        clusters_seen = atomicLoad(&found.counters.clusters);
    }
    let all = workgroupUniformLoad(&clusters_seen);
    for (var i = workgroup_index(id, count); i < all; i += count.x * count.y) {
        let index = found.seen[i];
        let cluster = clusters[index];
        let is_of_round = chunk.round == 0u || (index % STRIDE == 0u) == (chunk.round == 1u);
        let is_here = index >= chunk.first_cluster && index < chunk.end_cluster && is_of_round;
        if is_here {
            load(cluster, thread);
        }
        if thread == 0u {
            atomicStore(&group_lines, 0u);
            atomicStore(&group_drawn, 0u);
        }
        workgroupBarrier();
        var plan = Plan(0u, 0u);
        var curve: Curve;
        var rank = 0u;
        var segments = 0u;
        var radius = 0.0;
        if is_here && thread < cluster.strokes {
            let stroke = strokes[cluster.first_stroke + thread];
            rank = stroke.rank;
            curve = Curve(first_point_of(stroke));
            segments = segments_of(stroke);
            radius = radius_of(rank);
            let box = box_of(curve, segments);
            if segments > 0u && is_seen(box.xy, box.zw, radius + 1.0) {
                if chunk.round < 2u || !is_hidden(box, radius + MARGIN_PX) {
                    plan = plan_of(curve, segments);
                }
                if (stroke.extent & WHOLE_PATH) != 0u {
                    atomicAdd(&group_drawn, 1u);
                }
            }
        }
        let before = atomicAdd(&group_lines, plan.lines);
        workgroupBarrier();
        if thread == 0u {
            first_line = atomicAdd(&found.counters.lines, atomicLoad(&group_lines));
            atomicAdd(&found.counters.drawn, atomicLoad(&group_drawn));
        }
        let first = workgroupUniformLoad(&first_line);
        if plan.lines > 0u {
            emit_all(first + before, rank, curve, segments, plan.ends, radius);
        }
        workgroupBarrier();
    }
}
