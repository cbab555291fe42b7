// One thread for one line after the other: marks the paths that reach into what is drawn.

override WORKGROUP: u32;

@group(0) @binding(1) var<storage, read> found: CountersBefore;
@group(0) @binding(2) var<storage, read> lines: array<u32>;
@group(0) @binding(3) var<storage, read> line_ranks: array<u32>;
@group(0) @binding(4) var<storage, read> styles: array<Style>;
// A bit a rank.
@group(0) @binding(5) var<storage, read_write> marks: array<atomic<u32>>;

fn square_to_box(p: vec2f, window: Window) -> f32 {
    let off = p - clamp(p, window.low_px, window.high_px);
    return dot(off, off);
}

fn square_to_line(p: vec2f, line: vec4f) -> f32 {
    let along = line.zw - line.xy;
    let square = dot(along, along);
    let t = select(0.0, clamp(dot(p - line.xy, along) / square, 0.0, 1.0), square > 0.0);
    let off = p - line.xy - t * along;
    return dot(off, off);
}

// Whether a line goes through a box (Liang and Barsky 1984).
fn goes_through(line: vec4f, window: Window) -> bool {
    let along = line.zw - line.xy;
    var part = vec2f(0.0, 1.0);
    for (var axis = 0u; axis < 2u; axis++) {
        let low = window.low_px[axis] - line[axis];
        let high = window.high_px[axis] - line[axis];
        if along[axis] == 0.0 {
            if low > 0.0 || high < 0.0 {
                return false;
            }
        } else {
            let t = vec2f(low, high) / along[axis];
            part = vec2f(max(part.x, min(t.x, t.y)), min(part.y, max(t.x, t.y)));
        }
    }
    return part.x <= part.y;
}

// The nearest points of a line and a box that it misses are an end of the one or a corner of the other.
fn is_near(line: vec4f, radius: f32, window: Window) -> bool {
    if goes_through(line, window) {
        return true;
    }
    var nearest = min(square_to_box(line.xy, window), square_to_box(line.zw, window));
    for (var corner = 0u; corner < 4u; corner++) {
        let is_high = vec2<bool>((corner & 1u) != 0u, (corner & 2u) != 0u);
        nearest = min(nearest, square_to_line(select(window.low_px, window.high_px, is_high), line));
    }
    return nearest <= radius * radius;
}

@compute @workgroup_size(WORKGROUP)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let window = window();
    let threads = count.x * count.y * WORKGROUP;
    let count_of_lines = min(found.lines, frame.line_room);
    for (var i = workgroup_index(id, count) * WORKGROUP + thread; i < count_of_lines; i += threads) {
        let words = words_of_line(i);
        let rank = line_ranks[i];
        if words.x != NOWHERE && is_near(line_of(words), radius_of(rank), window) {
            atomicOr(&marks[rank / 32u], 1u << (rank % 32u));
        }
    }
}
