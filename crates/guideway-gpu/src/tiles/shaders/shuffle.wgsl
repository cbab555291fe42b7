// The line that a lane looks at, for all lanes that run in step with it.
fn capsule_of_lane(line: Capsule, lane: u32) -> Capsule {
    return Capsule(
        vec2f(subgroupShuffle(line.upper.x, lane), subgroupShuffle(line.upper.y, lane)),
        vec2f(subgroupShuffle(line.along.x, lane), subgroupShuffle(line.along.y, lane)),
        subgroupShuffle(line.left_y, lane),
        subgroupShuffle(line.right_y, lane),
        subgroupShuffle(line.per_row, lane),
        subgroupShuffle(line.radius, lane),
    );
}
