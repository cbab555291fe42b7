// The part that both pre-passes share (thesis 4.2.3).
layout(local_size_x = WORKGROUP) in;

layout(std430, binding = PATHS) readonly buffer Paths { PathRecord paths[]; };
layout(std430, binding = TALLY) restrict buffer TallyBlock { Tally tally; };

bool is_seen(PathRecord path) {
    return all(lessThanEqual(path.min_m, seen_max_m)) && all(greaterThanEqual(path.max_m, seen_min_m));
}
