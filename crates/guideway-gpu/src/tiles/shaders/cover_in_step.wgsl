// Tiles of a scene of one opaque color, on a processor: as many threads as run in step cover one, and each keeps rows of samples for
// itself, for barriers, atomic operations and memory that threads share take long there. A branch that no thread takes still takes its
// time, and so does a round of a loop behind its end, if the loop looks for that first.

@group(0) @binding(7) var<storage, read_write> counts: array<u32>;
@group(0) @binding(8) var<storage, read_write> found: Found;

// Blocks of rows of samples, one row for each lane, that a tile has, and a row of pixels.
const BLOCKS: u32 = 32u;
const BLOCKS_A_PIXEL: u32 = 2u;
const IS_FINE: bool = WORDS > 2u;

// Samples of the rows of this lane, and which of these have any to cover yet, a bit each; of fine ones all.
var<private> samples: array<u32, BLOCKS * WORDS>;
var<private> open_rows: u32;
// Times that this thread has gone round its loops.
var<private> rounds: u32;

fn row_of(lane: u32, block: u32) -> u32 {
    return block * LANES + lane;
}

// Begins with nothing covered.
fn clear(tile: Tile, lane: u32) {
    open_rows = 0u;
    for (var block = 0u; block < BLOCKS; block++) {
        let outside = beyond(tile, row_of(lane, block));
        var all = ALL;
        for (var word = 0u; word < WORDS; word++) {
            samples[block * WORDS + word] = outside[word];
            all &= outside[word];
        }
        open_rows |= select(0u, 1u << block, all != ALL);
    }
}

// Covers samples of a row of this lane.
fn cover_span(block: u32, span: vec2u) {
    let first = block * WORDS;
    if IS_FINE {
        var word = min(span.x / 32u, WORDS - 1u);
        rounds += subgroupMax(max(span.y / 32u, word) - word) + 1u;
        loop {
            samples[first + word] |= bits_between(span.x, span.y, word);
            word++;
            if word * 32u >= span.y {
                break;
            }
        }
        return;
    }
    var all = ALL;
    for (var word = 0u; word < WORDS; word++) {
        let now = samples[first + word] | bits_between(span.x, span.y, word);
        samples[first + word] = now;
        all &= now;
    }
    if all == ALL {
        open_rows &= ~(1u << block);
    }
}

// Covers the rows of samples that a line touches, those of a block at once.
fn cover_line(lane: u32, capsule: Capsule, rows: vec2u) {
    let blocks = low_bits((rows.y + LANES - 1u) / LANES) & ~low_bits(rows.x / LANES);
    var left = blocks & subgroupOr(open_rows);
    loop {
        let block = min(firstTrailingBit(left), BLOCKS - 1u);
        let row = row_of(lane, block);
        var span = vec2u(0u);
        if left != 0u && row >= rows.x && row < rows.y {
            span = span_of(capsule, row);
        }
        cover_span(block, span);
        left &= left - 1u;
        rounds++;
        if left == 0u {
            break;
        }
    }
}

// Covers a list, in turns of lines from all over it, one for each lane to look at: neighbors in the list lie near each other.
fn cover_list(lane: u32, tile: Tile, list: vec2u) {
    let turns = (list.y - list.x + LANES - 1u) / LANES;
    var turn = 0u;
    loop {
        let place = list.x + lane * turns + turn;
        var own: Capsule;
        var touched = vec2u(0u);
        if place < list.y {
            own = capsule_at(tile, place);
            touched = rows_touched(own);
        }
        var i = 0u;
        loop {
            let rows = vec2u(subgroupShuffle(touched.x, i), subgroupShuffle(touched.y, i));
            cover_line(lane, capsule_of_lane(own, i), rows);
            i++;
            rounds++;
            if i == LANES {
                break;
            }
        }
        turn++;
        rounds++;
        if turn == turns || subgroupOr(open_rows) == 0u {
            break;
        }
    }
}
