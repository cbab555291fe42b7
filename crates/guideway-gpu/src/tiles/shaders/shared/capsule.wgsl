// Computes the samples of a tile that a line with round caps (a capsule) covers.
//
// A pixel has 16 sample rows. Of the 16 x 16 sample lattice of the exact picture each row takes all
// 16 samples, or 4 of them, such that every row and column holds equally many: horizontal and
// vertical borders then cover the same share of samples as in the exact picture.
//
//            left_y   .-----.          Each row cuts a capsule in one span. Its ends lie on the
//                  .-'   o   '-.       discs whose centers are the nearest points of the axis
//                 /     /      .'      to where each border leaves the upper cap.
//                /     /     .'  right_y

// import: shared/frame.wgsl
// import: shared/rounding.wgsl
// import: shared/work_counts.wgsl

override SAMPLE_ROWS: u32;
override FIRST_COLUMNS: u32;

// Words of samples per sample row of a tile, one bit per sample, from the left.
const ROW_WORDS: u32 = 16u * SAMPLES_PER_ROW / 32u;
const ALL_BITS: u32 = 0xffffffffu;
alias SampleRow = array<u32, ROW_WORDS>;

// Lattice steps are counted in units of 2^26, so that every coordinate lies between -1 and 1, and
// products stay within the bounds of a clamp to 0..1. Devices clamp so at no cost, and a clamp
// keeps a product from a sum (`shared/rounding.wgsl`).
const STEP: f32 = 1.0 / 67108864.0;

// Tolerance for covered samples: a border that passes through samples covers them, as in exact
// arithmetic.
const BORDER_SLACK: f32 = STEP / 128.0;
// Least height of an axis: level lines need no case of their own.
const MIN_HEIGHT: f32 = STEP / 256.0;

// From the upper left corner of the tile.
struct Capsule {
    // The end with the smaller y.
    upper: vec2f,
    // Height of the axis, and its change in x per y.
    height: f32,
    slope: f32,
    // The left border leaves the upper cap that far below its center, the right one above it.
    border_y: f32,
    radius: f32,
}

// Ends of a line from a corner.
fn ends_from(line: vec4f, corner_px: vec2f) -> vec4f {
    return exact4((line - corner_px.xyxy) * (f32(SAMPLE_ROWS) * STEP));
}

// Returns whether the first end is the upper one. Level lines point right, so that both ends agree
// on where each border leaves.
fn points_down(ends: vec4f) -> bool {
    return ends.y < ends.w || (ends.y == ends.w && ends.x <= ends.z);
}

fn capsule_of(line: vec4f, corner_px: vec2f, radius_px: f32) -> Capsule {
    let any = ends_from(line, corner_px);
    let ends = select(any.zwxy, any, points_down(any));
    let along = ends.zw - ends.xy;
    let radius = exact(radius_px * (f32(SAMPLE_ROWS) * STEP));
    let squares = clamp(along * along, vec2f(0.0), vec2f(1.0));
    let square = squares.x + squares.y;
    let level = along.x * near_inverse_root(square);
    let border_y = select(0.0, radius * level, square > 0.0);
    let height = max(along.y, MIN_HEIGHT);
    let slope = rounded(along.x * reciprocal(height));
    return Capsule(ends.xy, height, slope, rounded(border_y) + BORDER_SLACK, radius);
}

// The lower end.
fn lower_end(capsule: Capsule) -> vec2f {
    let end_x = capsule.upper.x + run(capsule, capsule.height);
    return vec2f(end_x, capsule.upper.y + capsule.height);
}

// Change in x from the upper end to a height below it.
fn run(capsule: Capsule, height: f32) -> f32 {
    let sign = bitcast<f32>((bitcast<u32>(capsule.slope) & 0x80000000u) | 0x3f800000u);
    return exact(sign * clamp(height * abs(capsule.slope), 0.0, 1.0));
}

// The disc that bounds a row at a border: x of its center from the upper end, and the square of its
// half chord. Below the upper end, the row is at `y` and the border leaves at `border_y`.
fn border_disc(capsule: Capsule, y: f32, border_y: f32) -> vec2f {
    let down = min(clamp(y - border_y, 0.0, 1.0), capsule.height);
    let off = y - down;
    let outer = clamp(capsule.radius * capsule.radius, 0.0, 1.0);
    let square = clamp(outer - clamp(off * off, 0.0, 1.0), 0.0, 1.0);
    return vec2f(run(capsule, down), square);
}

fn low_bits(count: u32) -> u32 {
    return select((1u << (count & 31u)) - 1u, ALL_BITS, count >= 32u);
}

