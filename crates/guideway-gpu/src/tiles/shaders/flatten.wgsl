// A workgroup for one cluster after the other, a thread a stroke: turns curves into lines, and counts how
// many touch each tile.

@group(0) @binding(2) var<storage, read> strokes: array<Stroke>;
@group(0) @binding(3) var<storage, read> clusters: array<Cluster>;
@group(0) @binding(4) var<storage, read> seen: array<u32>;
@group(0) @binding(5) var<storage, read_write> found: Found;
@group(0) @binding(6) var<storage, read_write> lines_px: array<vec4f>;
@group(0) @binding(7) var<storage, read_write> line_strokes: array<u32>;
@group(0) @binding(8) var<storage, read_write> counts: array<atomic<u32>>;

var<workgroup> clusters_seen: u32;
var<workgroup> sums: array<u32, STROKES>;
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

// Whether all control points of a stroke, and what is as far around, miss the picture.
fn is_out(curve: Curve, segments: u32, reach_px: f32) -> bool {
    var low = control_px(curve, 0u);
    var high = low;
    for (var i = 1u; i < segments + 3u; i++) {
        let p = control_px(curve, i);
        low = min(low, p);
        high = max(high, p);
    }
    return !is_seen(low, high, reach_px);
}

// The part of a line that is within reach of the picture (Liang and Barsky 1984): from x to y of its length,
// none if x is more than y. It is cut a pixel outside of what is seen, so that no cap shows where it is cut.
fn within_reach(a: vec2f, b: vec2f, reach_px: f32) -> vec2f {
    let low = vec2f(-reach_px);
    let high = vec2f(f32(frame.width_px), f32(frame.height_px)) + reach_px;
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

fn emit(slot: u32, stroke: u32, a: vec2f, b: vec2f, radius: f32) {
    if slot >= frame.line_room {
        return;
    }
    let part = within_reach(a, b, radius + 1.0);
    if part.x > part.y {
        line_strokes[slot] = NO_STROKE;
        return;
    }
    // Ends inside stay as they are, to the bit.
    let start = select(a, a + (b - a) * part.x, part.x > 0.0);
    let end = select(b, a + (b - a) * part.y, part.y < 1.0);
    let line = vec4f(start, end);
    lines_px[slot] = line;
    line_strokes[slot] = stroke;
    let reach = radius + MARGIN_PX;
    let rows = rows_of(line, reach);
    for (var row = rows.x; row < rows.y; row++) {
        let columns = columns_of(line, reach, row);
        for (var column = columns.x; column < columns.y; column++) {
            atomicAdd(&counts[tile_index(row, column)], 1u);
        }
    }
}

fn emit_all(first_slot: u32, stroke: u32, curve: Curve, segments: u32, ends: u32, radius: f32) {
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
                emit(slot, stroke, a, b, radius);
                slot++;
                a = b;
            }
        }
        emit(slot, stroke, a, last, radius);
        slot++;
        a = last;
        first += count;
    }
}

@compute @workgroup_size(STROKES)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    if thread == 0u {
        clusters_seen = atomicLoad(&found.clusters);
    }
    let all = workgroupUniformLoad(&clusters_seen);
    for (var i = workgroup_index(id, count); i < all; i += count.x * count.y) {
        let cluster = seen[i];
        let index = cluster * STROKES + thread;
        var plan = Plan(0u, 0u);
        var curve: Curve;
        var segments = 0u;
        var radius = 0.0;
        if index < frame.strokes {
            let stroke = strokes[index];
            curve = Curve(stroke.first_point, offset_m(clusters[cluster]));
            segments = stroke.segments & ~WHOLE_PATH;
            radius = radius_px(stroke.width_m);
            if !is_out(curve, segments, radius + 1.0) {
                plan = plan_of(curve, segments);
                if (stroke.segments & WHOLE_PATH) != 0u {
                    atomicAdd(&found.drawn, 1u);
                }
            }
        }
        // Inclusive sums over the workgroup (Hillis and Steele 1986).
        sums[thread] = plan.lines;
        workgroupBarrier();
        for (var step = 1u; step < STROKES; step *= 2u) {
            var more = 0u;
            if thread >= step {
                more = sums[thread - step];
            }
            workgroupBarrier();
            sums[thread] += more;
            workgroupBarrier();
        }
        if thread == STROKES - 1u {
            first_line = atomicAdd(&found.lines, sums[thread]);
        }
        let first = workgroupUniformLoad(&first_line);
        if plan.lines > 0u {
            emit_all(first + sums[thread] - plan.lines, index, curve, segments, plan.ends, radius);
        }
        workgroupBarrier();
    }
}
