// A team is the whole workgroup: for devices without subgroup operations.

// import: cover/team.wgsl
// import: shared/workgroup_scan.wgsl

struct Thread {
    @builtin(local_invocation_index) number: u32,
}

// The line of each lane; `scan_ends` holds the inclusive sums of their items.
var<workgroup> distributed: array<LaneWork, THREADS>;
var<workgroup> broadcast_value: u32;

fn team_of(thread: Thread) -> Team {
    return Team(thread.number, THREADS, 0u, 1u);
}

// Number of batches in which each team takes its share of lines. It comes from a constant: the
// threads may meet in a loop only if its length is the same for all.
fn batches_of_team(team: Team, lines: u32) -> u32 {
    return (lines + THREADS - 1u) / THREADS;
}

// Broadcasts lane 0's value. All lanes call this and the functions below together.
fn team_broadcast(team: Team, number: u32) -> u32 {
    if team.lane == 0u {
        broadcast_value = number;
    }
    return workgroupUniformLoad(&broadcast_value);
}

// Distributes the items of this lane. Returns the number of items of all lanes.
fn distribute_rows(team: Team, lane_work: LaneWork, items: u32) -> u32 {
    // Other lanes may still read the previous lines.
    workgroupBarrier();
    let end = workgroup_scan(team.lane, items);
    let first = lane_work.first - (end - items);
    distributed[team.lane] = LaneWork(lane_work.capsule, lane_work.rows, first);
    workgroupBarrier();
    return scan_ends[THREADS - 1u];
}

// Finds the line of an item by bisection.
fn work_of_item(team: Team, item: u32) -> LaneWork {
    var owner = 0u;
    for (var half = THREADS / 2u; half > 0u; half /= 2u) {
        owner += select(0u, half, scan_ends[owner + half - 1u] <= item);
    }
    return distributed[owner];
}
