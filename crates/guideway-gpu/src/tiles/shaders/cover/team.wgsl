// A team: threads that run in lockstep and distribute sample rows among each other.
// `team_subgroup.wgsl` and `team_workgroup.wgsl` are its variants.

// import: shared/capsule.wgsl

// A lane of a team, and the number of the team within the workgroup.
struct Team {
    lane: u32,
    lanes: u32,
    number: u32,
    teams: u32,
}

// A line that a lane has loaded.
struct LaneWork {
    capsule: Capsule,
    // Bits 0-15: first sample row. Bits 16-31: end of the sample rows.
    rows: u32,
    // First item of its rows, minus the number of the lane's first item.
    first: u32,
}
