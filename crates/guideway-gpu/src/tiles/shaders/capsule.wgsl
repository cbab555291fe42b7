// Which samples of a tile a line with round caps covers.
//
// A pixel has 16 rows of samples: all 16 of each, or 4, so chosen from the 16 x 16 lattice of the exact
// picture that each row and each column has as many. A border that is level or upright thus covers the same
// share of them as of all.

override SAMPLE_ROWS: u32;
override COLUMNS: u32;

// Words that hold the samples of one row of a tile, a bit each, from the left.
const WORDS: u32 = 16u * SAMPLES_A_ROW / 32u;
const ALL: u32 = 0xffffffffu;
alias Row = array<u32, WORDS>;

// How far a sample may be outside and still count as covered, in steps of the lattice: a border through a
// row of samples then covers it, as it does in exact arithmetic.
const SLACK: f32 = 1.0 / 128.0;

// In steps of the lattice, from the upper left corner of the tile.
struct Capsule {
    // The end of lesser y, and from there to the other.
    upper: vec2f,
    along: vec2f,
    // Where the left and the right border leave the upper cap.
    left_y: f32,
    right_y: f32,
    per_row: f32,
    radius: f32,
}

fn capsule_of(line: vec4f, corner_px: vec2f, radius_px: f32) -> Capsule {
    let scale = f32(SAMPLE_ROWS);
    let a = (line.xy - corner_px) * scale;
    let b = (line.zw - corner_px) * scale;
    // Level lines go right, so that both cases agree on which end each border leaves.
    let is_upper = a.y < b.y || (a.y == b.y && a.x <= b.x);
    let upper = select(b, a, is_upper);
    let along = select(a, b, is_upper) - upper;
    let radius = radius_px * scale;
    let square = dot(along, along);
    let lean = select(0.0, radius * along.x * inverseSqrt(square), square > 0.0);
    return Capsule(
        upper,
        along,
        upper.y + lean + SLACK,
        upper.y - lean - SLACK,
        1.0 / max(along.y, 1e-20),
        radius,
    );
}

// The center's x and half the chord, at y, of the disc that holds the border there.
fn disc_at(capsule: Capsule, y: f32, border_y: f32) -> vec2f {
    let t = clamp((y - border_y) * capsule.per_row, 0.0, 1.0);
    let off = y - (capsule.upper.y + t * capsule.along.y);
    let square = capsule.radius * capsule.radius - off * off;
    return vec2f(capsule.upper.x + t * capsule.along.x, sqrt(max(square, 0.0)));
}

fn low_bits(count: u32) -> u32 {
    return select((1u << (count & 31u)) - 1u, ALL, count >= 32u);
}

// The bits of one word that lie between two samples of its row.
fn bits_between(first: u32, end: u32, word: u32) -> u32 {
    let before = 32u * word;
    return low_bits(max(end, before) - before) & ~low_bits(max(first, before) - before);
}

// Conversions are done by few units of a graphics device, additions by all. From 2^23 on the steps of floats are whole
// numbers, and their low bits are those of the number.

// The nearest whole number of one from zero to 2^22.
fn whole(x: f32) -> u32 {
    return bitcast<u32>(x + 12582912.0) & 0x3fffffu;
}

// A number below 2^22 and a half.
fn and_half(n: u32) -> f32 {
    return bitcast<f32>(0x4b000000u | n) - 8388607.5;
}

// The rows of a tile that may have covered samples: from the first to behind the last.
fn rows_touched(capsule: Capsule) -> vec2u {
    let reach = capsule.radius + SLACK;
    let most = f32(TILE_PX * SAMPLE_ROWS);
    let low = clamp(capsule.upper.y - reach, 0.0, most);
    let high = clamp(capsule.upper.y + capsule.along.y + reach, 0.0, most);
    return vec2u(whole(low), whole(high));
}

// The samples of a row that are covered, if it may have any: from the first to behind the last.
fn span_of(capsule: Capsule, row: u32) -> vec2u {
    tests(1u);
    let y = and_half(row);
    let left = disc_at(capsule, y, capsule.left_y);
    let right = disc_at(capsule, y, capsule.right_y);
    // The first sample of the row, and its distance to the next.
    let step = SAMPLE_ROWS / SAMPLES_A_ROW;
    let first_x = and_half(((COLUMNS >> (2u * (row % SAMPLE_ROWS))) & 3u) % step);
    let per_step = 1.0 / f32(step);
    let most = f32(WORDS * 32u);
    let low = clamp((left.x - left.y - (first_x + SLACK)) * per_step + 0.5, 0.0, most);
    let high = clamp((right.x + right.y - (first_x - SLACK)) * per_step + 0.5, 0.0, most);
    let first = whole(low);
    return vec2u(first, max(first, whole(high)));
}

// Adds what a line covers of a row.
fn cover(into: ptr<function, Row>, capsule: Capsule, row: u32) {
    let rows = rows_touched(capsule);
    if row >= rows.x && row < rows.y {
        let span = span_of(capsule, row);
        for (var word = 0u; word < WORDS; word++) {
            (*into)[word] |= bits_between(span.x, span.y, word);
        }
    }
}
