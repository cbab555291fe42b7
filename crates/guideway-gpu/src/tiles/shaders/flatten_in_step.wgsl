// Turns curves into lines on a processor: as many threads as run in step take as many strokes of a cluster, and then as many lines of
// these at a time. They see each other's values, and wait for nobody.

override THREADS: u32;

const LANES: u32 = 8u;
// Workgroups that share a cluster of 64 strokes, as a power of two.
const PARTS_BITS: u32 = 3u;
const MOST_PIECES: u32 = 32u;

struct Thread {
    @builtin(subgroup_invocation_id) lane: u32,
}

// How many lines there are up to the end of each piece, of the stroke of each lane.
var<workgroup> clusters_seen: u32;
var<workgroup> piece_ends: array<u32, LANES * MOST_PIECES>;

fn lines_of_piece(segments: u32, square_bend: f32) -> u32 {
    return select(1u, steps_of(square_bend), segments == 1u);
}

// As `plan_of`, but all pieces tell how many lines they have.
fn plan_in_step(lane: u32, curve: Curve, segments: u32) -> Plan {
    var plan = Plan(0u, 0u, 0u);
    var end = lane * MOST_PIECES;
    var first = control_px(curve, 1u);
    var second = control_px(curve, 2u);
    var before = square_bend_of(control_px(curve, 0u), first, second);
    var piece = 0u;
    var worst = before;
    var segment = 0u;
    loop {
        let third = control_px(curve, segment + 3u);
        let bend = square_bend_of(first, second, third);
        first = second;
        second = third;
        if piece > 0u && !is_flat(piece + 1u, max(worst, bend)) {
            plan.ends |= 1u << (segment - 1u);
            plan.lines += lines_of_piece(piece, worst);
            piece_ends[end] = plan.lines;
            end++;
            piece = 0u;
            worst = before;
        }
        piece++;
        worst = max(worst, bend);
        before = bend;
        segment++;
        if segment >= segments {
            break;
        }
    }
    plan.ends |= 1u << (segments - 1u);
    plan.lines += lines_of_piece(piece, worst);
    piece_ends[end] = plan.lines;
    return plan;
}

// The line of that number, of the stroke of a lane.
fn part_in_step(owner: u32, ends: u32, number: u32) -> Part {
    var first = 0u;
    var before = 0u;
    var piece = owner * MOST_PIECES;
    loop {
        let end = piece_ends[piece];
        if number < end {
            break;
        }
        before = end;
        first += firstTrailingBit(ends >> first) + 1u;
        piece++;
    }
    // Read again: Mesa's llvmpipe loses what a thread has read in a loop that others go on with.
    return Part(first, firstTrailingBit(ends >> first) + 1u, number - before, piece_ends[piece] - before);
}

// As `joint_px`, to the bit, without branches.
fn joint_in_step(curve: Curve, part: Part, step: u32) -> vec2f {
    let is_end = step == part.steps;
    let segment = part.first + select(0u, part.segments, is_end);
    let t = select(f32(step) / f32(part.steps), 0.0, is_end);
    let a = control_px(curve, segment);
    let b = control_px(curve, segment + 1u);
    let c = control_px(curve, segment + 2u);
    // There is none behind the end of a stroke, nor is it needed there.
    let d = control_px(curve, segment + select(3u, 2u, is_end));
    return mixed_px(a, b, c, d, t);
}

// Turns the strokes of all lanes into lines.
fn emit_all(lane: u32, own: Curve, plan: Plan, rank: u32, radius: f32, index: u32) {
    let end = subgroupInclusiveAdd(plan.lines);
    let all = subgroupMax(end);
    var slot = 0u;
    if lane == 0u && all > 0u {
        slot = room_for(index, all);
    }
    slot = subgroupBroadcastFirst(slot);
    var curve = own;
    var line = lane;
    loop {
        var owner = 0u;
        for (var half = LANES / 2u; half > 0u; half /= 2u) {
            owner += select(0u, half, subgroupShuffle(end, owner + half - 1u) <= line);
        }
        curve.first_point = subgroupShuffle(own.first_point, owner);
        let number = line - subgroupShuffle(end - plan.lines, owner);
        let ends = subgroupShuffle(plan.ends, owner);
        let line_rank = subgroupShuffle(rank, owner);
        let line_radius = subgroupShuffle(radius, owner);
        if line < all {
            let part = part_in_step(owner, ends, number);
            let a = joint_in_step(curve, part, part.step);
            let b = joint_in_step(curve, part, part.step + 1u);
            emit(slot + line, line_rank, a, b, line_radius);
        }
        line += LANES;
        if line - lane >= all {
            break;
        }
    }
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    own: Thread,
) {
    let lane = own.lane;
    if lane == 0u {
        clusters_seen = clusters_of_kind();
    }
    let groups = workgroupUniformLoad(&clusters_seen) << PARTS_BITS;
    for (var i = workgroup_index(id, count); i < groups; i += count.x * count.y) {
        let index = cluster_of_kind(i >> PARTS_BITS);
        let cluster = clusters[index];
        reads(1u + CLUSTER_WORDS);
        let number = (i & ((1u << PARTS_BITS) - 1u)) * LANES + lane;
        let is_of_round = chunk.round == 0u || (index % STRIDE == 0u) == (chunk.round == 1u);
        let is_near = cluster.step_m > frame.most_step_m;
        var is_here = index >= chunk.first_cluster && index < chunk.end_cluster && is_of_round
            && is_near == (chunk.is_near != 0u);
        var first_point = 0u;
        if is_here {
            first_point = first_point_of_cluster(cluster, index);
            is_here = !is_near || first_point != 0u;
            if !is_here && number == 0u {
                atomicAdd(&found.counters.missing, 1u);
            }
        }
        is_here = is_here && number < cluster.strokes;
        var stroke = Stroke(0u, 0u);
        if is_here {
            stroke = strokes[cluster.first_stroke + number];
            reads(2u);
        }
        let curve = curve_of(cluster, first_point + first_point_of(stroke));
        let all_box = box_px(cluster);
        is_inside = all(abs(all_box.xy) < frame.reach_px) && all(abs(all_box.zw) < frame.reach_px);
        let segments = segments_of(stroke);
        let radius = radius_of(stroke.rank);
        var is_there = segments > 0u;
        var is_needed = is_there;
        if is_there && (chunk.round == 2u || !is_all_drawn(cluster, all_box)) {
            let box = box_of(curve, segments);
            let reach = reach_of(radius);
            is_there = is_drawn(box, reach);
            if chunk.round < 2u {
                is_needed = is_made(box, reach);
            } else {
                let box_px = vec4f(px_from_level(box.xy), px_from_level(box.zw));
                is_needed = is_there && !is_hidden(box_px, radius + MARGIN_PX);
            }
        }
        var plan = Plan(0u, 0u, 0u);
        if is_needed {
            plan = plan_in_step(lane, curve, segments);
        }
        workgroupBarrier();
        let drawn = subgroupAdd(select(0u, 1u, is_there && (stroke.extent & WHOLE_PATH) != 0u));
        if lane == 0u {
            atomicAdd(&found.counters.drawn, drawn);
            atomics(1u);
        }
        emit_all(lane, curve, plan, stroke.rank, radius, index);
        workgroupBarrier();
    }
    report_work();
}
