// Covers the lines of a list: each lane of a team looks at one, and their rows are dealt out to all lanes.

// Whether strokes are so thin that they need all samples. They hide hardly any other.
const IS_FINE: bool = WORDS > 2u;
// Longest list that is covered as it is: of fewer lines, too few are hidden to look for them.
const SHORT: u32 = select(64u, 0x7fffffffu, IS_FINE);
// Rows of samples of an item: what they share is worked out once.
const ROWS_AN_ITEM: u32 = select(4u, 2u, IS_FINE);
// Turns of a team before it is seen whether any pixel is open, where none is expected to close.
const TURNS_A_LOOK: u32 = 16u;

// Threads that go in step, each with a number, and the number of the team among those of the workgroup.
struct Team {
    lane: u32,
    lanes: u32,
    number: u32,
    teams: u32,
}

// What a lane has of a line.
struct Share {
    capsule: Capsule,
    // Its first row of samples, and from bit 16 on the one behind its last.
    rows: u32,
    // The item that begins its rows, less the number of the lane's first one among all.
    first: u32,
}

// The rows of samples from the first to behind the last of those in which a line may reach into an open pixel.
fn rows_open(capsule: Capsule) -> vec2u {
    let shown = rows_shown(capsule);
    if shown == 0u {
        return vec2u(0u);
    }
    let touched = rows_touched(capsule);
    let first = firstTrailingBit(shown) * SAMPLE_ROWS;
    let end = (firstLeadingBit(shown) + 1u) * SAMPLE_ROWS;
    return vec2u(max(touched.x, first), min(touched.y, end));
}

// Covers what is dealt out: items of all lanes.
fn cover_items(team: Team, items: u32) {
    for (var first = 0u; first < items; first += team.lanes) {
        let item = first + team.lane;
        let share = share_with(team, item);
        if item < items {
            let top = (share.first + item) * ROWS_AN_ITEM;
            let end = min(share.rows >> 16u, top + ROWS_AN_ITEM);
            for (var row = max(share.rows & 0xffffu, top); row < end; row++) {
                cover_row(share.capsule, row);
            }
        }
    }
}

// Covers a list in turns, each of lines from all over it, for neighbors in the list lie near each other: what the
// first ones have filled, the others need not. All teams have as many, and those that go on together lie apart.
fn cover_list(team: Team, tile: Tile, list: vec2u) {
    let looks = list.y - list.x > SHORT;
    let threads = team.lanes * team.teams;
    let rounds = (list.y - list.x + threads - 1u) / threads;
    let turns = rounds * team.teams;
    for (var round = 0u; round < rounds; round++) {
        let turn = team.number * rounds + round;
        let place = list.x + team.lane * turns + turn;
        var share: Share;
        var items = 0u;
        if place < list.y {
            share.capsule = capsule_at(tile, place);
            var rows: vec2u;
            if looks {
                rows = rows_open(share.capsule);
            } else {
                rows = rows_touched(share.capsule);
            }
            if rows.y > rows.x {
                share.rows = rows.x | (rows.y << 16u);
                share.first = rows.x / ROWS_AN_ITEM;
                items = (rows.y + ROWS_AN_ITEM - 1u) / ROWS_AN_ITEM - share.first;
            }
        }
        cover_items(team, deal(team, share, items));
        if looks || (round + 1u) % TURNS_A_LOOK == 0u {
            close_covered(team.lane, team.lanes);
            if agreed(team, atomicLoad(&open_pixels)) == 0u {
                break;
            }
        }
    }
}
