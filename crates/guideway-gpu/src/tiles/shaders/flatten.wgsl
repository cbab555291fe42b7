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
        let take = taken(cluster, index, thread == 0u && part_of_cluster(i) == 0u);
        let is_here = take.is_here && thread < cluster.strokes;
        var stroke = Stroke(0u, 0u);
        if is_here {
            stroke = strokes[cluster.first_stroke + thread];
            reads(2u);
        }
        if thread == 0u {
            atomicStore(&group_drawn, 0u);
        }
        workgroupBarrier();
        let curve = curve_of(cluster, take.first_point + first_point_of(stroke));
        let all_box = look_at(cluster);
        var plan = Plan(0u, 0u, 0u);
        if is_here {
            let segments = segments_of(stroke);
            let need = need_of(cluster, all_box, curve, segments, radius_of(stroke.rank));
            if need.is_needed {
                plan = plan_of(curve, segments);
            }
            if need.is_there && (stroke.extent & WHOLE_PATH) != 0u {
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
