// The part of a line that is within reach of the level (Liang and Barsky 1984): from x to y of its length,
// none if x is more than y. It is cut so far outside of what may be seen that no cap shows where it is cut.
fn within_reach(a: vec2f, b: vec2f) -> vec2f {
    let along = b - a;
    var part = vec2f(0.0, 1.0);
    for (var axis = 0u; axis < 2u; axis++) {
        let reach = frame.reach_px[axis];
        if along[axis] == 0.0 {
            if abs(a[axis]) > reach {
                return vec2f(1.0, 0.0);
            }
        } else {
            let t = (vec2f(-reach, reach) - a[axis]) / along[axis];
            part.x = max(part.x, min(t.x, t.y));
            part.y = min(part.y, max(t.x, t.y));
        }
    }
    return part;
}
