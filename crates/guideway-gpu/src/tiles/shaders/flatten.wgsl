// A workgroup for one cluster after the other, a thread a stroke and then a thread a line: turns curves into
// lines, and counts how many touch each tile.

override STROKES: u32;

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
@group(0) @binding(7) var<storage, read_write> lines_px: array<vec4f>;
@group(0) @binding(8) var<storage, read_write> line_ranks: array<u32>;
@group(0) @binding(9) var<storage, read_write> counts: array<atomic<u32>>;

var<workgroup> clusters_seen: u32;
var<workgroup> group_drawn: atomic<u32>;
var<workgroup> first_line: u32;
// The strokes of the cluster, and how many lines there are up to the end of each.
var<workgroup> planned: array<Planned, STROKES>;
var<workgroup> line_ends: array<u32, STROKES>;

struct Planned {
    first_point: u32,
    rank: u32,
    plan: Plan,
}

// Whether all of the cluster is inside what is drawn, so that nothing of it needs to be cut.
var<private> is_inside: bool;

fn emit(slot: u32, rank: u32, a: vec2f, b: vec2f, radius: f32) {
    if slot >= frame.line_room {
        return;
    }
    var line = vec4f(a, b);
    if !is_inside {
        let part = within_reach(a, b, radius + 1.0);
        if part.x > part.y {
            line_ranks[slot] = NO_RANK;
            writes(1u);
            return;
        }
        // Ends inside stay as they are, to the bit.
        line = vec4f(
            select(a, a + (b - a) * part.x, part.x > 0.0),
            select(b, a + (b - a) * part.y, part.y < 1.0),
        );
    }
    let reach = radius + MARGIN_PX;
    let rows = rows_of(line, reach);
    var is_needed = false;
    for (var row = rows.x; row < rows.y; row++) {
        let columns = columns_of(line, reach, row);
        for (var column = columns.x; column < columns.y; column++) {
            let tile = tile_index(row, column);
            if chunk.round < 2u || !is_full(tile) {
                atomicAdd(&counts[tile], 1u);
                atomics(1u);
                is_needed = true;
            }
        }
    }
    if is_needed {
        lines_px[slot] = line;
        writes(4u);
    }
    writes(1u);
    line_ranks[slot] = select(NO_RANK, rank, is_needed);
}

// Turns the strokes of the workgroup into lines, a thread a line.
fn emit_all(thread: u32, any: Curve, first_slot: u32) {
    var curve = any;
    let all = line_ends[STROKES - 1u];
    for (var line = thread; line < all; line += STROKES) {
        // The first stroke that ends behind it.
        var stroke = 0u;
        for (var half = STROKES / 2u; half > 0u; half /= 2u) {
            stroke += select(0u, half, line_ends[stroke + half - 1u] <= line);
        }
        let it = planned[stroke];
        curve.first_point = it.first_point;
        let part = part_of(curve, it.plan, it.plan.lines + line - line_ends[stroke]);
        let a = joint_px(curve, part, part.step);
        let b = joint_px(curve, part, part.step + 1u);
        emit(first_slot + line, it.rank, a, b, radius_of(it.rank));
    }
}

// Sums up how many lines there are before and in each stroke.
fn add_up(thread: u32, lines: u32) {
    line_ends[thread] = lines;
    workgroupBarrier();
    for (var step = 1u; step < STROKES; step *= 2u) {
        var more = 0u;
        if thread >= step {
            more = line_ends[thread - step];
        }
        workgroupBarrier();
        line_ends[thread] += more;
        workgroupBarrier();
    }
}

// Whether all of a cluster is inside what is drawn.
fn holds(cluster: Cluster) -> bool {
    let box = box_px(cluster);
    let reach_px = widest_px(cluster) + 1.0;
    let window = window();
    return all(box.xy - reach_px >= window.low_px) && all(box.zw + reach_px <= window.high_px);
}

@compute @workgroup_size(STROKES)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    if thread == 0u {
        clusters_seen = clusters_of_kind();
    }
    let all = workgroupUniformLoad(&clusters_seen);
    for (var i = workgroup_index(id, count); i < all; i += count.x * count.y) {
        let index = cluster_of_kind(i);
        let cluster = clusters[index];
        reads(1u + CLUSTER_WORDS);
        let is_of_round = chunk.round == 0u || (index % STRIDE == 0u) == (chunk.round == 1u);
        let is_near = cluster.step_m > frame.most_step_m;
        var is_here = index >= chunk.first_cluster && index < chunk.end_cluster && is_of_round
            && is_near == (chunk.is_near != 0u);
        var first_point = 0u;
        if is_here {
            first_point = first_point_of_cluster(cluster, index);
            is_here = !is_near || first_point != 0u;
            if !is_here && thread == 0u {
                atomicAdd(&found.counters.missing, 1u);
            }
        }
        var stroke = Stroke(0u, 0u);
        if is_here {
            if thread < cluster.strokes {
                stroke = strokes[cluster.first_stroke + thread];
                reads(2u);
            }
            is_inside = holds(cluster);
        }
        if thread == 0u {
            atomicStore(&group_drawn, 0u);
        }
        workgroupBarrier();
        let curve = curve_of(cluster, first_point + first_point_of(stroke));
        var plan = Plan(0u, 0u, 0u);
        if is_here && thread < cluster.strokes {
            let segments = segments_of(stroke);
            let radius = radius_of(stroke.rank);
            var is_drawn = segments > 0u;
            var is_needed = true;
            if !is_inside || chunk.round == 2u {
                let box = box_of(curve, segments);
                is_drawn = is_drawn && is_seen(box.xy, box.zw, radius + 1.0);
                is_needed = chunk.round < 2u || !is_hidden(box, radius + MARGIN_PX);
            }
            if is_drawn {
                if is_needed {
                    plan = plan_of(curve, segments);
                }
                if (stroke.extent & WHOLE_PATH) != 0u {
                    atomicAdd(&group_drawn, 1u);
                }
            }
        }
        planned[thread] = Planned(curve.first_point, stroke.rank, plan);
        add_up(thread, plan.lines);
        if thread == 0u {
            first_line = atomicAdd(&found.counters.lines, line_ends[STROKES - 1u]);
            atomicAdd(&found.counters.drawn, atomicLoad(&group_drawn));
            atomics(2u);
        }
        emit_all(thread, curve, workgroupUniformLoad(&first_line));
        workgroupBarrier();
    }
    report_work();
}
