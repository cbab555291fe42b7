// For devices whose threads do not see each other's values: all threads of a workgroup are one team, and hand
// values over in memory.

struct Thread {
    @builtin(local_invocation_index) number: u32,
}

// What each lane has dealt out: `ends` has how many items it and all lanes before it have.
var<workgroup> dealt: array<Share, THREADS>;
var<workgroup> told: u32;

fn team_of(thread: Thread) -> Team {
    return Team(thread.number, THREADS, 0u, 1u);
}

// A number as the first lane knows it. All lanes call this in step, as they do with what follows.
fn agreed(team: Team, number: u32) -> u32 {
    if team.lane == 0u {
        told = number;
    }
    return workgroupUniformLoad(&told);
}

// Deals out so many items of this lane to all lanes. Returns how many there are of all of them.
fn deal(team: Team, share: Share, items: u32) -> u32 {
    // What was dealt out before may still be looked at.
    workgroupBarrier();
    let end = add_up(team.lane, items);
    dealt[team.lane] = Share(share.capsule, share.rows, share.first - (end - items));
    workgroupBarrier();
    return ends[THREADS - 1u];
}

// Whose item it is, with its number among all.
fn share_with(team: Team, item: u32) -> Share {
    var owner = 0u;
    for (var half = THREADS / 2u; half > 0u; half /= 2u) {
        owner += select(0u, half, ends[owner + half - 1u] <= item);
    }
    return dealt[owner];
}
