// A team is a subgroup: lanes read each other's registers.

// import: cover/team.wgsl
// import: shared/subgroup_capsule.wgsl

// Greatest subgroup size of the device: gives loops a constant length.
override MAX_LANES: u32;

struct Thread {
    // Index in the workgroup and in the subgroup.
    @builtin(local_invocation_index) number: u32,
    @builtin(subgroup_invocation_id) lane: u32,
    @builtin(subgroup_size) lanes: u32,
    // Index of the subgroup in the workgroup.
    @builtin(subgroup_id) team: u32,
    @builtin(num_subgroups) teams: u32,
}

// The line this lane distributes, and the inclusive sum of the items up to this lane.
var<private> distributed: LaneWork;
var<private> items_end: u32;

fn team_of(thread: Thread) -> Team {
    return Team(thread.lane, thread.lanes, thread.team, thread.teams);
}

// Number of batches in which each team takes its share of lines.
fn batches_of_team(team: Team, lines: u32) -> u32 {
    let threads = team.lanes * team.teams;
    return (lines + threads - 1u) / threads;
}

// Broadcasts lane 0's value. All lanes call this and the functions below together.
fn team_broadcast(team: Team, number: u32) -> u32 {
    return subgroupBroadcastFirst(number);
}

// Distributes the items of this lane. Returns the number of items of all lanes.
fn distribute_rows(team: Team, lane_work: LaneWork, items: u32) -> u32 {
    items_end = subgroupInclusiveAdd(items);
    distributed = lane_work;
    distributed.first -= items_end - items;
    return subgroupMax(items_end);
}

// Finds the line of an item by bisection.
fn work_of_item(team: Team, item: u32) -> LaneWork {
    var owner = 0u;
    for (var half = MAX_LANES / 2u; half > 0u; half /= 2u) {
        let is_behind = subgroupShuffle(items_end, owner + half - 1u) <= item;
        owner += select(0u, half, is_behind && owner + half <= team.lanes);
    }
    let capsule = capsule_of_lane(distributed.capsule, owner);
    let rows = subgroupShuffle(distributed.rows, owner);
    return LaneWork(capsule, rows, subgroupShuffle(distributed.first, owner));
}
