// Threads that run in step, and see each other's values without memory: a team of lanes.

// Most lanes that a team of this device has: loops of a known length take less time.
override MOST_LANES: u32;

struct Thread {
    // In its workgroup, and in its team.
    @builtin(local_invocation_index) number: u32,
    @builtin(subgroup_invocation_id) lane: u32,
    @builtin(subgroup_size) lanes: u32,
    // Of its team in the workgroup.
    @builtin(subgroup_id) team: u32,
    @builtin(num_subgroups) teams: u32,
}

// What this lane has dealt out, and how many items it and all lanes before it have.
var<private> dealt: Share;
var<private> items_end: u32;

fn team_of(thread: Thread) -> Team {
    return Team(thread.lane, thread.lanes, thread.team, thread.teams);
}

// A number as the first lane knows it. All lanes call this in step, as they do with what follows.
fn agreed(team: Team, number: u32) -> u32 {
    return subgroupBroadcastFirst(number);
}

// Deals out so many items of this lane to all lanes. Returns how many there are of all of them.
fn deal(team: Team, share: Share, items: u32) -> u32 {
    items_end = subgroupInclusiveAdd(items);
    dealt = share;
    dealt.first -= items_end - items;
    return subgroupMax(items_end);
}

// Whose item it is, with its number among all.
fn share_with(team: Team, item: u32) -> Share {
    var owner = 0u;
    for (var half = MOST_LANES / 2u; half > 0u; half /= 2u) {
        let is_behind = subgroupShuffle(items_end, owner + half - 1u) <= item;
        owner += select(0u, half, is_behind && owner + half <= team.lanes);
    }
    let capsule = capsule_of_lane(dealt.capsule, owner);
    return Share(capsule, subgroupShuffle(dealt.rows, owner), subgroupShuffle(dealt.first, owner));
}
