// Covers a list of lines. Each lane of a team loads one line; the team then distributes the sample
// rows of these lines evenly among its lanes, in items of ROWS_PER_ITEM rows:
//
//     lane       0          1      2                3
//     line rows  |##|##|##| |##|   |##|##|##|##|##|  -       prefix sum of the item counts
//     items       0  1  2    3      4  5  6  7  8            lane i takes i, i + lanes, ...

// import: cover/team_{team}.wgsl
// import: cover/samples.wgsl

// Thin strokes use all 256 samples per pixel. They hide hardly any other stroke.
const IS_FINE: bool = ROW_WORDS > 2u;
// Longest list to cover without testing for open pixels: shorter lists hide too few lines.
const MAX_UNTESTED_LIST: u32 = select(64u, 0x7fffffffu, IS_FINE);
// Rows of an item share the setup of their capsule.
const ROWS_PER_ITEM: u32 = select(4u, 2u, IS_FINE);
// Batches of a team between tests for open pixels, where few are expected to close.
const BATCHES_PER_OPEN_TEST: u32 = 16u;

// Range of sample rows in which a capsule may reach an open pixel.
fn open_sample_rows(capsule: Capsule) -> vec2u {
    let shown = open_pixel_rows(capsule);
    if shown == 0u {
        return vec2u(0u);
    }
    let touched = capsule_rows(capsule);
    let first = firstTrailingBit(shown) * SAMPLE_ROWS;
    let end = (firstLeadingBit(shown) + 1u) * SAMPLE_ROWS;
    return vec2u(max(touched.x, first), min(touched.y, end));
}

// Covers the distributed items of all lanes.
fn cover_distributed_rows(team: Team, items: u32) {
    for (var first = 0u; first < items; first += team.lanes) {
        let item = first + team.lane;
        let lane_work = work_of_item(team, item);
        if item < items {
            let top = (lane_work.first + item) * ROWS_PER_ITEM;
            let end = min(lane_work.rows >> 16u, top + ROWS_PER_ITEM);
            for (var row = max(lane_work.rows & 0xffffu, top); row < end; row++) {
                cover_row(lane_work.capsule, row);
            }
        }
    }
}

// Covers a list in batches of lines spread over all of it: neighbors in a list lie near each other,
// so what one batch fills, the next can skip. All teams have equally many batches.
fn cover_list(team: Team, tile: Tile, list: vec2u) {
    let tests_open = list.y - list.x > MAX_UNTESTED_LIST;
    let team_batches = batches_of_team(team, list.y - list.x);
    let batches = team_batches * team.teams;
    for (var number = 0u; number < team_batches; number++) {
        let batch = team.number * team_batches + number;
        let position = list.x + team.lane * batches + batch;
        var lane_work: LaneWork;
        var items = 0u;
        if position < list.y {
            lane_work.capsule = capsule_of_reference(tile, position);
            var rows: vec2u;
            if tests_open {
                rows = open_sample_rows(lane_work.capsule);
            } else {
                rows = capsule_rows(lane_work.capsule);
            }
            if rows.y > rows.x {
                lane_work.rows = rows.x | (rows.y << 16u);
                lane_work.first = rows.x / ROWS_PER_ITEM;
                items = (rows.y + ROWS_PER_ITEM - 1u) / ROWS_PER_ITEM - lane_work.first;
            }
        }
        cover_distributed_rows(team, distribute_rows(team, lane_work, items));
        if tests_open || (number + 1u) % BATCHES_PER_OPEN_TEST == 0u {
            close_full_pixels(team.lane, team.lanes);
            if team_broadcast(team, atomicLoad(&open_pixel_count)) == 0u {
                break;
            }
        }
    }
}
