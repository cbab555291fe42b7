// Flattens the strokes of visible clusters to lines, and counts the lines per tile.
//
// Bindings: frame, dispatch, points, strokes, clusters, styles -> counters, lines, line_ranks,
// tile_counts. A workgroup takes one cluster after the other. A thread first subdivides one stroke,
// then writes every THREADS-th line of the cluster:
//
//     stroke      0         1    2              one thread each: subdivide, count lines
//     lines     | 0 1 2 3 | 4 5 | 6 7 8 |       prefix sum of the counts
//     threads     0 1 2 3   4 5   6 7 8         one thread each: bisect for the stroke, write
//
// If few clusters are visible, up to 2^MAX_PARTS_LOG2 workgroups share a cluster's lines.

// import: flatten/emit_line.wgsl
// import: flatten/subdivision.wgsl
// import: shared/workgroup_scan.wgsl

// Strokes per cluster.
override THREADS: u32;

// Most workgroups per cluster (log2), and the number of workgroups to aim for. MAX_PARTS_LOG2 = 0
// needs fewer registers, so that more workgroups run.
override MAX_PARTS_LOG2: u32;
override TARGET_WORKGROUPS: u32;

// Parts of clusters that workgroups take.
var<workgroup> part_count: u32;
// Workgroups per cluster (log2). In workgroup memory because a register would lower the occupancy.
var<workgroup> parts_log2: u32;
var<workgroup> drawn_paths: atomic<u32>;
var<workgroup> first_line: u32;
// Strokes of the cluster; `scan_ends` holds the number of lines up to the end of each.
var<workgroup> planned_strokes: array<PlannedStroke, THREADS>;

struct PlannedStroke {
    first_point: u32,
    extent: u32,
    rank: u32,
    pieces: Subdivision,
}

// Writes the lines with these numbers, one thread per line.
fn emit_lines(thread: u32, any: Curve, numbers: vec2u, first_slot: u32) {
    var curve = any;
    for (var line = numbers.x + thread; line < numbers.y; line += THREADS) {
        // The first stroke that ends behind the line.
        var stroke = 0u;
        for (var half = THREADS / 2u; half > 0u; half /= 2u) {
            stroke += select(0u, half, scan_ends[stroke + half - 1u] <= line);
        }
        let it = planned_strokes[stroke];
        curve.first_point = it.first_point;
        let number = it.pieces.lines + line - scan_ends[stroke];
        let part = locate_line(curve, it.pieces, number);
        let a = line_end_px(curve, part, part.step);
        let b = line_end_px(curve, part, part.step + 1u);
        let ends = vec2<bool>(
            number == 0u && (it.extent & PATH_START) != 0u,
            number + 1u == it.pieces.lines && (it.extent & PATH_END) != 0u,
        );
        emit_line(first_slot + line - numbers.x, it.rank, a, b, ends, radius_of(it.rank));
    }
}

// The part of its cluster's lines that workgroup i writes.
fn cluster_part(i: u32) -> u32 {
    return i & ((1u << parts_log2) - 1u);
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    if thread == 0u {
        let visible = visible_cluster_count();
        let parts = clamp(TARGET_WORKGROUPS / max(visible, 1u), 1u, 1u << MAX_PARTS_LOG2);
        parts_log2 = firstLeadingBit(parts);
        part_count = visible << parts_log2;
    }
    let parts = workgroupUniformLoad(&part_count);
    for (var i = workgroup_index(id, count); i < parts; i += count.x * count.y) {
        let index = visible_cluster(i >> parts_log2);
        let cluster = clusters[index];
        count_reads(1u + CLUSTER_WORDS);
        let selection = select_cluster(cluster, index, thread == 0u && cluster_part(i) == 0u);
        let is_here = selection.is_here && thread < cluster.strokes;
        var stroke = Stroke(0u, 0u);
        if is_here {
            stroke = strokes[cluster.first_stroke + thread];
            count_reads(2u);
        }
        if thread == 0u {
            atomicStore(&drawn_paths, 0u);
        }
        workgroupBarrier();
        let curve = stroke_curve(cluster, selection.first_point + first_point_of(stroke));
        let all_box = locate_cluster(cluster);
        var pieces = Subdivision(0u, 0u, 0u);
        if is_here {
            let segments = segments_of(stroke);
            let need = stroke_visibility(cluster, all_box, curve, segments, radius_of(stroke.rank));
            if need.is_flattened {
                pieces = subdivide(curve, segments);
            }
            if need.is_drawn_here && (stroke.extent & WHOLE_PATH) != 0u {
                atomicAdd(&drawn_paths, 1u);
            }
        }
        let planned = PlannedStroke(curve.first_point, stroke.extent, stroke.rank, pieces);
        planned_strokes[thread] = planned;
        workgroup_scan(thread, pieces.lines);
        let part = cluster_part(i);
        let numbers = (scan_ends[THREADS - 1u] * vec2u(part, part + 1u)) >> vec2u(parts_log2);
        if thread == 0u {
            if numbers.x < numbers.y {
                first_line = reserve_lines(index, numbers.y - numbers.x);
            }
            if part == 0u {
                atomicAdd(&counters.totals.drawn_paths, atomicLoad(&drawn_paths));
                count_atomics(1u);
            }
        }
        emit_lines(thread, curve, numbers, workgroupUniformLoad(&first_line));
        workgroupBarrier();
    }
    report_work();
}