// Bits of one word for the samples [first, end) of its row.
fn bits_between(first: u32, end: u32, word: u32) -> u32 {
    let before = 32u * word;
    return low_bits(max(end, before) - before) & ~low_bits(max(first, before) - before);
}

// Float-integer conversions run on few units of a graphics device, additions on all. Where floats
// are multiples of one step, their low bits count these steps.
// Rounds a number of steps in [0, 2^22] to the nearest integer.
fn round_to_u32(x: f32) -> u32 {
    return bitcast<u32>(x + 0.1875) & 0x3fffffu;
}

// Returns n + 0.5 steps for n < 2^22.
fn plus_half(n: u32) -> f32 {
    return bitcast<f32>(0x3e000000u | n) - (0.125 - 0.5 * STEP);
}

// Sample rows of the tile that the capsule may touch.
fn capsule_rows(capsule: Capsule) -> vec2u {
    let reach = capsule.radius + BORDER_SLACK;
    let most = f32(TILE_PX * SAMPLE_ROWS) * STEP;
    let low = clamp(capsule.upper.y - reach, 0.0, most);
    let high = clamp(capsule.upper.y + capsule.height + reach, 0.0, most);
    return vec2u(round_to_u32(low), round_to_u32(high));
}

// Pixel columns of the tile that a capsule may reach between two heights, one bit each.
fn columns_between(capsule: Capsule, low_y: f32, high_y: f32) -> u32 {
    let reach = capsule.radius + BORDER_SLACK;
    let near = vec2f(low_y - reach, high_y + reach) - capsule.upper.y;
    let down = clamp(near, vec2f(0.0), vec2f(capsule.height));
    let x = capsule.upper.x + capsule.slope * down;
    let px_per_unit = 1.0 / (f32(SAMPLE_ROWS) * STEP);
    let low = clamp((min(x.x, x.y) - reach) * px_per_unit, 0.0, f32(TILE_PX));
    let high = clamp((max(x.x, x.y) + reach) * px_per_unit + 1.0, 0.0, f32(TILE_PX));
    return low_bits(u32(high)) & ~low_bits(u32(low));
}

// Samples are numbered in the low bits of floats from here on.
const NUMBERED: f32 = 12582912.0;

// The sample of a row that is nearest to a place, numbered. An estimate: it may be the next one.
fn sample_near(x: f32) -> f32 {
    return x * (f32(SAMPLES_PER_ROW) / (f32(SAMPLE_ROWS) * STEP)) + NUMBERED;
}

// Place of a sample from the first of its row.
fn place_of(numbered: f32) -> f32 {
    let step = f32(SAMPLE_ROWS / SAMPLES_PER_ROW) * STEP;
    return exact((numbered - NUMBERED) * step);
}

// Returns 1 if a sample is further off than the half chord with this square, else 0. It compares
// squares because the roots of devices differ.
fn is_beyond(off: f32, square: f32) -> i32 {
    return select(0, 1, off * abs(off) > square);
}

// Samples of a row that the capsule covers, for rows in `capsule_rows`. Empty if they begin beyond
// the last sample of the row.
fn row_span(capsule: Capsule, row: u32) -> vec2u {
    count_tests(1u);
    let y = plus_half(row) - capsule.upper.y;
    let left = border_disc(capsule, y, capsule.border_y);
    let right = border_disc(capsule, y, -capsule.border_y);
    // The first sample of the row.
    let step = SAMPLE_ROWS / SAMPLES_PER_ROW;
    let first_x = plus_half(((FIRST_COLUMNS >> (2u * (row % SAMPLE_ROWS))) & 3u) % step);
    let left_x = capsule.upper.x - BORDER_SLACK - first_x + left.x;
    let right_x = capsule.upper.x + BORDER_SLACK - first_x + right.x;
    let last = NUMBERED + f32(ROW_WORDS * 32u - 1u);
    let low = max(sample_near(left_x - sqrt(left.y)), NUMBERED);
    let high = min(sample_near(right_x + sqrt(right.y)), last);
    let low_number = bitcast<i32>(low) - bitcast<i32>(NUMBERED);
    let high_number = bitcast<i32>(high) - bitcast<i32>(NUMBERED);
    let first = low_number + is_beyond(left_x - place_of(low), left.y);
    let end = high_number + 1 - is_beyond(place_of(high) - right_x, right.y);
    return vec2u(vec2i(first, max(first, end)));
}

// Adds the samples of one row that the capsule covers.
fn cover(into: ptr<function, SampleRow>, capsule: Capsule, row: u32) {
    let rows = capsule_rows(capsule);
    if row >= rows.x && row < rows.y {
        let span = row_span(capsule, row);
        for (var word = 0u; word < ROW_WORDS; word++) {
            (*into)[word] |= bits_between(span.x, span.y, word);
        }
    }
}
