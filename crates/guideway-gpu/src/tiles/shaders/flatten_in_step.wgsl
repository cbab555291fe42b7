// Turns curves into lines on a processor: as many threads as run in step take as many strokes of a cluster, and then as many lines of
// these at a time. They see each other's values, and wait for nobody.

override THREADS: u32;

// Workgroups that share a cluster of 64 strokes, as a power of two.
const PARTS_BITS: u32 = 3u;
const MOST_PIECES: u32 = 32u;

var<workgroup> clusters_seen: u32;
// How many lines there are up to the end of each piece, of the stroke of each lane.
var<workgroup> piece_ends: array<u32, LANES * MOST_PIECES>;
// Where those of this lane begin.
var<private> first_piece: u32;

fn with_piece(plan: Plan, last: u32, segments: u32, square_bend: f32) -> Plan {
    let lines = plan.lines + lines_of_piece(segments, square_bend);
    piece_ends[first_piece + countOneBits(plan.ends)] = lines;
    return Plan(plan.ends | (1u << last), lines, 0u);
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
    first_piece = lane * MOST_PIECES;
    if lane == 0u {
        clusters_seen = clusters_of_kind();
    }
    let groups = workgroupUniformLoad(&clusters_seen) << PARTS_BITS;
    for (var i = workgroup_index(id, count); i < groups; i += count.x * count.y) {
        let index = cluster_of_kind(i >> PARTS_BITS);
        let cluster = clusters[index];
        reads(1u + CLUSTER_WORDS);
        let number = (i & ((1u << PARTS_BITS) - 1u)) * LANES + lane;
        let take = taken(cluster, index, number == 0u);
        let is_here = take.is_here && number < cluster.strokes;
        var stroke = Stroke(0u, 0u);
        if is_here {
            stroke = strokes[cluster.first_stroke + number];
            reads(2u);
        }
        let curve = curve_of(cluster, take.first_point + first_point_of(stroke));
        let all_box = look_at(cluster);
        let segments = segments_of(stroke);
        let radius = radius_of(stroke.rank);
        let need = need_of(cluster, all_box, curve, segments, radius);
        var plan = Plan(0u, 0u, 0u);
        if need.is_needed {
            plan = plan_of(curve, segments);
        }
        workgroupBarrier();
        let drawn = subgroupAdd(select(0u, 1u, need.is_there && (stroke.extent & WHOLE_PATH) != 0u));
        if lane == 0u {
            atomicAdd(&found.counters.drawn, drawn);
            atomics(1u);
        }
        emit_all(lane, curve, plan, stroke.rank, radius, index);
        workgroupBarrier();
    }
    report_work();
}
