// Lines laid by teams of threads that run in step and see each other's values. A team has a row of samples for each lane, and goes
// through a portion by itself: each lane looks at a line, and those that may show are laid one below the other, each on all rows of
// the team at once. Teams wait for each other only where the portion ends.

// Most lanes that a team of this device has: loops of a known length take less time.
override MOST_LANES: u32;

struct Thread {
    // In its team.
    @builtin(subgroup_invocation_id) lane: u32,
    @builtin(subgroup_size) lanes: u32,
    // Of its team in the workgroup.
    @builtin(subgroup_id) team: u32,
}

var<workgroup> is_any_open: atomic<u32>;

// The columns of pixels in which rows of the team have samples left, a bit each: of the first half of its rows, and from bit 16 on of
// the second.
fn columns_open(own: Thread) -> u32 {
    var full = 0u;
    for (var word = 0u; word < WORDS; word++) {
        full |= full_pixels(covered[word]) << (word * PIXELS_A_WORD);
    }
    let half = own.lane / (own.lanes / 2u);
    return subgroupOr((full ^ low_bits(TILE_PX)) << (16u * half));
}

// The columns of pixels that a line may reach in rows of samples between two, a bit each.
fn columns_reached(capsule: Capsule, first: u32, end: u32) -> u32 {
    let reach = capsule.radius + SLACK;
    let near = vec2f(f32(first) - reach, f32(end) + reach) - capsule.upper.y;
    let x = capsule.upper.x + capsule.along.x * clamp(near * capsule.per_row, vec2f(0.0), vec2f(1.0));
    let low = clamp((min(x.x, x.y) - reach) / f32(SAMPLE_ROWS), 0.0, f32(TILE_PX));
    let high = clamp((max(x.x, x.y) + reach) / f32(SAMPLE_ROWS) + 1.0, 0.0, f32(TILE_PX));
    return low_bits(u32(high)) & ~low_bits(u32(low));
}

// The rows of the team from the first to behind the last of those in which a line may reach into an open column; none if they end
// before they begin.
fn rows_to_lay(capsule: Capsule, columns: u32, first: u32, lanes: u32) -> vec2u {
    let middle = first + lanes / 2u;
    let end = first + lanes;
    var rows = clamp(rows_touched(capsule), vec2u(first), vec2u(end));
    if rows.x >= rows.y {
        return rows;
    }
    if (columns & columns_reached(capsule, first, middle)) == 0u {
        rows.x = max(rows.x, middle);
    }
    if ((columns >> 16u) & columns_reached(capsule, middle, end)) == 0u {
        rows.y = min(rows.y, middle);
    }
    return rows;
}

fn number_of(own: Thread) -> u32 {
    return own.team * own.lanes + own.lane;
}

// Begins the row of a thread.
fn begin_row(tile: Tile, thread: u32) {
    covered = beyond(tile, thread);
}

// Whether it is so for any thread.
fn is_any(thread: u32, is_so: bool) -> bool {
    if thread == 0u {
        atomicStore(&is_any_open, 0u);
    }
    workgroupBarrier();
    if is_so {
        atomicStore(&is_any_open, 1u);
    }
    workgroupBarrier();
    return tell(thread, vec2u(atomicLoad(&is_any_open))).x != 0u;
}

// Lays so many lines of a portion, until all rows of the team are full. Returns whether any row is not; behind the last portion nobody
// waits to know.
fn lay_portion(own: Thread, tile: Tile, count: u32, is_last: bool) -> bool {
    let row = number_of(own);
    let first_row = row - own.lane;
    var columns = columns_open(own);
    for (var first = 0u; columns != 0u && first < count; first += own.lanes) {
        var capsule: Capsule;
        var color = 0u;
        var rows = vec2u(0u);
        if first + own.lane < count {
            let line = portion[first + own.lane];
            let style = style_of(rank_of(line));
            capsule = capsule_as_wide(tile, line, radius_px(style.width_m));
            color = style.color;
            rows = rows_to_lay(capsule, columns, first_row, own.lanes);
        }
        let shown = subgroupBallot(rows.x < rows.y);
        let bounds = rows.x | (rows.y << 16u);
        for (var word = 0u; word * 32u < MOST_LANES; word++) {
            for (var left = shown[word]; left != 0u; left &= left - 1u) {
                let lane = word * 32u + firstTrailingBit(left);
                let line = capsule_of_lane(capsule, lane);
                let line_color = subgroupShuffle(color, lane);
                let line_rows = subgroupShuffle(bounds, lane);
                if row >= (line_rows & 0xffffu) && row < (line_rows >> 16u) && !is_row_full() {
                    lay_line(line_color, span_of(line, row));
                }
                rounds += 1u + WORDS;
            }
        }
        columns = columns_open(own);
        // Of these lines, and of what is open.
        rounds += 5u + WORDS;
    }
    return !is_last && is_any(number_of(own), columns != 0u);
}
