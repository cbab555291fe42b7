// A workgroup for one cluster after the other, a thread a stroke and then a thread a line: turns curves into
// lines, and counts how many touch each tile. Of few clusters, seen from near and of many lines each, several
// workgroups make a part of the lines each.

// One a stroke of a cluster.
override THREADS: u32;

// Most workgroups for one cluster, as a power of two, and how many are enough for all of them together. Where it is none, a
// thread has less to keep, and more of them run.
override MOST_PARTS_BITS: u32;
override ENOUGH_GROUPS: u32;

var<workgroup> clusters_seen: u32;
// How many workgroups each cluster has. Held here, for a thread that keeps it leaves room for fewer others.
var<workgroup> parts_bits: u32;
var<workgroup> group_drawn: atomic<u32>;
var<workgroup> first_line: u32;
// The strokes of the cluster: `ends` has how many lines there are up to the end of each.
var<workgroup> planned: array<Planned, THREADS>;

struct Planned {
    first_point: u32,
    rank: u32,
    plan: Plan,
}

// Turns strokes into lines, those of the numbers between two, a thread a line.
fn emit_all(thread: u32, any: Curve, numbers: vec2u, first_slot: u32) {
    var curve = any;
    for (var line = numbers.x + thread; line < numbers.y; line += THREADS) {
        // The first stroke that ends behind it.
        var stroke = 0u;
        for (var half = THREADS / 2u; half > 0u; half /= 2u) {
            stroke += select(0u, half, ends[stroke + half - 1u] <= line);
        }
        let it = planned[stroke];
        curve.first_point = it.first_point;
        let part = part_of(curve, it.plan, it.plan.lines + line - ends[stroke]);
        let a = joint_px(curve, part, part.step);
        let b = joint_px(curve, part, part.step + 1u);
        emit(first_slot + line - numbers.x, it.rank, a, b, radius_of(it.rank));
    }
}

// Which part of its cluster's lines a workgroup makes.
fn part_of_cluster(i: u32) -> u32 {
    return i & ((1u << parts_bits) - 1u);
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    if thread == 0u {
        clusters_seen = clusters_of_kind();
        let parts = clamp(ENOUGH_GROUPS / max(clusters_seen, 1u), 1u, 1u << MOST_PARTS_BITS);
        parts_bits = firstLeadingBit(parts);
    }
    let groups = workgroupUniformLoad(&clusters_seen) << parts_bits;
    for (var i = workgroup_index(id, count); i < groups; i += count.x * count.y) {
        let index = cluster_of_kind(i >> parts_bits);
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
            if !is_here && thread == 0u && part_of_cluster(i) == 0u {
                atomicAdd(&found.counters.missing, 1u);
            }
        }
        var stroke = Stroke(0u, 0u);
        if is_here && thread < cluster.strokes {
            stroke = strokes[cluster.first_stroke + thread];
            reads(2u);
        }
        if thread == 0u {
            atomicStore(&group_drawn, 0u);
        }
        workgroupBarrier();
        let curve = curve_of(cluster, first_point + first_point_of(stroke));
        let all_box = box_px(cluster);
        is_inside = all(abs(all_box.xy) < frame.reach_px) && all(abs(all_box.zw) < frame.reach_px);
        var plan = Plan(0u, 0u, 0u);
        if is_here && thread < cluster.strokes {
            let segments = segments_of(stroke);
            let radius = radius_of(stroke.rank);
            var is_there = segments > 0u;
            var is_needed = is_there;
            if chunk.round == 2u || !is_all_drawn(cluster, all_box) {
                let box = box_of(curve, segments);
                let reach = reach_of(radius);
                is_there = is_there && is_drawn(box, reach);
                if chunk.round < 2u {
                    is_needed = is_needed && is_made(box, reach);
                } else {
                    let box_px = vec4f(px_from_level(box.xy), px_from_level(box.zw));
                    is_needed = is_there && !is_hidden(box_px, radius + MARGIN_PX);
                }
            }
            if is_needed {
                plan = plan_of(curve, segments);
            }
            if is_there && (stroke.extent & WHOLE_PATH) != 0u {
                atomicAdd(&group_drawn, 1u);
            }
        }
        planned[thread] = Planned(curve.first_point, stroke.rank, plan);
        add_up(thread, plan.lines);
        let part = part_of_cluster(i);
        let numbers = (ends[THREADS - 1u] * vec2u(part, part + 1u)) >> vec2u(parts_bits);
        if thread == 0u {
            if numbers.x < numbers.y {
                first_line = room_for(index, numbers.y - numbers.x);
            }
            if part == 0u {
                atomicAdd(&found.counters.drawn, atomicLoad(&group_drawn));
                atomics(1u);
            }
        }
        emit_all(thread, curve, numbers, workgroupUniformLoad(&first_line));
        workgroupBarrier();
    }
    report_work();
}
