// Looks up the style and the draw rank of lines.
// The importing shader binds `styles: array<Style>` and `line_ranks: array<u32>`.

// import: shared/frame.wgsl
// import: shared/work_counts.wgsl
// import: shared/view.wgsl

struct Style {
    // RGBA, red in the lowest byte.
    color: u32,
    // Negative: the path has no width of its own.
    width_m: f32,
}

fn style_of(rank: u32) -> Style {
    count_reads(2u);
    return styles[min(rank, frame.styles - 1u)];
}

// Radius of a path in picture pixels.
fn radius_of(rank: u32) -> f32 {
    if frame.max_radius_px < 0.0 {
        return frame.radius_px;
    }
    return radius_px(style_of(rank).width_m);
}

// Draw rank of a line; 0 if all paths look alike.
fn rank_of(line: u32) -> u32 {
    if frame.has_ranks == 0u {
        return 0u;
    }
    count_reads(1u);
    return line_ranks[line];
}
