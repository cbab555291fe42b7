// Shares a capsule within a subgroup.

// import: shared/capsule.wgsl

// Returns the capsule of another lane. All lanes call this together.
fn capsule_of_lane(line: Capsule, lane: u32) -> Capsule {
    return Capsule(
        vec2f(subgroupShuffle(line.upper.x, lane), subgroupShuffle(line.upper.y, lane)),
        vec2f(subgroupShuffle(line.along.x, lane), subgroupShuffle(line.along.y, lane)),
        subgroupShuffle(line.left_y, lane),
        subgroupShuffle(line.right_y, lane),
        subgroupShuffle(line.inverse_dy, lane),
        subgroupShuffle(line.radius, lane),
    );
}
