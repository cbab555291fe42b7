// Composites batches by subgroups. Each subgroup owns one sample row per lane, and goes through a
// batch alone: each lane loads a line, and the subgroup composites those that may be visible, each
// on all of its rows at once. Subgroups wait for each other only at the end of a batch.
// Variant `subgroup` of the rows interface; the other is `rows_workgroup.wgsl`.

// import: composite/composite_row.wgsl
// import: composite/rank_buckets.wgsl
// import: shared/subgroup_capsule.wgsl
// import: shared/open_pixels.wgsl

// Greatest subgroup size of the device: gives loops a constant length.
override MAX_LANES: u32;

struct Thread {
    // Lane and size of its subgroup.
    @builtin(subgroup_invocation_id) lane: u32,
    @builtin(subgroup_size) lanes: u32,
    // Index of the subgroup in the workgroup.
    @builtin(subgroup_id) team: u32,
}

var<workgroup> any_row_open: atomic<u32>;

// Pixel columns in which rows of the subgroup have uncovered samples, one bit each. Bits 0-15: the
// first half of its rows. Bits 16-31: the second half.
fn columns_open(own: Thread) -> u32 {
    var full = 0u;
    for (var word = 0u; word < ROW_WORDS; word++) {
        full |= full_pixel_bits(covered[word]) << (word * PIXELS_PER_WORD);
    }
    let half = own.lane / (own.lanes / 2u);
    return subgroupOr((full ^ low_bits(TILE_PX)) << (16u * half));
}

// Pixel columns that a capsule may reach in sample rows [first, end), one bit each.
fn columns_reached(capsule: Capsule, first: u32, end: u32) -> u32 {
    return columns_between(capsule, f32(first) * STEP, f32(end) * STEP);
}

// Rows of the subgroup in which a capsule may reach an open column; empty if x >= y.
fn rows_to_composite(capsule: Capsule, columns: u32, first: u32, lanes: u32) -> vec2u {
    let middle = first + lanes / 2u;
    let end = first + lanes;
    var rows = clamp(capsule_rows(capsule), vec2u(first), vec2u(end));
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

fn row_of_thread(own: Thread) -> u32 {
    return own.team * own.lanes + own.lane;
}

// Initializes the row of a thread.
fn init_row(tile: Tile, thread: u32) {
    covered = outside_picture(tile, thread);
}

// Returns whether `is_open` holds for any thread.
fn is_any_row_open(thread: u32, is_open: bool) -> bool {
    if thread == 0u {
        atomicStore(&any_row_open, 0u);
    }
    workgroupBarrier();
    if is_open {
        atomicStore(&any_row_open, 1u);
    }
    workgroupBarrier();
    return broadcast(thread, vec2u(atomicLoad(&any_row_open))).x != 0u;
}

// Composites a batch until all rows of the subgroup are full. Returns whether any row of the
// workgroup is open; after the last batch the answer is not needed.
fn composite_batch(own: Thread, tile: Tile, count: u32, is_last: bool) -> bool {
    let row = row_of_thread(own);
    let first_row = row - own.lane;
    var columns = columns_open(own);
    for (var first = 0u; columns != 0u && first < count; first += own.lanes) {
        var capsule: Capsule;
        var color = 0u;
        var rows = vec2u(0u);
        if first + own.lane < count {
            let line = batch[first + own.lane];
            let style = style_of(rank_of(line));
            capsule = capsule_with_radius(tile, line, radius_px(style.width_m));
            color = style.color;
            rows = rows_to_composite(capsule, columns, first_row, own.lanes);
        }
        let shown = subgroupBallot(rows.x < rows.y);
        let bounds = rows.x | (rows.y << 16u);
        for (var word = 0u; word * 32u < MAX_LANES; word++) {
            for (var left = shown[word]; left != 0u; left &= left - 1u) {
                let lane = word * 32u + firstTrailingBit(left);
                let line = capsule_of_lane(capsule, lane);
                let line_color = subgroupShuffle(color, lane);
                let line_rows = subgroupShuffle(bounds, lane);
                if row >= (line_rows & 0xffffu) && row < (line_rows >> 16u) && !is_row_full() {
                    composite_line(line_color, row_span(line, row));
                }
                loops += 1u + ROW_WORDS;
            }
        }
        columns = columns_open(own);
        // Iterations of testing rows and columns.
        loops += 5u + ROW_WORDS;
    }
    return !is_last && is_any_row_open(row_of_thread(own), columns != 0u);
}
