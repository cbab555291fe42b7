// Butt caps: the half discs beyond the ends of a path, which its strokes leave out.

// import: composite/sample_row.wgsl
// import: shared/capsule.wgsl

// Lattice steps by which the disc is larger than the round cap: more than all rounding. The stroke
// has no sample there.
const CUT_MARGIN: f32 = 0.5;

// Adds the samples of a row that are beyond an end of a capsule: a half disc around `end`, on the
// side of the unit vector `outward`.
fn add_half_disc(
    into: ptr<function, SampleRow>,
    end: vec2f,
    outward: vec2f,
    radius: f32,
    row: u32,
) {
    let below = plus_half(row) - end.y;
    let reach = radius + CUT_MARGIN;
    let square = reach * reach - below * below;
    // The plane cuts the row where x * outward.x + below * outward.y is 0.
    let is_upright = abs(outward.x) < 1e-6;
    if square <= 0.0 || (is_upright && below * outward.y <= 0.0) {
        return;
    }
    let half = sqrt(square);
    let plane = -below * outward.y / select(outward.x, 1.0, is_upright);
    // Samples in the plane stay covered.
    let left = select(-half, max(plane + 2.0 * BORDER_SLACK, -half), outward.x >= 1e-6);
    let right = select(half, min(plane - 2.0 * BORDER_SLACK, half), outward.x <= -1e-6);
    let span = samples_between(row, end.x + left, end.x + right);
    for (var word = 0u; word < ROW_WORDS; word++) {
        (*into)[word] |= bits_between(span.x, span.y, word);
    }
}

// Adds the samples of a row that the butt caps of a line leave out. `path_ends`: whether its upper
// and its lower end are ends of a path.
fn add_cuts(into: ptr<function, SampleRow>, capsule: Capsule, path_ends: vec2<bool>, row: u32) {
    let square = dot(capsule.along, capsule.along);
    if square == 0.0 {
        return;
    }
    let along = capsule.along * inverseSqrt(square);
    if path_ends.x {
        add_half_disc(into, capsule.upper, -along, capsule.radius, row);
    }
    if path_ends.y {
        add_half_disc(into, capsule.upper + capsule.along, along, capsule.radius, row);
    }
}
