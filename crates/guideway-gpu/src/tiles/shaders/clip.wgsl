// The part of a line that is within reach of the picture (Liang and Barsky 1984): from x to y of its length,
// none if x is more than y. It is cut a pixel outside of what is seen, so that no cap shows where it is cut.
fn within_reach(a: vec2f, b: vec2f, reach_px: f32) -> vec2f {
    let window = window();
    let low = window.low_px - reach_px;
    let high = window.high_px + reach_px;
    let along = b - a;
    var part = vec2f(0.0, 1.0);
    for (var axis = 0u; axis < 2u; axis++) {
        if along[axis] == 0.0 {
            if a[axis] < low[axis] || a[axis] > high[axis] {
                return vec2f(1.0, 0.0);
            }
        } else {
            let t = (vec2f(low[axis], high[axis]) - a[axis]) / along[axis];
            part.x = max(part.x, min(t.x, t.y));
            part.y = min(part.y, max(t.x, t.y));
        }
    }
    return part;
}
