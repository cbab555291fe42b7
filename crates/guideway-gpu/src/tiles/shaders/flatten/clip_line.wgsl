// Clips lines to the LOD.

// import: shared/frame.wgsl
// import: shared/rounding.wgsl

// Returns the part of a line inside the LOD as a parameter range, empty if x > y (Liang and Barsky
// 1984). The LOD extends so far beyond the picture that no cap at a cut is visible.
fn clip_to_lod(a: vec2f, b: vec2f) -> vec2f {
    let along = b - a;
    var part = vec2f(0.0, 1.0);
    for (var axis = 0u; axis < 2u; axis++) {
        let reach = frame.lod_reach_px[axis];
        if along[axis] == 0.0 {
            if abs(a[axis]) > reach {
                return vec2f(1.0, 0.0);
            }
        } else {
            let inverse = reciprocal(abs(along[axis]));
            let to_sides = vec2f(-reach, reach) - a[axis];
            let t = to_sides * select(-inverse, inverse, along[axis] > 0.0);
            part.x = max(part.x, min(t.x, t.y));
            part.y = min(part.y, max(t.x, t.y));
        }
    }
    return part;
}
