// A stroke: part of a path, at most 32 segments of a uniform cubic B-spline. Rust: `Stroke`.

struct Stroke {
    // Bits 0-15: first control point, relative to its cluster. Bits 16-27: number of segments.
    // Bits 28-31: flags.
    extent: u32,
    // Draw rank of its path.
    rank: u32,
}

// The stroke is a whole path.
const WHOLE_PATH: u32 = 0x80000000u;
// An open path begins or ends with the stroke.
const PATH_START: u32 = 0x40000000u;
const PATH_END: u32 = 0x20000000u;
// The path is hidden.
const HIDDEN_STROKE: u32 = 0x10000000u;
const MAX_SEGMENTS: u32 = 0xfffu;

fn first_point_of(stroke: Stroke) -> u32 {
    return stroke.extent & 0xffffu;
}

fn segments_of(stroke: Stroke) -> u32 {
    if (stroke.extent & HIDDEN_STROKE) != 0u {
        return 0u;
    }
    return (stroke.extent >> 16u) & MAX_SEGMENTS;
}
