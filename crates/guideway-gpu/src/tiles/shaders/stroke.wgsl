// A stroke: part of a path, a run of at most 32 segments of a uniform cubic B-spline.

struct Stroke {
    first_point: u32,
    // Number of segments; the highest bit is set if the stroke is a whole path.
    segments: u32,
    // Draw rank of its path.
    rank: u32,
    // As in the picture's bytes, red first.
    color: u32,
    // Below zero if it has no width of its own.
    width_m: f32,
    padding: u32,
}

const WHOLE_PATH: u32 = 0x80000000u;

// Stands for the stroke of a line that is out of sight.
const NO_STROKE: u32 = 0xffffffffu;
