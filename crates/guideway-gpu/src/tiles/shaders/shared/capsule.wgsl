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
// import: shared/work_counts.wgsl

override SAMPLE_ROWS: u32;
override FIRST_COLUMNS: u32;

// Words of samples per sample row of a tile, one bit per sample, from the left.
const ROW_WORDS: u32 = 16u * SAMPLES_PER_ROW / 32u;
const ALL_BITS: u32 = 0xffffffffu;
alias SampleRow = array<u32, ROW_WORDS>;

// Tolerance for covered samples, in lattice steps: a border that passes through samples covers
// them, as in exact arithmetic.
const BORDER_SLACK: f32 = 1.0 / 128.0;

// In lattice steps from the upper left corner of the tile.
struct Capsule {
    // The end with the smaller y, and the vector to the other end.
    upper: vec2f,
    along: vec2f,
    // Heights at which the left and the right border leave the upper cap.
    left_y: f32,
    right_y: f32,
    inverse_dy: f32,
    radius: f32,
}

fn capsule_of(line: vec4f, corner_px: vec2f, radius_px: f32) -> Capsule {
    let scale = f32(SAMPLE_ROWS);
    let a = (line.xy - corner_px) * scale;
    let b = (line.zw - corner_px) * scale;
    // Horizontal lines point right, so that both ends agree on where each border leaves.
    let is_upper = a.y < b.y || (a.y == b.y && a.x <= b.x);
    let upper = select(b, a, is_upper);
    let along = select(a, b, is_upper) - upper;
    let radius = radius_px * scale;
    let square = dot(along, along);
    let border_offset = select(0.0, radius * along.x * inverseSqrt(square), square > 0.0);
    return Capsule(
        upper,
        along,
        upper.y + border_offset + BORDER_SLACK,
        upper.y - border_offset - BORDER_SLACK,
        1.0 / max(along.y, 1e-20),
        radius,
    );
}

// Center x and half chord, at height y, of the disc that bounds the span at this border.
fn disc_chord(capsule: Capsule, y: f32, border_y: f32) -> vec2f {
    let t = clamp((y - border_y) * capsule.inverse_dy, 0.0, 1.0);
    let off = y - (capsule.upper.y + t * capsule.along.y);
    let square = capsule.radius * capsule.radius - off * off;
    return vec2f(capsule.upper.x + t * capsule.along.x, sqrt(max(square, 0.0)));
}

fn low_bits(count: u32) -> u32 {
    return select((1u << (count & 31u)) - 1u, ALL_BITS, count >= 32u);
}

// Bits of one word for the samples [first, end) of its row.
fn bits_between(first: u32, end: u32, word: u32) -> u32 {
    let before = 32u * word;
    return low_bits(max(end, before) - before) & ~low_bits(max(first, before) - before);
}

// Float-integer conversions run on few units of a graphics device, additions on all. From 2^23 on
// floats are whole numbers whose low bits are those of the number.
// Rounds a number in [0, 2^22] to the nearest integer.
fn round_to_u32(x: f32) -> u32 {
    return bitcast<u32>(x + 12582912.0) & 0x3fffffu;
}

// Returns n + 0.5 for n < 2^22.
fn plus_half(n: u32) -> f32 {
    return bitcast<f32>(0x4b000000u | n) - 8388607.5;
}

// Sample rows of the tile that the capsule may touch.
fn capsule_rows(capsule: Capsule) -> vec2u {
    let reach = capsule.radius + BORDER_SLACK;
    let most = f32(TILE_PX * SAMPLE_ROWS);
    let low = clamp(capsule.upper.y - reach, 0.0, most);
    let high = clamp(capsule.upper.y + capsule.along.y + reach, 0.0, most);
    return vec2u(round_to_u32(low), round_to_u32(high));
}

// Samples of a row that the capsule covers, for rows in `capsule_rows`.
fn row_span(capsule: Capsule, row: u32) -> vec2u {
    count_tests(1u);
    let y = plus_half(row);
    let left = disc_chord(capsule, y, capsule.left_y);
    let right = disc_chord(capsule, y, capsule.right_y);
    // The first sample of the row and its distance to the next, in lattice steps.
    let step = SAMPLE_ROWS / SAMPLES_PER_ROW;
    let first_x = plus_half(((FIRST_COLUMNS >> (2u * (row % SAMPLE_ROWS))) & 3u) % step);
    let per_step = 1.0 / f32(step);
    let most = f32(ROW_WORDS * 32u);
    let low = clamp((left.x - left.y - (first_x + BORDER_SLACK)) * per_step + 0.5, 0.0, most);
    let high = clamp((right.x + right.y - (first_x - BORDER_SLACK)) * per_step + 0.5, 0.0, most);
    let first = round_to_u32(low);
    return vec2u(first, max(first, round_to_u32(high)));
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
