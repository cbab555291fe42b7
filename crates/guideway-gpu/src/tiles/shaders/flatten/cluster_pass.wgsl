// Decides which clusters and strokes a flatten dispatch draws, and reserves their lines.

// import: flatten/bindings.wgsl
// import: flatten/curve.wgsl
// import: flatten/occlusion_test.wgsl
// import: cache/line_blocks.wgsl

// True if the whole cluster lies inside the LOD, so that no line needs clipping.
var<private> is_inside: bool;

// Reserves lines of a cluster, and returns the first. Cached lines get a block header before them.
fn reserve_lines(cluster: u32, count: u32) -> u32 {
    count_atomics(1u);
    if frame.caches_lines == 0u {
        return frame.first_line + atomicAdd(&counters.totals.lines, count);
    }
    let head = frame.first_line + atomicAdd(&counters.totals.lines, count + 1u);
    if head < frame.line_capacity {
        lines[head * LINE_WORDS] = NO_LINE;
        let previous = atomicExchange(&counters.clusters[cluster].block, head + 1u);
        lines[head * LINE_WORDS + 1u] = previous;
        lines[head * LINE_WORDS + 2u] = count;
    }
    return head + 1u;
}

// Returns whether all strokes of a cluster lie inside the window.
fn is_inside_window(cluster: Cluster, box: vec4f) -> bool {
    let reach = lod_reach(cluster_radius_px(cluster));
    return all(box.xy - reach >= frame.window_low_px)
        && all(box.zw + reach <= frame.window_high_px);
}

// A cluster of this dispatch: is_here is false if another dispatch draws it.
struct ClusterSelection {
    is_here: bool,
    first_point: u32,
}

// Selects the clusters of this dispatch. Counts a cluster without exact points if one is needed.
fn select_cluster(cluster: Cluster, index: u32, reports_missing: bool) -> ClusterSelection {
    let is_first = index % FIRST_PASS_STRIDE == 0u;
    let is_of_pass = dispatch.occlusion_pass == 0u || is_first == (dispatch.occlusion_pass == 1u);
    let is_near = cluster.step_m > frame.max_step_m;
    let is_here = index >= dispatch.first_cluster && index < dispatch.end_cluster && is_of_pass
        && is_near == (dispatch.is_near != 0u);
    if !is_here {
        return ClusterSelection(false, 0u);
    }
    let first_point = cluster_first_point(cluster, index);
    let has_points = !is_near || first_point != 0u;
    if !has_points && reports_missing {
        atomicAdd(&counters.totals.missing_clusters, 1u);
    }
    return ClusterSelection(has_points, first_point);
}

// Returns the box of a cluster, and sets whether its lines need clipping.
fn locate_cluster(cluster: Cluster) -> vec4f {
    let box = cluster_box_px(cluster);
    is_inside = all(abs(box.xy) < frame.lod_reach_px) && all(abs(box.zw) < frame.lod_reach_px);
    return box;
}

// A stroke may touch the window without being flattened, and the other way round.
struct StrokeVisibility {
    is_drawn_here: bool,
    is_flattened: bool,
}

fn stroke_visibility(
    cluster: Cluster,
    all_box: vec4f,
    curve: Curve,
    segments: u32,
    radius: f32,
) -> StrokeVisibility {
    let has_any = segments > 0u;
    if dispatch.occlusion_pass < 2u && is_inside_window(cluster, all_box) {
        return StrokeVisibility(has_any, has_any);
    }
    let box = control_box(curve, segments);
    let reach = lod_reach(radius);
    let is_drawn_here = has_any && intersects_window(box, reach);
    if dispatch.occlusion_pass < 2u {
        return StrokeVisibility(is_drawn_here, has_any && intersects_flatten_area(box, reach));
    }
    let box_px = vec4f(px_from_lod(box.xy), px_from_lod(box.zw));
    let is_flattened = is_drawn_here && !is_occluded(box_px, radius + ROUNDING_MARGIN_PX);
    return StrokeVisibility(is_drawn_here, is_flattened);
}
