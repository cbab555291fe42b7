// A leaf: one segment of a curve, the lines between its samples, and their box.

// Lines per segment.
override LINES: u32;

@group(0) @binding(1) var<storage, read> points_m: array<vec2f>;
// Per segment, the index of the first of its four control points, and its draw rank from 1 on.
@group(0) @binding(2) var<storage, read> segments: array<vec2u>;

// Relative to one control point, rounding scales with the segment and not with the scene.
struct Curve {
    base_m: vec2f,
    p0: vec2f,
    p2: vec2f,
    p3: vec2f,
}

fn curve_of(segment: u32) -> Curve {
    let first = segments[segment].x;
    let base_m = points_m[first + 1u];
    return Curve(
        base_m,
        points_m[first] - base_m,
        points_m[first + 2u] - base_m,
        points_m[first + 3u] - base_m,
    );
}

// The point between line `i` and the line before it.
fn end_of_line(curve: Curve, i: u32) -> vec2f {
    return curve.base_m + point(curve.p0, curve.p2, curve.p3, f32(i) / f32(LINES));
}

struct Box {
    low_m: vec2f,
    high_m: vec2f,
}

fn box_of(segment: u32) -> Box {
    let curve = curve_of(segment);
    let start_m = end_of_line(curve, 0u);
    var box = Box(start_m, start_m);
    for (var i = 1u; i <= LINES; i++) {
        let end_m = end_of_line(curve, i);
        box = Box(min(box.low_m, end_m), max(box.high_m, end_m));
    }
    return box;
}

// Whole numbers that sort like the floats.
fn ordered(x: vec2f) -> vec2u {
    let bits = bitcast<vec2u>(x);
    return bits ^ select(vec2u(0x80000000u), vec2u(0xffffffffu), (bits >> vec2u(31u)) == vec2u(1u));
}

// Four numbers that grow with the box: boxes merge by maxima, and zeros are the empty box.
fn packed_box(box: Box) -> vec4u {
    return vec4u(~ordered(box.low_m), ordered(box.high_m));
}

// The least packed box that meets a window, in each of the four numbers.
fn packed_window(low_m: vec2f, high_m: vec2f) -> vec4u {
    return vec4u(~ordered(high_m), ordered(low_m));
}

// Column and row of a point's cell, of 2^level cells per side of the quadtree's root.
fn cell_of(point_m: vec2f, origin_m: vec2f, side_m: f32, level: u32) -> vec2u {
    let cells = f32(1u << level);
    let cell = floor((point_m - origin_m) * (cells / side_m));
    return vec2u(clamp(cell, vec2f(0.0), vec2f(cells - 1.0)));
}

// Interleaves the low 16 bits of a column and of a row (Morton 1966).
fn morton(cell: vec2u) -> u32 {
    var bits = cell & vec2u(0xffffu);
    bits = (bits | (bits << vec2u(8u))) & vec2u(0x00ff00ffu);
    bits = (bits | (bits << vec2u(4u))) & vec2u(0x0f0f0f0fu);
    bits = (bits | (bits << vec2u(2u))) & vec2u(0x33333333u);
    bits = (bits | (bits << vec2u(1u))) & vec2u(0x55555555u);
    return bits.x | (bits.y << 1u);
}

// Key of a cell of the quadtree; it sorts by level first. derived: 4 bits of level leave 14 bits
// per axis, hence levels up to 14.
fn key_of(cell: vec2u, level: u32) -> u32 {
    return (level << 28u) | morton(cell);
}
