// A stroke: part of a path, at most 32 segments of a uniform cubic B-spline. Rust: `Stroke`.

struct Stroke {
    // Bits 0-15: first control point, relative to its cluster. Bits 16-30: number of segments, 0 if
    // hidden. Bit 31: the stroke is a whole path.
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
