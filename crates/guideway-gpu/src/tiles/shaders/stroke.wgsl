// A stroke: part of a path, a run of at most 32 segments of a uniform cubic B-spline.

struct Stroke {
    // Its first control point, counted from its cluster's first, and from bit 16 on its segments; none if it is
    // not drawn. The highest bit is set if the stroke is a whole path.
    extent: u32,
    // Draw rank of its path.
    rank: u32,
}

const WHOLE_PATH: u32 = 0x80000000u;

fn first_point_of(stroke: Stroke) -> u32 {
    return stroke.extent & 0xffffu;
}

fn segments_of(stroke: Stroke) -> u32 {
    return (stroke.extent & ~WHOLE_PATH) >> 16u;
}
