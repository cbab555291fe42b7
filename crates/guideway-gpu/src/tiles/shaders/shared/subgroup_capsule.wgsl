// Shares a capsule within a subgroup.

// import: shared/capsule.wgsl

// Returns the capsule of another lane. All lanes call this together.
fn capsule_of_lane(line: Capsule, lane: u32) -> Capsule {
    return Capsule(
        vec2f(subgroupShuffle(line.upper.x, lane), subgroupShuffle(line.upper.y, lane)),
        subgroupShuffle(line.height, lane),
        subgroupShuffle(line.slope, lane),
        subgroupShuffle(line.border_y, lane),
        subgroupShuffle(line.radius, lane),
    );
}
